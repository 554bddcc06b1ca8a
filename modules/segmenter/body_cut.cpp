#include "modules/segmenter/body_cut.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "modules/segmenter/lattice_box.hpp"

namespace limbcast::segmenter {
namespace {

/// What becomes of a point.
enum class Verdict : std::uint8_t { kBody, kUnsure, kOther };

/// Area of the points' connected parts that are more than an error on an arm.
float area_of_parts_m2(const Lattice& lattice, const std::vector<std::uint32_t>& points,
                       const BodyCutParams& params) {
  if (points.empty()) return 0.0F;
  const cv::Rect box = box_around(lattice, points);
  const auto in_box = [&](std::uint32_t i) {
    return cv::Point(static_cast<int>(i) % lattice.width, static_cast<int>(i) / lattice.width) -
           box.tl();
  };
  cv::Mat1b shown(box.size(), uchar{0});
  for (const std::uint32_t i : points) shown(in_box(i)) = 255;
  cv::Mat1i parts;
  const int count = cv::connectedComponents(shown, parts, 4, CV_32S);
  std::vector<float> area_m2(static_cast<std::size_t>(count), 0.0F);
  for (const std::uint32_t i : points) {
    const float side_m = lattice.depth_m[i] / lattice.focal_px;
    area_m2[static_cast<std::size_t>(parts(in_box(i)))] += side_m * side_m;
  }
  float sum_m2 = 0.0F;
  for (const float part_m2 : area_m2) {
    if (part_m2 > params.min_part_m2) sum_m2 += part_m2;
  }
  return sum_m2;
}

/// Marks what is cut off from one person, whose points' log odds are told.
void judge_cluster(const Lattice& lattice, const std::vector<std::uint32_t>& points,
                   const std::vector<float>& odds, const BodyCutParams& params,
                   std::vector<Verdict>& verdicts) {
  std::vector<std::uint32_t> unlikely;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (odds[k] < params.min_body_odds) unlikely.push_back(points[k]);
  }
  if (area_of_parts_m2(lattice, unlikely, params) < params.min_other_m2) return;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (odds[k] < params.min_body_odds)
      verdicts[points[k]] = odds[k] > params.min_unsure_odds ? Verdict::kUnsure : Verdict::kOther;
  }
}

}  // namespace

std::vector<std::uint32_t> cut_to_bodies(const Lattice& lattice, const BodyClassifier& classifier,
                                         const BodyCutParams& params, JointGrowth& growth) {
  const std::vector<std::int16_t> before = growth.labels();
  std::vector<Verdict> verdicts(lattice.size(), Verdict::kBody);
  const auto clusters = points_by_label(before, growth.heads().size());
  for (std::size_t k = 0; k < clusters.size(); ++k)
    judge_cluster(lattice, clusters[k],
                  classifier.body_odds(lattice, growth.heads()[k], before, clusters[k]), params,
                  verdicts);
  std::vector<std::uint32_t> cut, unsure;
  bool any = false;
  for (std::uint32_t i = 0; i < verdicts.size(); ++i) {
    any = any || verdicts[i] != Verdict::kBody;
    // What nobody had stays nobody's.
    if (before[i] == kNobody || verdicts[i] != Verdict::kBody) cut.push_back(i);
  }
  if (!any) return unsure;
  growth.grow_without(cut);
  // A body's points that hang on cut ones, a hand beyond a cut forearm, are not told from others.
  for (std::uint32_t i = 0; i < verdicts.size(); ++i) {
    const bool lost = before[i] != kNobody && growth.labels()[i] == kNobody;
    if (lost && verdicts[i] != Verdict::kOther) unsure.push_back(i);
  }
  return unsure;
}

}  // namespace limbcast::segmenter

#include "modules/segmenter/bodies/body_cut.hpp"

#include <algorithm>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "modules/segmenter/scene/lattice_box.hpp"

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

/// What becomes of each of one person's points, whose log odds are told.
std::vector<Verdict> judge_cluster(const Lattice& lattice, const std::vector<std::uint32_t>& points,
                                   const std::vector<float>& odds, const BodyCutParams& params) {
  std::vector<Verdict> verdicts(points.size(), Verdict::kBody);
  std::vector<std::uint32_t> unlikely;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (odds[k] < params.min_body_odds) unlikely.push_back(points[k]);
  }
  if (area_of_parts_m2(lattice, unlikely, params) < params.min_other_m2) return verdicts;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (odds[k] < params.min_body_odds)
      verdicts[k] = odds[k] > params.min_unsure_odds ? Verdict::kUnsure : Verdict::kOther;
  }
  return verdicts;
}

}  // namespace

std::vector<std::uint32_t> cut_to_bodies(const Lattice& lattice, const BodyClassifier& classifier,
                                         const BodyCutParams& params, JointGrowth& growth) {
  const auto clusters = points_by_label(growth.labels(), growth.heads().size());
  std::vector<std::uint32_t> body, not_other;
  bool any_cut = false;
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    const std::vector<std::uint32_t>& points = clusters[k];
    const std::vector<float> odds =
        classifier.body_odds(lattice, growth.heads()[k], growth.labels(), points);
    const std::vector<Verdict> verdicts = judge_cluster(lattice, points, odds, params);
    for (std::size_t n = 0; n < points.size(); ++n) {
      if (verdicts[n] == Verdict::kBody) body.push_back(points[n]);
      if (verdicts[n] != Verdict::kOther) not_other.push_back(points[n]);
      any_cut = any_cut || verdicts[n] != Verdict::kBody;
    }
  }
  std::vector<std::uint32_t> unsure;
  if (!any_cut) return unsure;
  // What nobody had stays nobody's.
  growth.grow_within(body);
  // A body's points that hang on cut ones, a hand beyond a cut forearm, are not told from others.
  std::copy_if(not_other.begin(), not_other.end(), std::back_inserter(unsure),
               [&](std::uint32_t i) { return growth.labels()[i] == kNobody; });
  return unsure;
}

}  // namespace limbcast::segmenter

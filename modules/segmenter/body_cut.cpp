#include "modules/segmenter/body_cut.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace limbcast::segmenter {
namespace {

/// What becomes of a point.
enum class Verdict : std::uint8_t { kBody, kUnsure, kOther };

/// Area of the unlikely points' connected parts that are more than an error on an arm.
float area_of_parts_m2(const Lattice& lattice, const cv::Mat1b& unlikely,
                       const BodyCutParams& params) {
  cv::Mat1i parts;
  const int count = cv::connectedComponents(unlikely, parts, 4, CV_32S);
  std::vector<float> area_m2(static_cast<std::size_t>(count), 0.0F);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const float side_m = lattice.depth_m[i] / lattice.focal_px;
    area_m2[static_cast<std::size_t>(parts(static_cast<int>(i)))] += side_m * side_m;
  }
  float sum_m2 = 0.0F;
  for (std::size_t part = 1; part < area_m2.size(); ++part) {
    if (area_m2[part] > params.min_part_m2) sum_m2 += area_m2[part];
  }
  return sum_m2;
}

/// Marks what is cut off from one person.
void judge_cluster(const Lattice& lattice, const std::vector<float>& odds,
                   const std::vector<std::int16_t>& labels, std::int16_t label,
                   const BodyCutParams& params, std::vector<Verdict>& verdicts) {
  cv::Mat1b unlikely(lattice.height, lattice.width, uchar{0});
  for (std::size_t i = 0; i < odds.size(); ++i) {
    if (labels[i] == label && odds[i] < params.min_body_odds) unlikely(static_cast<int>(i)) = 255;
  }
  if (area_of_parts_m2(lattice, unlikely, params) < params.min_other_m2) return;
  for (std::size_t i = 0; i < odds.size(); ++i) {
    if (unlikely(static_cast<int>(i)) != 0)
      verdicts[i] = odds[i] > params.min_unsure_odds ? Verdict::kUnsure : Verdict::kOther;
  }
}

}  // namespace

std::vector<std::uint32_t> cut_to_bodies(const Lattice& lattice, const BodyClassifier& classifier,
                                         const BodyCutParams& params, JointGrowth& growth) {
  const std::vector<std::int16_t> before = growth.labels();
  std::vector<Verdict> verdicts(lattice.size(), Verdict::kBody);
  for (std::size_t k = 0; k < growth.heads().size(); ++k) {
    const auto label = static_cast<std::int16_t>(k);
    if (growth.dropped(label)) continue;
    judge_cluster(lattice, classifier.body_odds(lattice, growth.heads()[k], before, label), before,
                  label, params, verdicts);
  }
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

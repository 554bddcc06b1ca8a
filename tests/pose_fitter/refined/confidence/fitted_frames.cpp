#include "tests/pose_fitter/refined/confidence/fitted_frames.hpp"

#include <tbb/parallel_for.h>

#include <optional>
#include <utility>

#include "common/human_model/ground_truth_json.hpp"
#include "modules/evaluate/evaluation.hpp"
#include "tests/segmenter/recorded_frames.hpp"

namespace limbcast::pose_fitter {
namespace {

using segmenter::LoadedFrame;

BodyPose all_joints(const refined::FittedBody& fitted) {
  BodyPose pose;
  for (int i = 0; i < kJointCount; ++i) {
    pose.joints[i].valid = true;
    pose.joints[i].position_m =
        fitted.observation.frame_from_image * fitted.body.points[i].cast<float>();
  }
  return pose;
}

segmenter::Params without_image(segmenter::Params params) {
  params.pose_network.enabled = false;
  return params;
}

segmenter::Params without_depths(segmenter::Params params) {
  params.depth_pose.enabled = false;
  return params;
}

/// Of four frames one is seen without colour's help, as a camera without colour would see it.
bool is_without_image(std::size_t frame) { return frame % 4 == 3; }

/// Of eight frames one is seen without the network of depths, as where it is switched off.
bool is_without_depths(std::size_t frame) { return frame % 8 == 5; }

/// A scan's noise is what the user says, or limbcast-laser-scanner's default [m], and outdoors no
/// plane may be found to be the ground: what is told with a scan differs from frame to frame.
constexpr float kToldNoiseM = 0.02F;
void vary_stamp(std::size_t frame, Cloud& cloud) {
  const bool is_scan = cloud.height == 1;
  if (!is_scan) return;
  if (frame / 4 % 2 == 1) cloud.stamp.depth_noise.constant_m = kToldNoiseM;
  if (frame % 3 == 2) cloud.stamp.gravity.sensor_height_m.reset();
}

FittedFrame fit_frame(const LoadedFrame& frame, std::vector<BodyPose> truth,
                      const segmenter::Segmenter& segmenter) {
  const Segments segments = segmenter.segment(frame.cloud);
  FittedFrame fitted;
  fitted.stamp = segments.stamp;
  fitted.truth = std::move(truth);
  for (const Segment& segment : segments.segments) {
    if (!segment.valid()) continue;
    auto body = refined::fit_body(segment, segments.stamp, RefinedParams{});
    if (!body) continue;
    fitted.poses.push_back(all_joints(*body));
    fitted.bodies.push_back(std::move(*body));
  }
  fitted.matching = evaluate::match_persons(fitted.truth, fitted.poses,
                                            evaluate::EvaluationParams{}.match_distance_m);
  return fitted;
}

}  // namespace

void fit_frames(const std::string& folder, const segmenter::Params& params,
                const std::function<void(FittedFrame&&, std::size_t)>& take) {
  const segmenter::FrameReader reader(folder, segmenter::DepthFrom::kReconstructor);
  const segmenter::Segmenter segmenter(params), colorless(without_image(params)),
      without_depth_pose(without_depths(params));
  const auto segmenter_of = [&](std::size_t frame) -> const segmenter::Segmenter& {
    if (is_without_depths(frame)) return without_depth_pose;
    return is_without_image(frame) ? colorless : segmenter;
  };
  std::vector<std::optional<FittedFrame>> frames(reader.paths().size());
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
    const std::string& path = reader.paths()[i];
    LoadedFrame frame = reader.read(path);
    vary_stamp(i, frame.cloud);
    if (!frame.labelled || frame.for_checking()) return;
    frames[i] = fit_frame(frame, read_ground_truth(path + "_gt.json").persons, segmenter_of(i));
  });
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i]) take(std::move(*frames[i]), i);
  }
}

bool is_checked_on(std::size_t frame) {
  constexpr std::size_t kBlock = 8, kBlocks = 4;
  return frame / kBlock % kBlocks == kBlocks - 1;
}

}  // namespace limbcast::pose_fitter

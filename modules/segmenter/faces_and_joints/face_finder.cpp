#include "modules/segmenter/faces_and_joints/face_finder.hpp"

#include <algorithm>

#include "modules/segmenter/faces_and_joints/color_patch.hpp"

namespace limbcast::segmenter {
namespace {

/// `m_per_px`: of the face's picture.
FaceEvidence to_evidence(const SeenFace& face, float m_per_px, const FaceParams& params) {
  FaceEvidence evidence;
  evidence.facing_log_odds =
      std::clamp(params.facing_log_odds_at_zero + params.facing_log_odds_per_score * face.score,
                 params.least_facing_log_odds, params.most_facing_log_odds);
  if (face.score < params.least_score) return evidence;
  const float nose_to_the_right_m = m_per_px * (face.nose_px.x() - face.ears_px.x());
  evidence.looks_right_log_odds = std::clamp(params.side_log_odds_per_m * nose_to_the_right_m,
                                             -params.most_side_log_odds, params.most_side_log_odds);
  return evidence;
}

}  // namespace

FaceFinder::FaceFinder(const FaceParams& params) : params_(params) {
  if (!params.enabled) return;
  networks_ = std::make_unique<InstancePool<BlazeFace>>(
      [library = params.library] { return std::make_unique<BlazeFace>(library); });
}

FaceEvidence FaceFinder::look(const Cloud& cloud, const Eigen::Vector3f& head_m,
                              const Eigen::Vector2f& up_px) const {
  if (!networks_ || !cloud.organized() || cloud.colors.empty() || !(head_m.z() > 0.0F)) return {};
  const PinholeCamera& camera = *cloud.camera;
  const float side_px = static_cast<float>(camera.fx) / head_m.z() * params_.patch_m;
  if (side_px < params_.min_patch_px) return {};
  const cv::Mat3b picture = cut_out(color_image(cloud), {camera.project(head_m), -up_px, side_px},
                                    BlazeFace::kPictureSide_px, cv::BORDER_CONSTANT);
  const float m_per_px = params_.patch_m / BlazeFace::kPictureSide_px;
  const SeenFace face = networks_->with(
      [&](BlazeFace& network) { return network.see(picture, params_.reach_m / m_per_px); });
  return to_evidence(face, m_per_px, params_);
}

}  // namespace limbcast::segmenter

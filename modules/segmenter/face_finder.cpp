#include "modules/segmenter/face_finder.hpp"

#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <vector>

#include "modules/segmenter/color_patch.hpp"

namespace limbcast::segmenter {
namespace {

cv::CascadeClassifier load(const std::string& path) {
  cv::CascadeClassifier cascade;
  // OpenCV itself complains of a missing file, on standard error.
  if (!std::filesystem::exists(path)) return cascade;
  try {
    cascade.load(path);
  } catch (const cv::Exception&) {
    // A damaged file; the cascade stays empty, as where there is none.
  }
  return cascade;
}

/// The head as the cascades know heads: grey, with even contrast.
cv::Mat1b cut_out_head(const Cloud& cloud, const UprightSquare& square, int patch_px) {
  const cv::Mat3b patch = cut_out(color_image(cloud), square, patch_px, cv::BORDER_REPLICATE);
  cv::Mat1b gray;
  cv::cvtColor(patch, gray, cv::COLOR_BGR2GRAY);
  cv::equalizeHist(gray, gray);
  return gray;
}

FaceEvidence to_evidence(int hits, int left_hits, int right_hits, const FaceParams& params) {
  FaceEvidence evidence;
  evidence.facing_log_odds = hits == 0                   ? params.no_hit_log_odds
                             : hits < params.some_hits   ? params.few_hits_log_odds
                             : hits < params.enough_hits ? params.some_hits_log_odds
                                                         : params.enough_hits_log_odds;
  if (std::abs(right_hits - left_hits) >= params.some_hits)
    evidence.looks_right_log_odds =
        right_hits > left_hits ? params.profile_log_odds : -params.profile_log_odds;
  return evidence;
}

}  // namespace

/// The detectors of one thread: OpenCV's keep what they work on.
class FaceFinder::Cascades {
 public:
  explicit Cascades(const std::string& folder)
      : frontal_(load(folder + "/haarcascade_frontalface_default.xml")),
        left_profile_(load(folder + "/haarcascade_profileface.xml")) {}

  bool complete() const { return !frontal_.empty() && !left_profile_.empty(); }

  FaceEvidence look(const cv::Mat1b& patch, const FaceParams& params) {
    const int frontal = count(frontal_, patch, params);
    if (frontal >= params.enough_hits) return to_evidence(frontal, 0, 0, params);
    const int left = count(left_profile_, patch, params);
    cv::Mat1b mirrored;
    cv::flip(patch, mirrored, 1);
    const int right = count(left_profile_, mirrored, params);
    return to_evidence(frontal + left + right, left, right, params);
  }

 private:
  static int count(cv::CascadeClassifier& cascade, const cv::Mat1b& patch,
                   const FaceParams& params) {
    const int least = static_cast<int>(std::lround(params.min_face_share * params.patch_px));
    const int most = static_cast<int>(std::lround(params.max_face_share * params.patch_px));
    std::vector<cv::Rect> hits;
    cascade.detectMultiScale(patch, hits, params.size_step, 0, 0, {least, least}, {most, most});
    return static_cast<int>(hits.size());
  }

  cv::CascadeClassifier frontal_, left_profile_;
};

FaceFinder::FaceFinder(const FaceParams& params) : params_(params) {
  if (params.cascades.empty()) return;
  cascades_ = std::make_unique<InstancePool<Cascades>>(
      [folder = params.cascades] { return std::make_unique<Cascades>(folder); });
  if (cascades_->with([](const Cascades& cascades) { return cascades.complete(); })) return;
  cascades_.reset();
  problem_ = "no faces are looked for: " + params.cascades +
             " lacks OpenCV's cascades; install the package opencv-data, or name their folder "
             "with face-cascades";
}

FaceFinder::~FaceFinder() = default;

FaceEvidence FaceFinder::look(const Cloud& cloud, const Eigen::Vector3f& head_m,
                              const Eigen::Vector2f& up_px) const {
  if (!cascades_ || !cloud.organized() || cloud.colors.empty() || !(head_m.z() > 0.0F)) return {};
  const PinholeCamera& camera = *cloud.camera;
  const float side_px = static_cast<float>(camera.fx) / head_m.z() * params_.patch_m;
  if (side_px < params_.min_patch_px) return {};
  const cv::Mat1b patch =
      cut_out_head(cloud, {camera.project(head_m), -up_px, side_px}, params_.patch_px);
  return cascades_->with([&](Cascades& cascades) { return cascades.look(patch, params_); });
}

}  // namespace limbcast::segmenter

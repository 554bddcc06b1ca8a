#include "modules/segmenter/face_finder.hpp"

#include <cmath>
#include <filesystem>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <utility>
#include <vector>

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

/// The head upright in a square, with even contrast: the cascades know no other faces.
cv::Mat1b cut_out_head(const Cloud& cloud, const Eigen::Vector2f& center_px,
                       const Eigen::Vector2f& up_px, float cloud_px_per_patch_px, int side_px) {
  const Eigen::Vector2f down = -cloud_px_per_patch_px * up_px;
  const Eigen::Vector2f right(down.y(), -down.x());
  const Eigen::Vector2f corner = center_px - 0.5F * static_cast<float>(side_px) * (right + down);
  const cv::Matx23f cloud_from_patch(right.x(), down.x(), corner.x(), right.y(), down.y(),
                                     corner.y());
  // OpenCV has no view of constant data; the image is only read.
  const cv::Mat3b image(cloud.height, cloud.width,
                        reinterpret_cast<cv::Vec3b*>(const_cast<Bgr*>(cloud.colors.data())));
  cv::Mat3b patch;
  cv::warpAffine(image, patch, cloud_from_patch, cv::Size(side_px, side_px),
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
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

/// As many detectors as threads ask at the same time.
class FaceFinder::Pool {
 public:
  Pool(const std::string& folder, std::unique_ptr<Cascades> first) : folder_(folder) {
    give_back(std::move(first));
  }

  std::unique_ptr<Cascades> take() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Cascades> cascades = std::move(idle_.back());
        idle_.pop_back();
        return cascades;
      }
    }
    return std::make_unique<Cascades>(folder_);
  }

  void give_back(std::unique_ptr<Cascades> cascades) {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(cascades));
  }

 private:
  std::string folder_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Cascades>> idle_;
};

FaceFinder::FaceFinder(const FaceParams& params) : params_(params) {
  if (params.cascades.empty()) return;
  auto cascades = std::make_unique<Cascades>(params.cascades);
  if (cascades->complete())
    pool_ = std::make_unique<Pool>(params.cascades, std::move(cascades));
  else
    problem_ = "no faces are looked for: " + params.cascades +
               " lacks OpenCV's cascades; install the package opencv-data, or name their folder "
               "with face-cascades";
}

FaceFinder::~FaceFinder() = default;

FaceEvidence FaceFinder::look(const Cloud& cloud, const Eigen::Vector3f& head_m,
                              const Eigen::Vector2f& up_px) const {
  if (!pool_ || !cloud.organized() || cloud.colors.empty() || !(head_m.z() > 0.0F)) return {};
  const PinholeCamera& camera = *cloud.camera;
  const float px_per_m = static_cast<float>(camera.fx) / head_m.z();
  if (px_per_m * params_.patch_m < params_.min_patch_px) return {};
  const Eigen::Vector2f center_px(
      px_per_m * head_m.x() + static_cast<float>(camera.cx),
      static_cast<float>(camera.fy) / head_m.z() * head_m.y() + static_cast<float>(camera.cy));
  const float scale = px_per_m * params_.patch_m / static_cast<float>(params_.patch_px);
  const cv::Mat1b patch = cut_out_head(cloud, center_px, up_px, scale, params_.patch_px);
  std::unique_ptr<Cascades> cascades = pool_->take();
  const FaceEvidence evidence = cascades->look(patch, params_);
  pool_->give_back(std::move(cascades));
  return evidence;
}

}  // namespace limbcast::segmenter

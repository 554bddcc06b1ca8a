#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "modules/segmenter/range_image.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/scene/nearest_pixels.hpp"

namespace limbcast::segmenter {
namespace {

/// Widest angle from the middle of the view [tangent]; 63 degrees, so that a person 1 m away fits.
constexpr float kMaxTangent = 2.0F;

/// Bounds of a person's points in the view [tangents].
struct Bounds {
  Eigen::Array2f low = Eigen::Array2f::Constant(1e9F), high = Eigen::Array2f::Constant(-1e9F);
};

Bounds bounds_of(const std::vector<Eigen::Vector3f>& points_m,
                 const Eigen::Matrix3f& frame_from_image, float margin_m) {
  Bounds bounds;
  for (const Eigen::Vector3f& point_m : points_m) {
    const Eigen::Vector3f p = frame_from_image.transpose() * point_m;
    if (p.z() <= 0.0F) continue;
    const Eigen::Array2f at = p.head<2>().array() / p.z();
    bounds.low = bounds.low.min(at - margin_m / p.z());
    bounds.high = bounds.high.max(at + margin_m / p.z());
  }
  bounds.low = bounds.low.max(-kMaxTangent);
  bounds.high = bounds.high.min(kMaxTangent);
  return bounds;
}

PinholeCamera camera_for(const Bounds& bounds, float focal_px) {
  PinholeCamera camera;
  camera.fx = camera.fy = focal_px;
  camera.width =
      std::max(1, static_cast<int>(std::ceil((bounds.high.x() - bounds.low.x()) * focal_px)));
  camera.height =
      std::max(1, static_cast<int>(std::ceil((bounds.high.y() - bounds.low.y()) * focal_px)));
  camera.cx = -bounds.low.x() * focal_px - 0.5F;
  camera.cy = -bounds.low.y() * focal_px - 0.5F;
  return camera;
}

/// Index of the nearest point that each pixel shows, or -1.
std::vector<int> draw(const RangeImageSource& source, RangeImage& image) {
  std::vector<int> point_of(image.depth_m.size(), -1);
  for (std::size_t i = 0; i < source.cloud.points_m.size(); ++i) {
    const Eigen::Vector3f p = image.frame_from_image.transpose() * source.cloud.points_m[i];
    if (!(p.z() > 0.05F)) continue;
    const Eigen::Vector2f px = image.camera.project(p);
    const int u = static_cast<int>(std::lround(px.x())), v = static_cast<int>(std::lround(px.y()));
    if (u < 0 || v < 0 || u >= image.camera.width || v >= image.camera.height) continue;
    const int pixel = v * image.camera.width + u;
    const auto k = static_cast<std::size_t>(pixel);
    if (point_of[k] >= 0 && image.depth_m[k] <= p.z()) continue;
    image.depth_m[k] = p.z();
    point_of[k] = static_cast<int>(i);
  }
  return point_of;
}

void fill_gaps(int gap_px, RangeImage& image, std::vector<int>& point_of) {
  const cv::Mat1b empty = cv::Mat1i(image.camera.height, image.camera.width, point_of.data()) < 0;
  fill_from_nearest(empty, gap_px, [&](std::size_t pixel, std::size_t nearest) {
    image.depth_m[pixel] = image.depth_m[nearest];
    point_of[pixel] = point_of[nearest];
  });
}

}  // namespace

Eigen::Matrix3f upright_view(const Eigen::Vector3f& middle_m, const Eigen::Vector3f& down) {
  const Eigen::Vector3f forward = (middle_m - down * down.dot(middle_m)).normalized();
  Eigen::Matrix3f frame_from_image;
  frame_from_image.col(0) = down.cross(forward);
  frame_from_image.col(1) = down;
  frame_from_image.col(2) = forward;
  return frame_from_image;
}

std::optional<PinholeCamera> camera_towards(const Eigen::Vector3f& middle_m, float side_m,
                                            int side_px) {
  if (!(middle_m.z() > 0.0F)) return std::nullopt;
  const double middle_px = 0.5 * (side_px - 1);
  PinholeCamera camera;
  camera.width = camera.height = side_px;
  camera.fx = camera.fy = side_px * middle_m.z() / side_m;
  camera.cx = middle_px - camera.fx * middle_m.x() / middle_m.z();
  camera.cy = middle_px - camera.fy * middle_m.y() / middle_m.z();
  return camera;
}

void fill_from_scan(const RangeImageSource& source, std::int16_t label, const Eigen::Vector3f& down,
                    float focal_px, int gap_px, Segment& segment) {
  const bool colored = !source.cloud.colors.empty();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < source.labels.size(); ++i) {
    if (source.labels[i] != label) continue;
    segment.points_m.push_back(source.cloud.points_m[i]);
    if (colored) segment.is_skin.push_back(is_skin_colored(source, i) ? 1 : 0);
    sum += source.cloud.points_m[i];
  }
  if (segment.points_m.empty()) return;

  RangeImage image;
  image.frame_from_image = upright_view(sum / static_cast<float>(segment.points_m.size()), down);
  image.camera =
      camera_for(bounds_of(segment.points_m, image.frame_from_image, source.margin_m), focal_px);
  image.full_width = image.camera.width;
  image.full_height = image.camera.height;
  const auto size =
      static_cast<std::size_t>(image.camera.width) * static_cast<std::size_t>(image.camera.height);
  image.depth_m.assign(size, 0.0F);
  std::vector<int> point_of = draw(source, image);
  fill_gaps(gap_px, image, point_of);
  for (const int i : point_of) {
    const auto point = static_cast<std::size_t>(std::max(0, i));
    const bool hole = i < 0 || source.labels[point] == kUnsure;
    const bool own = !hole && source.labels[point] == label;
    if (hole) image.depth_m[image.labels.size()] = 0.0F;
    image.labels.push_back(hole  ? PixelLabel::kUnknown
                           : own ? PixelLabel::kPerson
                                 : PixelLabel::kOther);
    if (colored) image.is_skin.push_back(!hole && is_skin_colored(source, point) ? 1 : 0);
  }
  segment.range_image = std::move(image);
}

}  // namespace limbcast::segmenter

#include "modules/segmenter/range_image.hpp"

#include <algorithm>
#include <cmath>

#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {
namespace {

struct Box {
  int left, top, right, bottom;  // [left, right) x [top, bottom)
  bool empty() const { return right <= left || bottom <= top; }
};

Box bounding_box(const Cloud& cloud, const std::vector<std::int16_t>& labels, std::int16_t label,
                 float& nearest_m) {
  Box box{cloud.width, cloud.height, 0, 0};
  nearest_m = 1e9F;
  std::size_t i = 0;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u, ++i) {
      if (labels[i] != label) continue;
      box = {std::min(box.left, u), std::min(box.top, v), std::max(box.right, u + 1),
             std::max(box.bottom, v + 1)};
      nearest_m = std::min(nearest_m, cloud.points_m[i].z());
    }
  }
  return box;
}

Box widen(const Box& box, const Cloud& cloud, int margin_px) {
  return {std::max(0, box.left - margin_px), std::max(0, box.top - margin_px),
          std::min(cloud.width, box.right + margin_px),
          std::min(cloud.height, box.bottom + margin_px)};
}

}  // namespace

bool is_skin_colored(const RangeImageSource& source, std::size_t point) {
  return source.skin.log_ratio(source.cloud.colors[point]) > source.min_log_ratio;
}

Eigen::Vector2f image_px(const RangeImage& view, const Eigen::Vector3f& place) {
  const Eigen::Vector2f origin_px(static_cast<float>(view.origin_u),
                                  static_cast<float>(view.origin_v));
  return origin_px + view.camera.project(place);
}

void fill_from_camera(const RangeImageSource& source, std::int16_t label, Segment& segment) {
  const Cloud& cloud = source.cloud;
  const std::vector<std::int16_t>& labels = source.labels;
  float nearest_m = 0.0F;
  const Box tight = bounding_box(cloud, labels, label, nearest_m);
  if (tight.empty()) return;
  const auto margin_px =
      static_cast<int>(std::ceil(source.margin_m * cloud.camera->fx / nearest_m));
  const Box box = widen(tight, cloud, margin_px);

  RangeImage image;
  image.camera = *cloud.camera;
  image.camera.width = box.right - box.left;
  image.camera.height = box.bottom - box.top;
  image.camera.cx -= box.left;
  image.camera.cy -= box.top;
  image.origin_u = box.left;
  image.origin_v = box.top;
  image.full_width = cloud.width;
  image.full_height = cloud.height;
  const auto size =
      static_cast<std::size_t>(image.camera.width) * static_cast<std::size_t>(image.camera.height);
  image.depth_m.reserve(size);
  image.labels.reserve(size);
  const bool colored = !cloud.colors.empty();
  if (colored) image.is_skin.reserve(size);
  for (int v = box.top; v < box.bottom; ++v) {
    for (int u = box.left; u < box.right; ++u) {
      const std::size_t i = static_cast<std::size_t>(v) * static_cast<std::size_t>(cloud.width) +
                            static_cast<std::size_t>(u);
      const float z_m = cloud.points_m[i].z();
      const bool hole = !(z_m > 0.0F) || !std::isfinite(z_m) || labels[i] == kUnsure;
      const bool own = !hole && labels[i] == label;
      const auto is_skin = static_cast<std::uint8_t>(colored && is_skin_colored(source, i));
      image.depth_m.push_back(hole ? 0.0F : z_m);
      image.labels.push_back(hole  ? PixelLabel::kUnknown
                             : own ? PixelLabel::kPerson
                                   : PixelLabel::kOther);
      if (colored) image.is_skin.push_back(is_skin);
      if (!own) continue;
      segment.points_m.push_back(cloud.points_m[i]);
      if (colored) segment.is_skin.push_back(is_skin);
    }
  }
  segment.range_image = std::move(image);
}

}  // namespace limbcast::segmenter

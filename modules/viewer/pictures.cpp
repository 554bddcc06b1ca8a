#include "modules/viewer/pictures.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "common/formatted.hpp"
#include "modules/viewer/painting.hpp"

namespace limbcast::viewer {
namespace {

const cv::Scalar kBackground(35, 30, 25);
const cv::Scalar kSkinColor(255, 60, 255);
constexpr Orbit kAbove{0.0F, 75.0F};
/// Distances at the two ends of the colours of the disparity picture [m].
constexpr float kNearest = 1.0F, kFarthest = 8.0F;
/// Lower images have no room for the scale of distances [px].
constexpr int kScaleRows = 120;

/// Index is SegmentFilter. A frame has dozens of seeds without the shape of a head: their names
/// would hide the picture.
constexpr std::array<const char*, 7> kFilterNames = {
    "", "too few points", "too many points", "seed is no head", "sparse", "same person", ""};

cv::Mat dark(const cv::Size& size) { return {size, CV_8UC3, kBackground}; }

cv::Mat missing(const std::string& what) {
  cv::Mat picture = dark(kPictureSize);
  draw_text(picture, "no " + what, {20, kPictureSize.height / 2});
  return picture;
}

/// 0 to 1: where between the two ends of the colours a distance is.
float closeness(float distance_m) {
  const float share = (1.0F / distance_m - 1.0F / kFarthest) / (1.0F / kNearest - 1.0F / kFarthest);
  return std::clamp(share, 0.0F, 1.0F);
}

/// What stands in for the image of a sensor without colours: grey, the nearer the brighter.
cv::Mat depth_in_grey(const Cloud& cloud) {
  constexpr float kFarGrey = 50.0F, kNearGrey = 230.0F;
  cv::Mat image = dark({cloud.width, cloud.height});
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    if (cloud.is_hole(i)) continue;
    const float grey = kFarGrey + (kNearGrey - kFarGrey) * closeness(cloud.points_m[i].z());
    image.ptr<cv::Vec3b>()[i] = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(grey));
  }
  return image;
}

/// The colours of an organised cloud as an image, or its depths where it has none.
cv::Mat camera_image(const Cloud& cloud) {
  if (cloud.colors.empty()) return depth_in_grey(cloud);
  cv::Mat image = dark({cloud.width, cloud.height});
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const Bgr& color = cloud.colors[static_cast<std::size_t>(v) * cloud.width + u];
      image.at<cv::Vec3b>(v, u) = {color.b, color.g, color.r};
    }
  }
  return image;
}

/// 255 where one of the windows shows skin colour.
cv::Mat1b skin_mask(const Segments& segments, const cv::Size& size) {
  cv::Mat1b mask(size, 0);
  for (const Segment& segment : segments.segments) {
    if (!segment.range_image || segment.range_image->is_skin.empty()) continue;
    const RangeImage& window = *segment.range_image;
    for (int v = 0; v < window.camera.height; ++v) {
      for (int u = 0; u < window.camera.width; ++u) {
        const cv::Point pixel(u + window.origin_u, v + window.origin_v);
        const std::size_t i = static_cast<std::size_t>(v) * window.camera.width + u;
        if (window.is_skin[i] != 0 && cv::Rect({}, size).contains(pixel)) mask(pixel) = 255;
      }
    }
  }
  return mask;
}

void mark_skin(cv::Mat& image, const Segments& segments) {
  const cv::Mat1b mask = skin_mask(segments, image.size());
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(image, outlines, -1, kSkinColor, 1);
}

void mark_seeds(cv::Mat& image, const Viewpoint& view, const Segments& segments) {
  for (const Segment& segment : segments.segments) {
    const auto pixel = view.project(segment.seed_m);
    if (!pixel) continue;
    const cv::Point place = *pixel;
    if (segment.valid()) {
      cv::circle(image, place, 9, person_color(segment.id), 2, cv::LINE_AA);
    } else {
      const std::string reason = kFilterNames.at(static_cast<std::size_t>(segment.rejected_by));
      cv::drawMarker(image, place, cv::Scalar::all(200), cv::MARKER_TILTED_CROSS,
                     reason.empty() ? 5 : 10, 1, cv::LINE_AA);
      draw_text(image, reason, place + cv::Point(8, 4), 0.35, cv::Scalar::all(200));
    }
  }
}

/// The colours with their distances, along the left border.
void draw_distance_scale(cv::Mat& picture) {
  const int top = 40, height = picture.rows - 60;
  cv::Mat1b level(height, 10);
  for (int y = 0; y < height; ++y) level.row(y) = cvRound(255.0 * (height - 1 - y) / (height - 1));
  cv::Mat colors;
  cv::applyColorMap(level, colors, cv::COLORMAP_TURBO);
  colors.copyTo(picture(cv::Rect({0, top}, colors.size())));
  for (const int distance_m : {1, 2, 3, 4, 8}) {
    const int y = top + cvRound((1.0F - closeness(static_cast<float>(distance_m))) * height);
    draw_text(picture, std::to_string(distance_m) + " m", {14, y + 5}, 0.4);
  }
}

std::string words(const Orbit& orbit) {
  return formatted("%.0f degrees to the side, %.0f up", static_cast<double>(orbit.azimuth_deg),
                   static_cast<double>(orbit.elevation_deg));
}

}  // namespace

cv::Mat draw_scene(const ViewFrame& frame, const Orbit& orbit, const cv::Size& size) {
  cv::Mat picture = dark(size);
  const Viewpoint view = orbit_view(frame, orbit, size);
  if (frame.cloud) draw_cloud(picture, view, *frame.cloud, true);
  if (frame.segments) draw_segments(picture, view, *frame.segments);
  if (frame.truth) draw_truth(picture, view, *frame.truth);
  if (frame.poses)
    draw_skeletons(picture, view, *frame.poses);
  else
    draw_text(picture, "no poses", {20, size.height / 2});
  return picture;
}

cv::Mat draw_input(const ViewFrame& frame) {
  const auto view = sensor_view(frame);
  if (!view) return missing("camera image");
  cv::Mat picture = camera_image(*frame.cloud);
  if (!frame.segments) return picture;
  mark_skin(picture, *frame.segments);
  mark_seeds(picture, *view, *frame.segments);
  return picture;
}

cv::Mat draw_disparity(const ViewFrame& frame) {
  if (!sensor_view(frame)) return missing("range image");
  const Cloud& cloud = *frame.cloud;
  cv::Mat1b level(cloud.height, cloud.width, static_cast<std::uint8_t>(0)), hole(level.size(), 255);
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    if (cloud.is_hole(i)) continue;
    level.data[i] = cv::saturate_cast<std::uint8_t>(255.0F * closeness(cloud.points_m[i].z()));
    hole.data[i] = 0;
  }
  cv::Mat picture;
  cv::applyColorMap(level, picture, cv::COLORMAP_TURBO);
  picture.setTo(cv::Scalar::all(0), hole);
  if (picture.rows >= kScaleRows) draw_distance_scale(picture);
  return picture;
}

cv::Mat draw_whole_cloud(const ViewFrame& frame, const Orbit& orbit) {
  if (!frame.cloud) return missing("cloud");
  cv::Mat picture = dark(kPictureSize);
  draw_cloud(picture, orbit_view(frame, orbit, kPictureSize), *frame.cloud, false);
  return picture;
}

cv::Mat draw_segments_in_colors(const ViewFrame& frame) {
  if (!frame.segments) return missing("segments");
  const auto view = sensor_view(frame);
  const Viewpoint used = view ? *view : orbit_view(frame, {}, kPictureSize);
  cv::Mat picture = view ? camera_image(*frame.cloud) : dark(kPictureSize);
  picture.convertTo(picture, -1, 0.4);
  cv::Mat colored = picture.clone();
  draw_segments(colored, used, *frame.segments);
  cv::addWeighted(picture, 0.3, colored, 0.7, 0.0, picture);
  mark_seeds(picture, used, *frame.segments);
  return picture;
}

cv::Mat draw_skeleton(const ViewFrame& frame) {
  const auto view = sensor_view(frame);
  if (!view) return draw_scene(frame, {});
  cv::Mat picture = camera_image(*frame.cloud);
  if (frame.truth) draw_truth(picture, *view, *frame.truth);
  if (frame.poses) draw_skeletons(picture, *view, *frame.poses);
  return picture;
}

std::vector<Picture> draw_pictures(const ViewFrame& frame, const Orbit& orbit) {
  return {{"input", "input, skin parts, seeds", draw_input(frame)},
          {"disparity", "disparity", draw_disparity(frame)},
          {"cloud", "cloud, " + words(orbit), draw_whole_cloud(frame, orbit)},
          {"segments", "segments", draw_segments_in_colors(frame)},
          {"skeleton", "body poses (truth thin)", draw_skeleton(frame)},
          {"scene", "body poses, " + words(orbit), draw_scene(frame, orbit)},
          {"above", "body poses from above", draw_scene(frame, kAbove)}};
}

}  // namespace limbcast::viewer

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "modules/segmenter/seeds/skin_color.hpp"

namespace limbcast::segmenter {

/// What a range image is cut from, and how.
struct RangeImageSource {
  const Cloud& cloud;
  const std::vector<std::int16_t>& labels;  ///< one for each point of the cloud
  const SkinColor& skin;                    ///< only asked where there is colour
  float min_log_ratio;                      ///< above which a colour is skin
  float margin_m;                           ///< kept around the person
};

bool is_skin_colored(const RangeImageSource& source, std::size_t point);

/// Axes of an upright view towards `middle_m`, as columns: right, down, away. `down` points to its
/// bottom.
Eigen::Matrix3f upright_view(const Eigen::Vector3f& middle_m, const Eigen::Vector3f& down);

/// A camera in the sensor's place whose square image of `side_px` is `side_m` wide around
/// `middle_m`, in the camera's frame; nothing where that is not before it.
std::optional<PinholeCamera> camera_towards(const Eigen::Vector3f& middle_m, float side_m,
                                            int side_px);

/// The pixel that shows a place of the view's optical frame, of the image that it is a part of.
Eigen::Vector2f image_px(const RangeImage& view, const Eigen::Vector3f& place);

/// Fills points_m, is_skin and range_image of `segment` from an organised cloud: the pixels that
/// carry `label` and what the sensor saw around them.
void fill_from_camera(const RangeImageSource& source, std::int16_t label, Segment& segment);

/// The same from an unorganised cloud: the range image is rendered from the sensor's origin towards
/// the middle of the points, upright (`down` points to its bottom), `focal_px` pixels a radian; a
/// pixel without a point takes the nearest one's within `gap_px`.
void fill_from_scan(const RangeImageSource& source, std::int16_t label, const Eigen::Vector3f& down,
                    float focal_px, int gap_px, Segment& segment);

}  // namespace limbcast::segmenter

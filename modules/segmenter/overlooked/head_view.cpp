#include "modules/segmenter/overlooked/head_view.hpp"

#include <cmath>

namespace limbcast::segmenter {
namespace {

constexpr float kNearest_m = 0.2F;
/// A ball of a head's size is looked at in so many steps from its middle, and is out of sight where
/// so much of it is.
constexpr int kSteps = 2, kMinShare_percent = 70;

}  // namespace

HeadView::HeadView(const Lattice& lattice, const FoundPeople& found, const HiddenHeadParams& params)
    : lattice_(lattice), found_(found), params_(params) {
  for (int v = 0; v < lattice.height; ++v) {
    int first = 0, last = lattice.width - 1;
    while (first < lattice.width && !lattice.find(first, v)) ++first;
    while (last > first && !lattice.find(last, v)) --last;
    seen_.push_back({first, last});
  }
  find_principal_point();
}

bool HeadView::hides_head(const Eigen::Vector3f& center_m) const {
  const Eigen::Vector3f p = lattice_.frame.to_sensor(center_m);
  if (p.z() < kNearest_m) return true;
  int hidden = 0, all = 0;
  for (int y = -kSteps; y <= kSteps; ++y) {
    for (int x = -kSteps; x <= kSteps; ++x) {
      const Eigen::Vector3f offset(static_cast<float>(x), static_cast<float>(y), 0.0F);
      hidden += out_of_sight(p + params_.head_radius_m / kSteps * offset) ? 1 : 0;
      ++all;
    }
  }
  return 100 * hidden >= kMinShare_percent * all;
}

/// Any measured point tells it.
void HeadView::find_principal_point() {
  for (std::size_t i = 0; i < lattice_.size(); ++i) {
    if (lattice_.depth_m[i] <= 0.0F) continue;
    const Eigen::Vector3f p = lattice_.frame.to_sensor(lattice_.level_m[i]);
    const int u = static_cast<int>(i) % lattice_.width, v = static_cast<int>(i) / lattice_.width;
    const Eigen::Vector2f px(static_cast<float>(u), static_cast<float>(v));
    principal_px_ = px - lattice_.focal_px / p.z() * p.head<2>();
    return;
  }
}

bool HeadView::out_of_sight(const Eigen::Vector3f& sensor_m) const {
  const Eigen::Vector2f px = principal_px_ + lattice_.focal_px / sensor_m.z() * sensor_m.head<2>();
  const int u = static_cast<int>(std::lround(px.x())), v = static_cast<int>(std::lround(px.y()));
  if (v < 0 || v >= lattice_.height) return true;
  const auto& [first, last] = seen_[static_cast<std::size_t>(v)];
  if (u < first || u > last) return true;
  const std::size_t i = lattice_.index(u, v);
  const float depth_m = lattice_.depth_m[i];
  return is_a_persons(i) && depth_m > 0.0F && depth_m < sensor_m.z() - params_.min_gap_m;
}

bool HeadView::is_a_persons(std::size_t i) const {
  const std::int16_t label = found_.labels[i];
  return label >= 0 &&
         found_.person_odds[static_cast<std::size_t>(label)] >= params_.min_hider_odds;
}

}  // namespace limbcast::segmenter

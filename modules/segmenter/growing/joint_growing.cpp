#include "modules/segmenter/growing/joint_growing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace limbcast::segmenter {
namespace {

/// Width of a bucket of the priority queue [m]; ways within one are handled in the order they came.
constexpr float kBucket_m = 0.01F;
/// A way that is shorter by less is no shorter: spares visits that change nothing.
constexpr float kSameWay_m = 1e-4F;
constexpr float kNoWay_m = std::numeric_limits<float>::max();

using Direction = std::array<int, 2>;
/// The eight neighbours, and two pixels away along the axes, to bridge a missing pixel.
constexpr std::array<Direction, 12> kNeighbors = {{{1, 0},
                                                   {-1, 0},
                                                   {0, 1},
                                                   {0, -1},
                                                   {1, 1},
                                                   {-1, 1},
                                                   {1, -1},
                                                   {-1, -1},
                                                   {2, 0},
                                                   {-2, 0},
                                                   {0, 2},
                                                   {0, -2}}};
/// Where a surface is looked for behind what hides it: about every 23 degrees.
constexpr std::array<Direction, 16> kDirections = {{{1, 0},
                                                    {-1, 0},
                                                    {0, 1},
                                                    {0, -1},
                                                    {1, 1},
                                                    {-1, 1},
                                                    {1, -1},
                                                    {-1, -1},
                                                    {2, 1},
                                                    {-2, 1},
                                                    {2, -1},
                                                    {-2, -1},
                                                    {1, 2},
                                                    {-1, 2},
                                                    {1, -2},
                                                    {-1, -2}}};

std::size_t bucket_of(float way_m) { return static_cast<std::size_t>(way_m / kBucket_m); }

}  // namespace

JointGrowth::JointGrowth(const Lattice& lattice, std::vector<HeadCandidate> heads,
                         const JointGrowingParams& params, const ReachParams& reach,
                         const std::vector<std::int16_t>* taken)
    : lattice_(&lattice),
      heads_(std::move(heads)),
      dropped_(heads_.size(), false),
      changed_(heads_.size(), false),
      params_(params),
      reach_(reach),
      labels_(lattice.size(), kNobody),
      way_m_(lattice.size(), kNoWay_m),
      buckets_(bucket_of(params.max_way_m) + 2),
      bridged_(lattice.size(), 0) {
  if (taken != nullptr) {
    forbidden_.resize(lattice.size());
    std::transform(taken->begin(), taken->end(), forbidden_.begin(),
                   [](std::int16_t label) { return static_cast<std::uint8_t>(label != kNobody); });
  }
  grow();
}

std::vector<std::int16_t> JointGrowth::drop(std::int16_t head) {
  changed_.assign(heads_.size(), false);
  dropped_[static_cast<std::size_t>(head)] = true;
  last_dropped_ = head;
  changes_.clear();
  bridges_before_ = bridges_.size();
  dropping_ = true;
  free_points(head);
  queue_around_freed();
  grow();
  dropping_ = false;
  std::vector<std::int16_t> changed;
  for (std::size_t k = 0; k < heads_.size(); ++k) {
    if (changed_[k] && !dropped_[k]) changed.push_back(static_cast<std::int16_t>(k));
  }
  return changed;
}

void JointGrowth::undo_drop() {
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
    labels_[change->point] = change->label;
    way_m_[change->point] = change->way_m;
  }
  changes_.clear();
  for (std::size_t k = bridges_before_; k < bridges_.size(); ++k) bridged_[bridges_[k].from] = 0;
  bridges_.resize(bridges_before_);
  dropped_[static_cast<std::size_t>(last_dropped_)] = false;
}

void JointGrowth::set(std::uint32_t i, std::int16_t label, float way_m) {
  if (dropping_) changes_.push_back({i, labels_[i], way_m_[i]});
  labels_[i] = label;
  way_m_[i] = way_m;
}

void JointGrowth::grow_without(const std::vector<std::uint32_t>& points) {
  forbidden_.resize(lattice_->size(), 0);
  for (const std::uint32_t i : points) forbidden_[i] = 1;
  grow_anew();
}

void JointGrowth::grow_within(const std::vector<std::uint32_t>& points) {
  forbidden_.assign(lattice_->size(), 1);
  for (const std::uint32_t i : points) forbidden_[i] = 0;
  grow_anew();
}

void JointGrowth::grow_anew() {
  labels_.assign(labels_.size(), kNobody);
  way_m_.assign(way_m_.size(), kNoWay_m);
  bridges_.clear();
  bridged_.assign(bridged_.size(), 0);
  grow();
}

void JointGrowth::free_points(std::int16_t head) {
  freed_.clear();
  for (std::uint32_t i = 0; i < labels_.size(); ++i) {
    if (labels_[i] != head) continue;
    set(i, kNobody, kNoWay_m);
    freed_.push_back(i);
  }
}

/// Puts every point that may lead to a free one into the queue again.
void JointGrowth::queue_around_freed() {
  for (const std::uint32_t i : freed_) {
    const int u = static_cast<int>(i) % lattice_->width, v = static_cast<int>(i) / lattice_->width;
    for (const auto& [du, dv] : kNeighbors) {
      const auto n = lattice_->find(u + du, v + dv);
      if (!n || labels_[*n] == kNobody) continue;
      changed_[static_cast<std::size_t>(labels_[*n])] = true;
      queue(*n);
    }
  }
  for (const Bridge& bridge : bridges_) {
    if (labels_[bridge.from] != kNobody && labels_[bridge.to] == kNobody) queue(bridge.from);
  }
}

void JointGrowth::start(std::int16_t head) {
  const HeadCandidate& candidate = heads_[static_cast<std::size_t>(head)];
  const float depth_m = lattice_->depth_m[lattice_->index(candidate.u, candidate.v)];
  const float radius_m = params_.head_radius_m;
  const int radius_px = std::max(1, static_cast<int>(radius_m * lattice_->focal_px / depth_m));
  for (int v = candidate.v - radius_px; v <= candidate.v + radius_px; ++v) {
    for (int u = candidate.u - radius_px; u <= candidate.u + radius_px; ++u) {
      const auto i = lattice_->find(u, v);
      if (!i || way_m_[*i] == 0.0F || (!forbidden_.empty() && forbidden_[*i] != 0)) continue;
      if ((lattice_->level_m[*i] - candidate.center_m).squaredNorm() > radius_m * radius_m)
        continue;
      set(*i, head, 0.0F);
      changed_[static_cast<std::size_t>(head)] = true;
      queue(*i);
    }
  }
}

void JointGrowth::grow() {
  for (std::size_t k = 0; k < heads_.size(); ++k) {
    if (!dropped_[k]) start(static_cast<std::int16_t>(k));
  }
  for (; bucket_ < buckets_.size(); ++bucket_) {
    // The bucket may grow while it is walked: short steps land in it again.
    std::size_t next = 0;
    while (next < buckets_[bucket_].size()) {
      const std::uint32_t i = buckets_[bucket_][next++];
      if (bucket_of(way_m_[i]) == bucket_) visit(i);
    }
    buckets_[bucket_].clear();
  }
  bucket_ = 0;
}

void JointGrowth::visit(std::uint32_t i) {
  const int u = static_cast<int>(i) % lattice_->width, v = static_cast<int>(i) / lattice_->width;
  step_to_neighbors(i, u, v);
  step_behind(i, u, v);
}

void JointGrowth::step_to_neighbors(std::uint32_t i, int u, int v) {
  const float max_step_m = params_.longest_step_m(lattice_->depth_m[i]);
  for (const auto& [du, dv] : kNeighbors) {
    const auto n = lattice_->find(u + du, v + dv);
    if (!n) continue;
    const Eigen::Vector3f step_m = lattice_->level_m[*n] - lattice_->level_m[i];
    const float squared = step_m.squaredNorm();
    if (squared > max_step_m * max_step_m) continue;
    relax(i, *n,
          way_m_[i] + std::max(1e-3F, std::sqrt(squared)) +
              params_.depth_step_cost * std::abs(step_m.y()));
  }
}

void JointGrowth::step_behind(std::uint32_t i, int u, int v) {
  const float z_m = lattice_->depth_m[i];
  const float step_m = params_.longest_step_m(z_m);
  for (const auto& [du, dv] : kDirections) {
    const auto next = lattice_->find(u + du, v + dv);
    if (next && lattice_->depth_m[*next] >= z_m - step_m) continue;
    const auto n = find_behind(i, du, dv);
    if (!n) continue;
    if (bridged_[i] == 0) bridges_.push_back({i, *n});
    relax(i, *n,
          way_m_[i] + params_.gap_cost * (lattice_->level_m[*n] - lattice_->level_m[i]).norm());
  }
  bridged_[i] = 1;
}

/// The point where the surface at point i goes on, seen from it in one direction of the image: the
/// first at about its depth, after something nearer.
std::optional<std::uint32_t> JointGrowth::find_behind(std::uint32_t i, int du, int dv) {
  const int u = static_cast<int>(i) % lattice_->width, v = static_cast<int>(i) / lattice_->width;
  const float z_m = lattice_->depth_m[i], step_m = params_.longest_step_m(z_m);
  const float px_per_step = std::hypot(static_cast<float>(du), static_cast<float>(dv));
  const int steps = static_cast<int>(params_.max_gap_m * lattice_->focal_px / (z_m * px_per_step));
  float before_m = z_m;
  for (int k = 1; k <= steps; ++k) {
    const auto n = lattice_->find(u + k * du, v + k * dv);
    if (!n) continue;
    const float depth_m = lattice_->depth_m[*n];
    // What hides ends with a jump: a table that reaches back to the body does not.
    const bool uncovers = depth_m > before_m + step_m;
    before_m = depth_m;
    if (uncovers && std::abs(depth_m - z_m) <= params_.max_gap_depth_m)
      return may_be_a_limb(*n) ? n : std::nullopt;
    if (depth_m >= z_m - step_m) return std::nullopt;
  }
  return std::nullopt;
}

/// Whether the connected surface of a point is no wall, and more than noise.
bool JointGrowth::may_be_a_limb(std::uint32_t i) {
  if (!surfaces_) surfaces_ = find_surfaces(*lattice_, params_);
  const std::int32_t k = surfaces_->of_point[i];
  if (k < 0) return false;
  const Surface& surface = surfaces_->all[static_cast<std::size_t>(k)];
  return surface.area_m2 >= params_.min_part_m2 && surface.area_m2 <= params_.max_part_m2 &&
         surface.extent_m <= 2.0F * reach_.radius_m;
}

void JointGrowth::relax(std::uint32_t from, std::uint32_t to, float way_m) {
  if (!forbidden_.empty() && forbidden_[to] != 0) return;
  if (way_m >= way_m_[to] - kSameWay_m || way_m > params_.max_way_m ||
      !reachable(lattice_->level_m[to], labels_[from]))
    return;
  set(to, labels_[from], way_m);
  changed_[static_cast<std::size_t>(labels_[to])] = true;
  queue(to);
}

void JointGrowth::queue(std::uint32_t i) {
  buckets_[std::max(bucket_, bucket_of(way_m_[i]))].push_back(i);
}

bool JointGrowth::reachable(const Eigen::Vector3f& point_m, std::int16_t head) const {
  const Eigen::Vector3f& center_m = heads_[static_cast<std::size_t>(head)].center_m;
  if (point_m.z() > center_m.z() + reach_.above_m || point_m.z() < center_m.z() - reach_.below_m)
    return false;
  float radius_m = reach_.radius_m;
  if (lattice_->frame.ground_known) {
    if (point_m.z() < params_.ground_cut_m) return false;
    if (point_m.z() < params_.shin_height * center_m.z())
      radius_m = params_.shin_radius_m;
    else if (point_m.z() < params_.knee_height * center_m.z())
      radius_m = params_.knee_radius_m;
  }
  return (point_m - center_m).head<2>().squaredNorm() <= radius_m * radius_m;
}

std::vector<std::int16_t> grow_together(const Lattice& lattice,
                                        const std::vector<HeadCandidate>& heads,
                                        const JointGrowingParams& params,
                                        const ReachParams& reach) {
  return JointGrowth(lattice, heads, params, reach).labels();
}

}  // namespace limbcast::segmenter

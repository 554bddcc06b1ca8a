#include "modules/segmenter/seeds/head_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "common/units.hpp"

namespace limbcast::segmenter {
namespace {

/// From the surface to the head's centre [m]: half of the head's length (ISO 7250: 19 cm), less its
/// curvature.
constexpr float kHeadDepth_m = 0.085F;
/// A point this near to a head's centre is on it [m]: half of its length and hair.
constexpr float kNearHead_m = 0.15F;

struct Offset {
  float right_m, up_m;
};

/// On the face: depth as in the middle.
constexpr std::array<Offset, 9> kInside = {{{0.0F, 0.0F},
                                            {0.05F, 0.0F},
                                            {-0.05F, 0.0F},
                                            {0.0F, -0.06F},
                                            {0.0F, 0.06F},
                                            {0.035F, -0.05F},
                                            {-0.035F, -0.05F},
                                            {0.035F, 0.05F},
                                            {-0.035F, 0.05F}}};
constexpr float kInsideStep_m = 0.12F;
/// Samples that may be neither on the face nor behind something nearer, and samples on the face.
constexpr int kMaxElsewhere = 2, kMinInside = 5;
/// What a sample of the face behind something nearer counts.
constexpr float kHidden = 0.5F;
/// Around the head's upper half: farther, or nothing.
constexpr int kRingCount = 11;
constexpr float kRingRight_m = 0.155F, kRingUp_m = 0.175F, kRingStep_m = 0.13F;
constexpr float kMinRing = 5.0F;
/// Shoulders and chest: as near as the head.
constexpr std::array<float, 2> kTorsoDown_m = {0.30F, 0.38F};
constexpr int kTorsoColumns = 9;
constexpr float kTorsoSpacing_m = 0.07F, kTorsoStep_m = 0.28F;
/// Wider than this share of the row is no better: a wall has it all.
constexpr float kTorsoEnough = 0.6F, kTorsoWeight = 0.8F;
/// What a sample outside the image counts, and one on something nearer (an occluder), in the ring.
constexpr float kOutside = 0.5F, kNearer = 0.4F;

std::array<Offset, kRingCount> make_ring() {
  std::array<Offset, kRingCount> ring{};
  for (int i = 0; i < kRingCount; ++i) {
    const float angle_rad = static_cast<float>(-10 + 20 * i) * kPi<float> / 180.0F;
    ring[static_cast<std::size_t>(i)] = {kRingRight_m * std::cos(angle_rad),
                                         kRingUp_m * std::sin(angle_rad)};
  }
  return ring;
}

/// Looks up depths at offsets in metres around one pixel.
class Probe {
 public:
  explicit Probe(const Lattice& lattice)
      : lattice_(lattice),
        right_(-lattice.up.y(), lattice.up.x()),
        left_px_(lattice.wraps_around ? static_cast<float>(lattice.width) : 0.0F) {}

  void move_to(int u, int v, float depth_m) {
    center_ = Eigen::Vector2f(static_cast<float>(u) + 0.5F, static_cast<float>(v) + 0.5F);
    px_per_m_ = lattice_.focal_px / depth_m;
  }
  /// Depth there, 0 = hole, negative = outside the image.
  float depth_m(const Offset& offset) const {
    const Eigen::Vector2f at =
        center_ + px_per_m_ * (offset.right_m * right_ + offset.up_m * lattice_.up);
    if (at.y() < 0.0F || (at.x() < 0.0F && !lattice_.wraps_around)) return -1.0F;
    int u = static_cast<int>(at.x() + left_px_);
    const int v = static_cast<int>(at.y());
    if (lattice_.wraps_around) u %= lattice_.width;
    if (u >= lattice_.width || v >= lattice_.height) return -1.0F;
    return lattice_.depth_m[lattice_.index(u, v)];
  }

 private:
  const Lattice& lattice_;
  Eigen::Vector2f right_, center_;
  float px_per_m_ = 0.0F;
  float left_px_;  ///< makes columns left of the first of a panorama positive
};

float ring_score(const Probe& probe, float z_m) {
  static const std::array<Offset, kRingCount> ring = make_ring();
  float sum = 0.0F;
  for (const Offset& offset : ring) {
    const float q = probe.depth_m(offset);
    if (q < 0.0F)
      sum += kOutside;
    else if (q == 0.0F || q > z_m + kRingStep_m)
      sum += 1.0F;
    else if (q < z_m - kRingStep_m)
      sum += kNearer;
  }
  return sum;
}

float torso_score(const Probe& probe, float z_m) {
  float sum = 0.0F;
  for (const float down_m : kTorsoDown_m) {
    for (int i = 0; i < kTorsoColumns; ++i) {
      const int column = i - kTorsoColumns / 2;
      const float q = probe.depth_m({static_cast<float>(column) * kTorsoSpacing_m, -down_m});
      if (q < 0.0F)
        sum += kOutside;
      else if (q > 0.0F && std::abs(q - z_m) < kTorsoStep_m)
        sum += 1.0F;
    }
  }
  return sum / static_cast<float>(kTorsoColumns * kTorsoDown_m.size());
}

/// Score of a head in the middle of the probe; 0 where there is none.
float template_score(const Probe& probe, float z_m) {
  int inside = 0, hidden = 0, elsewhere = 0;
  for (const Offset& offset : kInside) {
    const float q = probe.depth_m(offset);
    if (q <= 0.0F || q > z_m + kInsideStep_m)
      ++elsewhere;
    else
      ++(q < z_m - kInsideStep_m ? hidden : inside);
    if (elsewhere > kMaxElsewhere) return 0.0F;
  }
  if (inside < kMinInside) return 0.0F;
  const float ring = ring_score(probe, z_m);
  if (ring < kMinRing) return 0.0F;
  const float face = static_cast<float>(inside) + kHidden * static_cast<float>(hidden);
  return face / static_cast<float>(kInside.size()) + ring / static_cast<float>(kRingCount) +
         kTorsoWeight * std::min(torso_score(probe, z_m), kTorsoEnough);
}

cv::Mat1f score_image(const Lattice& lattice, const HeadShapeParams& params) {
  cv::Mat1f scores(lattice.height, lattice.width, 0.0F);
  Probe probe(lattice);
  for (int v = 0; v < lattice.height; ++v) {
    for (int u = 0; u < lattice.width; ++u) {
      const std::size_t i = lattice.index(u, v);
      const float z_m = lattice.depth_m[i];
      if (z_m < params.min_depth_m || z_m > params.max_depth_m) continue;
      if (lattice.depth_noise.sigma_m(z_m) > params.max_noise_m) continue;
      const float height_m = lattice.level_m[i].z();
      if (lattice.frame.ground_known &&
          (height_m < params.min_height_m || height_m > params.max_height_m))
        continue;
      probe.move_to(u, v, z_m);
      scores(v, u) = template_score(probe, z_m);
    }
  }
  return scores;
}

/// Direction from the sensor to a place (level frame).
Eigen::Vector3f ray_to(const Lattice& lattice, const Eigen::Vector3f& place_m) {
  return (place_m - Eigen::Vector3f(0.0F, 0.0F, lattice.frame.sensor_height_m)).normalized();
}

}  // namespace

Eigen::Vector3f head_center(const Lattice& lattice, const Eigen::Vector3f& surface_m) {
  return surface_m + kHeadDepth_m * ray_to(lattice, surface_m);
}

Eigen::Vector3f head_surface(const Lattice& lattice, const Eigen::Vector3f& center_m) {
  return center_m - kHeadDepth_m * ray_to(lattice, center_m);
}

std::optional<HeadCandidate> head_near(const Lattice& lattice, const Eigen::Vector3f& center_m) {
  float nearest_m = kNearHead_m * kNearHead_m;
  std::optional<HeadCandidate> head;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    if (lattice.depth_m[i] <= 0.0F) continue;
    const float distance_m = (lattice.level_m[i] - center_m).squaredNorm();
    if (distance_m >= nearest_m) continue;
    nearest_m = distance_m;
    head.emplace();
    head->u = static_cast<int>(i) % lattice.width;
    head->v = static_cast<int>(i) / lattice.width;
    head->surface_m = lattice.level_m[i];
    head->center_m = center_m;
  }
  return head;
}

Eigen::Vector3f from_head(const Lattice& lattice, const HeadCandidate& head,
                          const Eigen::Vector3f& level_m) {
  const Eigen::Vector3f offset_m = level_m - head.center_m;
  // A camera's lattice has one direction of depth; a panorama's is the ray's.
  if (!lattice.wraps_around) return offset_m;
  const Eigen::Vector2f away = head.center_m.head<2>().normalized();
  return {away.y() * offset_m.x() - away.x() * offset_m.y(), away.dot(offset_m.head<2>()),
          offset_m.z()};
}

std::vector<HeadCandidate> find_heads(const Lattice& lattice, const HeadShapeParams& params) {
  const cv::Mat1f scores = score_image(lattice, params);
  cv::Mat1f smooth;
  cv::GaussianBlur(scores, smooth, cv::Size(5, 5), 0.0);

  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    if (scores(static_cast<int>(i)) > 0.0F && smooth(static_cast<int>(i)) > params.min_score)
      order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return smooth(static_cast<int>(a)) > smooth(static_cast<int>(b));
  });
  std::vector<HeadCandidate> heads;
  for (const std::size_t i : order) {
    const Eigen::Vector3f& point = lattice.level_m[i];
    const bool taken = std::any_of(heads.begin(), heads.end(), [&](const HeadCandidate& head) {
      return (head.surface_m - point).norm() < params.separation_m;
    });
    if (taken) continue;
    const auto width = static_cast<std::size_t>(lattice.width);
    heads.push_back({static_cast<int>(i % width), static_cast<int>(i / width), point,
                     head_center(lattice, point), smooth(static_cast<int>(i))});
    if (static_cast<int>(heads.size()) >= params.max_candidates) break;
  }
  return heads;
}

}  // namespace limbcast::segmenter

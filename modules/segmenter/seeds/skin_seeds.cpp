#include "modules/segmenter/seeds/skin_seeds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace limbcast::segmenter {
namespace {

/// 1 where the lattice shows skin.
std::vector<std::uint8_t> skin_mask(const Cloud& cloud, const Lattice& lattice,
                                    const SkinColor& skin, float min_log_ratio) {
  std::vector<std::uint8_t> mask(lattice.size(), 0);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    mask[i] =
        lattice.depth_m[i] > 0.0F && skin.log_ratio(cloud.colors[lattice.source[i]]) > min_log_ratio
            ? 1
            : 0;
  }
  return mask;
}

/// Takes the part that holds `start` out of the mask and returns its points.
std::vector<std::size_t> take_part(const Lattice& lattice, std::size_t start, float max_step_m,
                                   std::vector<std::uint8_t>& mask) {
  std::vector<std::size_t> part = {start};
  mask[start] = 0;
  for (std::size_t j = 0; j < part.size(); ++j) {
    const std::size_t i = part[j];
    const int u = static_cast<int>(i) % lattice.width, v = static_cast<int>(i) / lattice.width;
    for (const auto& [du, dv] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const auto n = lattice.find(u + du, v + dv);
      if (!n || mask[*n] == 0) continue;
      if (std::abs(lattice.depth_m[*n] - lattice.depth_m[i]) > max_step_m) continue;
      mask[*n] = 0;
      part.push_back(*n);
    }
  }
  return part;
}

HeadCandidate seed_of(const Lattice& lattice, const std::vector<std::size_t>& part, float area_m2) {
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (const std::size_t i : part) middle += lattice.level_m[i];
  middle /= static_cast<float>(part.size());
  const std::size_t seed =
      *std::min_element(part.begin(), part.end(), [&](std::size_t a, std::size_t b) {
        return (lattice.level_m[a] - middle).squaredNorm() <
               (lattice.level_m[b] - middle).squaredNorm();
      });
  const auto width = static_cast<std::size_t>(lattice.width);
  HeadCandidate candidate;
  candidate.u = static_cast<int>(seed % width);
  candidate.v = static_cast<int>(seed / width);
  candidate.surface_m = lattice.level_m[seed];
  candidate.center_m = head_center(lattice, candidate.surface_m);
  candidate.score = area_m2;
  candidate.kind = SeedKind::kSkin;
  return candidate;
}

}  // namespace

std::vector<HeadCandidate> find_skin_parts(const Cloud& cloud, const Lattice& lattice,
                                           const SkinColor& skin, const SkinParams& params) {
  std::vector<HeadCandidate> parts;
  if (cloud.colors.empty()) return parts;
  std::vector<std::uint8_t> mask = skin_mask(cloud, lattice, skin, params.min_log_ratio);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) continue;
    const std::vector<std::size_t> part = take_part(lattice, i, params.max_step_m, mask);
    float area_m2 = 0.0F;
    for (const std::size_t k : part)
      area_m2 += std::pow(lattice.depth_m[k] / lattice.focal_px, 2.0F);
    if (static_cast<int>(part.size()) < params.min_points || area_m2 < params.min_area_m2 ||
        area_m2 > params.max_area_m2) {
      continue;
    }
    parts.push_back(seed_of(lattice, part, area_m2));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const HeadCandidate& a, const HeadCandidate& b) {
    return a.score > b.score;
  });
  return parts;
}

}  // namespace limbcast::segmenter

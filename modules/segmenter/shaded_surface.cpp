#include "modules/segmenter/shaded_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/median.hpp"

namespace limbcast::segmenter {
namespace {

/// Depth of the nearest point that each pixel shows [m], 0 where there is none.
cv::Mat1f nearest_depths(const std::vector<Eigen::Vector3f>& points_m,
                         const PinholeCamera& camera) {
  cv::Mat1f depth_m(camera.height, camera.width, 0.0F);
  for (const Eigen::Vector3f& point_m : points_m) {
    if (!(point_m.z() > 0.0F)) continue;
    const Eigen::Vector2f px = camera.project(point_m).array().round();
    if (!(px.minCoeff() >= 0.0F) || !(px.x() < static_cast<float>(camera.width)) ||
        !(px.y() < static_cast<float>(camera.height)))
      continue;
    float& nearest_m = depth_m(static_cast<int>(px.y()), static_cast<int>(px.x()));
    if (nearest_m == 0.0F || point_m.z() < nearest_m) nearest_m = point_m.z();
  }
  return depth_m;
}

/// A piece of surface between three points of which each has a pixel of its own.
struct Triangle {
  std::array<Eigen::Vector2f, 3> px;

  float longest_edge_px() const {
    return std::max({(px[0] - px[1]).norm(), (px[1] - px[2]).norm(), (px[2] - px[0]).norm()});
  }
};

/// Delaunay's triangles between the pixels that have a depth: where a scanner's beams stand far
/// apart, they are long that way.
std::vector<Triangle> triangles_between(const cv::Mat1f& depth_m) {
  const cv::Rect image(0, 0, depth_m.cols, depth_m.rows);
  cv::Subdiv2D subdivision(image);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      if (depth_m(v, u) > 0.0F)
        subdivision.insert(cv::Point2f(static_cast<float>(u), static_cast<float>(v)));
    }
  }
  std::vector<cv::Vec6f> corners;
  subdivision.getTriangleList(corners);
  std::vector<Triangle> triangles;
  for (const cv::Vec6f& c : corners) {
    const Triangle triangle{{{{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}}}};
    // OpenCV's triangles at the outside end in points beyond the image.
    if (std::all_of(triangle.px.begin(), triangle.px.end(), [&](const Eigen::Vector2f& px) {
          return image.contains(cv::Point(static_cast<int>(px.x()), static_cast<int>(px.y())));
        }))
      triangles.push_back(triangle);
  }
  return triangles;
}

/// How far apart the sensor's points stand, the wider way [px].
float spacing_of(const std::vector<Triangle>& triangles) {
  std::vector<float> edges_px;
  edges_px.reserve(triangles.size());
  for (const Triangle& triangle : triangles) edges_px.push_back(triangle.longest_edge_px());
  return median(std::move(edges_px));
}

/// Fills a triangle whose corners have depths; not one that joins a limb with what is behind it.
void fill(const Triangle& triangle, float max_jump_m, cv::Mat1f& depth_m) {
  const auto& px = triangle.px;
  Eigen::Vector3f corners_m;
  for (int k = 0; k < 3; ++k)
    corners_m[k] = depth_m(static_cast<int>(px[k].y()), static_cast<int>(px[k].x()));
  if (corners_m.maxCoeff() - corners_m.minCoeff() > max_jump_m) return;
  Eigen::Matrix2f edges_px;
  edges_px << px[1] - px[0], px[2] - px[0];
  if (edges_px.determinant() == 0.0F) return;
  const Eigen::Matrix2f shares_from_px = edges_px.inverse();
  const Eigen::Vector2f first = px[0].cwiseMin(px[1]).cwiseMin(px[2]);
  const Eigen::Vector2f last = px[0].cwiseMax(px[1]).cwiseMax(px[2]);
  constexpr float kRounding = 1e-3F;
  for (int v = static_cast<int>(first.y()); v <= static_cast<int>(last.y()); ++v) {
    for (int u = static_cast<int>(first.x()); u <= static_cast<int>(last.x()); ++u) {
      const Eigen::Vector2f shares =
          shares_from_px * (Eigen::Vector2f(static_cast<float>(u), static_cast<float>(v)) - px[0]);
      if (shares.minCoeff() < -kRounding || shares.sum() > 1.0F + kRounding) continue;
      depth_m(v, u) = (1.0F - shares.sum()) * corners_m[0] + shares.dot(corners_m.tail<2>());
    }
  }
}

/// Depths averaged over their neighbours that have one.
cv::Mat1f smoothed(const cv::Mat1f& depth_m, float sigma_px) {
  cv::Mat1f known, sum, weight;
  cv::Mat(depth_m > 0.0F).convertTo(known, CV_32F, 1.0 / 255.0);
  cv::GaussianBlur(depth_m, sum, {}, sigma_px);
  cv::GaussianBlur(known, weight, {}, sigma_px);
  cv::Mat1f result(depth_m.size(), 0.0F);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      if (depth_m(v, u) > 0.0F) result(v, u) = sum(v, u) / weight(v, u);
    }
  }
  return result;
}

/// Towards the sensor and away from the surface, at a pixel that has a depth.
Eigen::Vector3f normal_at(const cv::Mat1f& depth_m, int u, int v, float focal_px,
                          float max_jump_m) {
  const float here_m = depth_m(v, u);
  const auto beside = [&](int du, int dv) {
    const int column = std::clamp(u + du, 0, depth_m.cols - 1),
              row = std::clamp(v + dv, 0, depth_m.rows - 1);
    const float there_m = depth_m(row, column);
    return there_m > 0.0F && std::abs(there_m - here_m) <= max_jump_m ? there_m : here_m;
  };
  const float two_pixels_m = 2.0F * here_m / focal_px;
  return Eigen::Vector3f((beside(1, 0) - beside(-1, 0)) / two_pixels_m,
                         (beside(0, 1) - beside(0, -1)) / two_pixels_m, -1.0F)
      .normalized();
}

}  // namespace

cv::Mat3b draw_shaded(const std::vector<Eigen::Vector3f>& points_m, const PinholeCamera& camera,
                      const ShadedSurfaceParams& params) {
  cv::Mat1f depth_m = nearest_depths(points_m, camera);
  const std::vector<Triangle> triangles = triangles_between(depth_m);
  const float spacing_px = triangles.empty() ? 0.0F : spacing_of(triangles);
  const float longest_px = params.max_gap_spacings * spacing_px + 1.0F;
  for (const Triangle& triangle : triangles) {
    if (triangle.longest_edge_px() <= longest_px) fill(triangle, params.max_jump_m, depth_m);
  }
  depth_m = smoothed(depth_m, std::max(params.min_smoothing_px, 0.5F * spacing_px));

  const Eigen::Vector3f to_lamp = Eigen::Vector3f(params.to_lamp.data()).normalized();
  const cv::Vec3b wall(params.wall.data()), surface(params.surface.data());
  const auto focal_px = static_cast<float>(camera.fx);
  cv::Mat3b picture(depth_m.size(), wall);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      if (depth_m(v, u) == 0.0F) continue;
      const float lit =
          std::max(0.0F, to_lamp.dot(normal_at(depth_m, u, v, focal_px, params.max_jump_m)));
      picture(v, u) = surface * (params.ambient + (1.0F - params.ambient) * lit);
    }
  }
  return picture;
}

}  // namespace limbcast::segmenter

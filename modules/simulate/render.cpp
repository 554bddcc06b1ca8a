#include "modules/simulate/render.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "modules/simulate/texture.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3f;

Vector3f ray_of(const PinholeCamera& camera, int u, int v) {
  return camera.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F).normalized();
}

/// Calls `visit(u, v, hit)` for each pixel that met something, rows in parallel.
template <class Visit>
void for_each_hit(const HitImage& hits, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<int>(0, hits.height),
                    [&](const tbb::blocked_range<int>& rows) {
                      for (int v = rows.begin(); v != rows.end(); ++v) {
                        for (int u = 0; u < hits.width; ++u) {
                          if (hits.at(u, v)) visit(u, v, hits.at(u, v));
                        }
                      }
                    });
}

}  // namespace

HitImage look(const World& world, const PinholeCamera& camera, const Vector3f& offset_m) {
  RayGrid rays;
  rays.width = camera.width;
  rays.height = camera.height;
  rays.origin = offset_m;
  rays.direction = [&camera](int u, int v) { return ray_of(camera, u, v); };
  return raycast(world, rays);
}

cv::Mat depth_image(const HitImage& hits, const PinholeCamera& camera) {
  cv::Mat depth(hits.height, hits.width, CV_32F, cv::Scalar(0));
  for_each_hit(hits, [&](int u, int v, const Hit& hit) {
    depth.at<float>(v, u) = hit.range_m * ray_of(camera, u, v).z();
  });
  return depth;
}

cv::Mat person_mask(const World& world, const HitImage& hits) {
  cv::Mat mask(hits.height, hits.width, CV_8U, cv::Scalar(0));
  for_each_hit(hits, [&](int u, int v, const Hit& hit) {
    mask.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(person_of(world, hit));
  });
  return mask;
}

cv::Mat part_labels(const World& world, const HitImage& hits) {
  cv::Mat labels(hits.height, hits.width, CV_8U, cv::Scalar(0));
  for_each_hit(hits, [&](int u, int v, const Hit& hit) {
    if (person_of(world, hit) > 0)
      labels.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(part_of(world, hit));
  });
  return labels;
}

cv::Mat facing_image(const World& world, const HitImage& hits, const PinholeCamera& camera,
                     const Vector3f& offset_m) {
  cv::Mat facing(hits.height, hits.width, CV_32F, cv::Scalar(0));
  for_each_hit(hits, [&](int u, int v, const Hit& hit) {
    const Vector3f direction = ray_of(camera, u, v);
    facing.at<float>(v, u) =
        std::abs(normal_at(world, hit, offset_m + hit.range_m * direction).dot(direction));
  });
  return facing;
}

cv::Mat color_image(const Scenario& scenario, const HitImage& hits, const PinholeCamera& camera,
                    Rng noise, const ShadingParams& params, const Vector3f& offset_m) {
  cv::Mat image(hits.height, hits.width, CV_32FC3, cv::Scalar(235, 215, 190));  // the sky
  const World& world = scenario.world;
  for_each_hit(hits, [&](int u, int v, const Hit& hit) {
    const Vector3f direction = ray_of(camera, u, v);
    const Vector3f point = offset_m + hit.range_m * direction;
    const float lambert = std::max(0.0F, normal_at(world, hit, point).dot(scenario.light));
    const float light = static_cast<float>(params.ambient + (1.0 - params.ambient) * lambert);
    const float footprint = hit.range_m / static_cast<float>(camera.fx);
    const Vector3f color =
        light * texture_color(material_of(world, hit), texture_point(world, hit, point), footprint);
    image.at<cv::Vec3f>(v, u) = {color.x(), color.y(), color.z()};
  });
  cv::GaussianBlur(image, image, {}, params.blur_px);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      for (int channel = 0; channel < 3; ++channel) {
        image.at<cv::Vec3f>(v, u)[channel] +=
            static_cast<float>(params.noise_grey) * noise.pixel_noise();
      }
    }
  }
  cv::Mat result;
  image.convertTo(result, CV_8U);
  return result;
}

}  // namespace limbcast::simulate

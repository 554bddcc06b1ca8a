// Coding of the messages of a VGA frame of the demo log, beside the coders of OpenCV and PCL. The
// counter kB is the size of what goes over the network.

#include <benchmark/benchmark.h>
#include <pcl/compression/octree_pointcloud_compression.h>
#include <pcl/point_types.h>

#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "common/lcm_io/image_codec.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/quantization.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "tests/support/demo_frame.hpp"

namespace limbcast {
namespace {

constexpr int kJpegQuality = 85;  // what live cameras are coded with by default
constexpr double kBytesPerKilobyte = 1000.0;

using test::demo_frame;

void set_size(benchmark::State& state, std::size_t bytes) {
  state.counters["kB"] = static_cast<double>(bytes) / kBytesPerKilobyte;
}

void encode_stereo_images(benchmark::State& state) {
  const StereoImages& images = demo_frame().images;
  int bytes = 0;
  for (auto _ : state) {
    bytes = lcm_io::to_message(images, lcm_io::ImageCoding::kJpeg, kJpegQuality).getEncodedSize();
  }
  set_size(state, static_cast<std::size_t>(bytes));
}
BENCHMARK(encode_stereo_images)->Unit(benchmark::kMillisecond);

void decode_stereo_images(benchmark::State& state) {
  const auto message =
      lcm_io::to_message(demo_frame().images, lcm_io::ImageCoding::kJpeg, kJpegQuality);
  for (auto _ : state) benchmark::DoNotOptimize(lcm_io::from_message(message));
}
BENCHMARK(decode_stereo_images)->Unit(benchmark::kMillisecond);

void encode_point_cloud(benchmark::State& state) {
  const Cloud& cloud = demo_frame().cloud;
  int bytes = 0;
  for (auto _ : state) bytes = lcm_io::to_message(cloud, kJpegQuality).getEncodedSize();
  set_size(state, static_cast<std::size_t>(bytes));
}
BENCHMARK(encode_point_cloud)->Unit(benchmark::kMillisecond);

void decode_point_cloud(benchmark::State& state) {
  const auto message = lcm_io::to_message(demo_frame().cloud, kJpegQuality);
  for (auto _ : state) benchmark::DoNotOptimize(lcm_io::from_message(message));
}
BENCHMARK(decode_point_cloud)->Unit(benchmark::kMillisecond);

/// The same steps of inverse depth as a 16-bit PNG, and the colours as JPEG.
void encode_point_cloud_opencv(benchmark::State& state) {
  const Cloud& cloud = demo_frame().cloud;
  std::vector<std::uint8_t> depth_png, color_jpeg;
  for (auto _ : state) {
    std::vector<float> depths_m;
    depths_m.reserve(cloud.points_m.size());
    for (const auto& point : cloud.points_m) depths_m.push_back(point.z());
    auto codes =
        lcm_io::quantize_depths(depths_m, lcm_io::inverse_depth_scale(cloud.stamp.depth_noise));
    cv::imencode(".png", cv::Mat(cloud.height, cloud.width, CV_16U, codes.data()), depth_png);
    const cv::Mat colors(cloud.height, cloud.width, CV_8UC3, const_cast<Bgr*>(cloud.colors.data()));
    cv::imencode(".jpg", colors, color_jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  }
  set_size(state, depth_png.size() + color_jpeg.size());
}
BENCHMARK(encode_point_cloud_opencv)->Unit(benchmark::kMillisecond);

/// PCL's octree coder, centimetre voxels, points to 5 mm: coarser than ours nearer than 3 m.
void encode_point_cloud_pcl(benchmark::State& state) {
  const Cloud& cloud = demo_frame().cloud;
  const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZRGBA>>();
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    if (cloud.is_hole(i)) continue;
    pcl::PointXYZRGBA point(cloud.colors[i].r, cloud.colors[i].g, cloud.colors[i].b, 255);
    point.getVector3fMap() = cloud.points_m[i];
    points->push_back(point);
  }
  std::size_t bytes = 0;
  for (auto _ : state) {
    pcl::io::OctreePointCloudCompression<pcl::PointXYZRGBA> coder(
        pcl::io::MED_RES_ONLINE_COMPRESSION_WITH_COLOR);
    std::ostringstream stream;
    coder.encodePointCloud(points, stream);
    bytes = stream.str().size();
  }
  set_size(state, bytes);
}
BENCHMARK(encode_point_cloud_pcl)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace limbcast

BENCHMARK_MAIN();

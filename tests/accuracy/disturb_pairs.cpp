// Disturbs a recorded folder of stereo pairs as cameras do that are not new, not in focus or not in
// the light, for conditions.sh: limbcast-disturb-pairs FOLDER OUT CONDITION writes FOLDER's images,
// disturbed, with its calibration and truth, to OUT. Without arguments it lists the conditions. The
// same images come out every time.

#include <boost/algorithm/string/predicate.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// One image of a pair, before and after.
using Disturbance = std::function<cv::Mat(const cv::Mat& bgr, bool is_right, cv::RNG& random)>;

/// Light that falls on the sensor makes brightness by this power (sRGB, nearly).
constexpr double kGamma = 2.2;

cv::Mat3f light_of(const cv::Mat& bgr) {
  cv::Mat3f light;
  bgr.convertTo(light, CV_32F, 1.0 / 255.0);
  cv::pow(light, kGamma, light);
  return light;
}

cv::Mat image_of(const cv::Mat3f& light) {
  cv::Mat3f brightness = cv::max(light, 0.0F);
  cv::pow(brightness, 1.0 / kGamma, brightness);
  cv::Mat bgr;
  brightness.convertTo(bgr, CV_8U, 255.0);
  return bgr;
}

cv::Mat with_noise(const cv::Mat& image, double sigma, cv::RNG& random) {
  cv::Mat noise(image.size(), CV_32FC3), sum;
  random.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  image.convertTo(sum, CV_32F);
  sum += noise;
  cv::Mat result;
  sum.convertTo(result, image.depth());
  return result;
}

cv::Mat moved(const cv::Mat& image, const cv::Matx23d& motion) {
  cv::Mat result;
  cv::warpAffine(image, result, motion, image.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return result;
}

/// The right camera's rows stand so much lower.
Disturbance lower_rows(double rows_px) {
  return [=](const cv::Mat& image, bool is_right, cv::RNG&) {
    return is_right ? moved(image, {1, 0, 0, 0, 1, rows_px}) : image;
  };
}

Disturbance rolled(double degrees) {
  return [=](const cv::Mat& image, bool is_right, cv::RNG&) {
    if (!is_right) return image;
    const cv::Point2f middle(0.5F * static_cast<float>(image.cols),
                             0.5F * static_cast<float>(image.rows));
    const cv::Mat1d motion = cv::getRotationMatrix2D(middle, degrees, 1.0);
    return moved(image, cv::Matx23d(motion.ptr<double>()));
  };
}

Disturbance noisy(double sigma) {
  return
      [=](const cv::Mat& image, bool, cv::RNG& random) { return with_noise(image, sigma, random); };
}

/// So much of the light; noise of the sensor's reading, as a share of its white.
Disturbance lit(double share, double noise = 0.0) {
  return [=](const cv::Mat& image, bool, cv::RNG& random) {
    const cv::Mat3f light = light_of(image) * share;
    return image_of(noise > 0.0 ? cv::Mat3f(with_noise(light, noise, random)) : light);
  };
}

Disturbance blurred(double sigma_px, bool right_alone) {
  return [=](const cv::Mat& image, bool is_right, cv::RNG&) {
    if (right_alone && !is_right) return image;
    cv::Mat result;
    cv::GaussianBlur(image, result, {}, sigma_px);
    return result;
  };
}

Disturbance swept(int width_px) {
  return [=](const cv::Mat& image, bool, cv::RNG&) {
    cv::Mat result;
    cv::blur(image, result, {width_px, 1});
    return result;
  };
}

Disturbance only_right(const Disturbance& disturbance) {
  return [=](const cv::Mat& image, bool is_right, cv::RNG& random) {
    return is_right ? disturbance(image, is_right, random) : image;
  };
}

Disturbance coded(int jpeg_quality) {
  return [=](const cv::Mat& image, bool, cv::RNG&) {
    std::vector<uchar> bytes;
    cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
    return cv::imdecode(bytes, cv::IMREAD_COLOR);
  };
}

/// In the order of the table.
const std::vector<std::pair<std::string, Disturbance>>& conditions() {
  static const std::vector<std::pair<std::string, Disturbance>> kConditions = {
      {"as-recorded", [](const cv::Mat& image, bool, cv::RNG&) { return image; }},
      {"right-rows-0.5-px-lower", lower_rows(0.5)},
      {"right-rows-1-px-lower", lower_rows(1.0)},
      {"right-rows-2-px-lower", lower_rows(2.0)},
      {"right-camera-rolled-0.3-deg", rolled(0.3)},
      {"noise-4", noisy(4.0)},
      {"noise-8", noisy(8.0)},
      {"quarter-of-the-light", lit(0.25)},
      {"quarter-of-the-light-and-noise", lit(0.25, 0.003)},
      {"twelfth-of-the-light-and-noise", lit(0.08, 0.004)},
      {"overexposed-2.5-times", lit(2.5)},
      {"right-camera-0.6-of-the-light", only_right(lit(0.6))},
      {"out-of-focus-1.2-px", blurred(1.2, false)},
      {"right-camera-out-of-focus-1.2-px", blurred(1.2, true)},
      {"swept-9-px", swept(9)},
      {"jpeg-quality-50", coded(50)},
  };
  return kConditions;
}

void disturb(const fs::path& folder, const fs::path& out, const Disturbance& disturbance) {
  fs::create_directories(out);
  const std::set<fs::path> files{fs::directory_iterator(folder), fs::directory_iterator()};
  cv::RNG random(1);
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    const bool is_right = boost::algorithm::ends_with(name, "_right.jpg");
    if (is_right || boost::algorithm::ends_with(name, "_left.jpg")) {
      const cv::Mat image = cv::imread(file.string());
      cv::imwrite((out / name).string(), disturbance(image, is_right, random),
                  {cv::IMWRITE_JPEG_QUALITY, 95});
    } else if (!boost::algorithm::ends_with(name, ".png")) {  // depth and masks
      fs::copy_file(file, out / name, fs::copy_options::overwrite_existing);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1) {
    for (const auto& [name, disturbance] : conditions()) std::printf("%s\n", name.c_str());
    return 0;
  }
  if (argc == 4) {
    for (const auto& [name, disturbance] : conditions()) {
      if (name != argv[3]) continue;
      disturb(argv[1], argv[2], disturbance);
      return 0;
    }
  }
  std::fprintf(stderr,
               "usage: limbcast-disturb-pairs FOLDER OUT CONDITION, or without arguments for the "
               "conditions\n");
  return 2;
}

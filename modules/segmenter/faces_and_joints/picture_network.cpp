#include "modules/segmenter/faces_and_joints/picture_network.hpp"

#include <opencv2/imgproc.hpp>

namespace limbcast::segmenter {

void write_rgb(const cv::Mat3b& picture, double scale, double shift, float* input) {
  cv::Mat3b rgb;
  cv::cvtColor(picture, rgb, cv::COLOR_BGR2RGB);
  cv::Mat3f numbers(picture.rows, picture.cols, reinterpret_cast<cv::Vec3f*>(input));
  rgb.convertTo(numbers, CV_32F, scale, shift);
}

}  // namespace limbcast::segmenter

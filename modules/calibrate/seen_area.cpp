#include "modules/calibrate/seen_area.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace limbcast::calibrate {

SeenAreas whole_images(const cv::Size& size) {
  const cv::Mat all(size, CV_8UC1, cv::Scalar(255));
  return {all, all};
}

void SeenAreaFinder::add(const cv::Mat& left, const cv::Mat& right) {
  for (const auto& [brightest, image] : {std::pair(&left_, &left), std::pair(&right_, &right)}) {
    if (brightest->empty())
      *brightest = image->clone();
    else
      cv::max(*brightest, *image, *brightest);
  }
}

SeenAreas SeenAreaFinder::areas(LensModel model) const {
  if (model == LensModel::kPinhole) return whole_images(left_.size());
  return {lit_area(left_), lit_area(right_)};
}

cv::Mat SeenAreaFinder::lit_area(const cv::Mat& brightest) const {
  const int spot_px =
      std::max(1, cvRound(params_.min_spot_share * std::max(brightest.cols, brightest.rows)));
  cv::Mat without_spots;
  cv::morphologyEx(brightest, without_spots, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {spot_px, spot_px}));
  double largest = 0.0;
  cv::minMaxLoc(without_spots, nullptr, &largest);
  std::vector<cv::Point> pixels;
  cv::findNonZero(without_spots > params_.dark_share * largest, pixels);
  if (pixels.empty()) return whole_images(brightest.size()).left;
  std::vector<cv::Point> hull;
  cv::convexHull(pixels, hull);
  cv::Point2f centre;
  float radius = 0.0F;
  cv::minEnclosingCircle(hull, centre, radius);
  cv::Mat area(brightest.size(), CV_8UC1, cv::Scalar(0));
  cv::circle(area, centre, cvCeil(radius), 255, cv::FILLED);
  return area;
}

}  // namespace limbcast::calibrate

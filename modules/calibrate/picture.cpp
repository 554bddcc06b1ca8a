#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/formatted.hpp"
#include "modules/calibrate/coverage.hpp"
#include "modules/calibrate/report.hpp"

namespace limbcast::calibrate {
namespace {

constexpr int kImageWidth_px = 640, kMargin_px = 40, kChartHeight_px = 220;
const cv::Scalar kPaper(255, 255, 255), kInk(40, 40, 40), kCovered(225, 240, 225),
    kDark(200, 200, 200), kGrid(220, 220, 220);
const cv::Scalar kLeftColor(200, 120, 30), kRightColor(40, 110, 230), kEpipolarColor(60, 160, 60);

void write_words(cv::Mat& canvas, const std::string& words, const cv::Point& place,
                 const cv::Scalar& color = kInk) {
  constexpr double kSize = 0.45;
  cv::putText(canvas, words, place, cv::FONT_HERSHEY_SIMPLEX, kSize, color, 1, cv::LINE_AA);
}

void paint(cv::Mat& canvas, const cv::Scalar& color, const cv::Mat& area) {
  cv::Mat resized;
  cv::resize(area, resized, canvas.size(), 0.0, 0.0, cv::INTER_NEAREST);
  canvas.setTo(color, resized);
}

/// One camera's image: where the lens shows nothing, where boards were, and each of their points.
void draw_coverage(cv::Mat canvas, const StereoFit& fit, Side side, const cv::Mat& seen) {
  paint(canvas, kDark, ~seen);
  paint(canvas, kCovered, covered_area(fit.views, side, seen.size()));
  const double scale = static_cast<double>(canvas.cols) / seen.cols;
  const cv::Scalar& color = side == Side::kLeft ? kLeftColor : kRightColor;
  for (const View& view : fit.views) {
    for (const cv::Point2f& pixel : (side == Side::kLeft ? view.left : view.right).pixels)
      cv::circle(canvas, {cvRound(scale * pixel.x), cvRound(scale * pixel.y)}, 2, color, cv::FILLED,
                 cv::LINE_AA);
  }
  cv::rectangle(canvas, {0, 0, canvas.cols, canvas.rows}, kInk);
}

/// Views are named where each has this much room.
constexpr double kNameWidth_px = 60.0;

/// Three bars a view: reprojection left and right, epipolar.
class ErrorChart {
 public:
  ErrorChart(cv::Mat canvas, double limit_px) : canvas_(std::move(canvas)), limit_px_(limit_px) {}

  void draw(const std::vector<ViewFit>& figures) {
    draw_lines();
    const double step = (canvas_.cols - kMargin_px) / static_cast<double>(figures.size());
    for (std::size_t i = 0; i < figures.size(); ++i) {
      const double from = kMargin_px + step * static_cast<double>(i);
      const ViewFit& view = figures[i];
      draw_bar(from, step / 4.0, view.reprojection_left_px, kLeftColor);
      draw_bar(from + step / 4.0, step / 4.0, view.reprojection_right_px, kRightColor);
      draw_bar(from + step / 2.0, step / 4.0, view.epipolar_px, kEpipolarColor);
      if (step > kNameWidth_px) write_words(canvas_, view.name, {cvRound(from), canvas_.rows - 6});
    }
  }

 private:
  int row_of(double error_px) const {
    return cvRound((canvas_.rows - 1) * (1.0 - std::min(1.0, error_px / limit_px_)));
  }
  void draw_lines() {
    constexpr int kLines = 4;
    for (int i = 0; i <= kLines; ++i) {
      const double error_px = limit_px_ * i / kLines;
      const int row = row_of(error_px);
      cv::line(canvas_, {kMargin_px, row}, {canvas_.cols, row}, kGrid);
      write_words(canvas_, formatted("%.2f", error_px), {0, std::max(10, row)});
    }
  }
  void draw_bar(double from, double width, double error_px, const cv::Scalar& color) {
    cv::rectangle(canvas_, cv::Point(cvRound(from), row_of(error_px)),
                  cv::Point(cvRound(from + width) - 1, canvas_.rows - 1), color, cv::FILLED);
  }

  cv::Mat canvas_;
  double limit_px_;
};

double largest_error_px(const std::vector<ViewFit>& figures) {
  double largest = 0.0;
  for (const ViewFit& view : figures)
    largest = std::max(
        {largest, view.reprojection_left_px, view.reprojection_right_px, view.epipolar_px});
  return largest;
}

}  // namespace

cv::Mat draw_report(const StereoFit& fit, const SeenAreas& seen) {
  const PinholeCamera& camera = fit.calibration.left.camera;
  const int image_height =
      cvRound(static_cast<double>(kImageWidth_px) * camera.height / camera.width);
  const int chart_top = image_height + 3 * kMargin_px;
  const int right_from = kImageWidth_px + 2 * kMargin_px;
  const int width = right_from + kImageWidth_px + kMargin_px;
  cv::Mat canvas(chart_top + kChartHeight_px + kMargin_px, width, CV_8UC3, kPaper);

  for (const auto& [side, from, name] : {std::tuple(Side::kLeft, kMargin_px, "left"),
                                         std::tuple(Side::kRight, right_from, "right")}) {
    draw_coverage(canvas({from, kMargin_px, kImageWidth_px, image_height}), fit, side,
                  side == Side::kLeft ? seen.left : seen.right);
    const double share = coverage(fit.views, side, seen);
    write_words(canvas, formatted("%s image: boards cover %.0f %%", name, 100.0 * share),
                {from, kMargin_px - 12});
  }
  write_words(canvas,
              formatted("error of each view [px]; all: reprojection %.2f, epipolar %.2f",
                        fit.reprojection_px, fit.epipolar_px),
              {kMargin_px, chart_top - 30});
  write_words(canvas, "reprojection left", {kMargin_px, chart_top - 12}, kLeftColor);
  write_words(canvas, "right", {kMargin_px + 140, chart_top - 12}, kRightColor);
  write_words(canvas, "epipolar", {kMargin_px + 200, chart_top - 12}, kEpipolarColor);
  ErrorChart(canvas({kMargin_px, chart_top, width - 2 * kMargin_px, kChartHeight_px}),
             1.1 * largest_error_px(fit.figures))
      .draw(fit.figures);
  return canvas;
}

}  // namespace limbcast::calibrate

#include "modules/evaluate/picture.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

namespace limbcast::evaluate {
namespace {

constexpr int kWidth = 620, kHeight = 480, kMargin = 60;  // of one plot [px]
const cv::Scalar kInk(40, 40, 40), kGrid(225, 225, 225);

struct Curve {
  std::string name;
  std::vector<double> values;
  int total = 0;
  cv::Scalar color;
};

/// A plot of shares (0 to 100 %) over errors (0 to `limit`).
class Plot {
 public:
  Plot(cv::Mat canvas, double limit) : canvas_(std::move(canvas)), limit_(limit) {}

  void draw_frame(const std::string& title, const std::string& unit) {
    for (int i = 0; i <= 10; ++i) {
      const double share = i / 10.0, error = limit_ * share;
      cv::line(canvas_, at(0.0, share), at(limit_, share), kGrid);
      cv::line(canvas_, at(error, 0.0), at(error, 1.0), kGrid);
      if (i % 2 == 0) {
        text(std::to_string(i * 10), at(0.0, share) + cv::Point(-34, 5));
        text(std::to_string(static_cast<int>(error)), at(error, 0.0) + cv::Point(-6, 20));
      }
    }
    text(title, {kMargin, 30}, 0.6);
    text("% of all, over the error [" + unit + "]", {kMargin, kHeight - 12});
  }

  void draw(Curve curve) {
    if (curve.total == 0) return;
    std::sort(curve.values.begin(), curve.values.end());
    cv::Point last = at(0.0, 0.0);
    for (std::size_t i = 0; i < curve.values.size() && curve.values[i] <= limit_; ++i) {
      const double below = static_cast<double>(i) / curve.total;
      const cv::Point step = at(curve.values[i], below);
      const cv::Point next = at(curve.values[i], below + 1.0 / curve.total);
      segment(last, step, curve.color);
      segment(step, next, curve.color);
      last = next;
    }
    segment(last, {at(limit_, 0.0).x, last.y}, curve.color);
    text(curve.name + " (" + std::to_string(curve.total) + ")",
         {kWidth - 200, kHeight - kMargin - 12 - 20 * curves_}, 0.5, curve.color);
    ++curves_;
  }

 private:
  cv::Point at(double error, double share) const {
    return {kMargin + cvRound((kWidth - 1.5 * kMargin) * error / limit_),
            kHeight - kMargin - cvRound((kHeight - 2.0 * kMargin) * share)};
  }
  void segment(const cv::Point& from, const cv::Point& to, const cv::Scalar& color) {
    cv::line(canvas_, from, to, color, 2, cv::LINE_AA);
  }
  void text(const std::string& words, const cv::Point& place, double size = 0.45,
            const cv::Scalar& color = kInk) {
    cv::putText(canvas_, words, place, cv::FONT_HERSHEY_SIMPLEX, size, color, 1, cv::LINE_AA);
  }

  cv::Mat canvas_;
  double limit_;
  int curves_ = 0;
};

Curve joint_curve(const Tally& tally, const std::string& name, const std::vector<Joint>& joints,
                  const cv::Scalar& color) {
  Curve curve{name, {}, 0, color};
  for (const Joint joint : joints) {
    for (const double error_m : tally.joint_errors_m[index(joint)])
      curve.values.push_back(100.0 * error_m);
    curve.total += tally.within_limit[index(joint)].total;
  }
  return curve;
}

Curve direction_curve(const std::string& name, const std::vector<double>& errors_deg,
                      const cv::Scalar& color) {
  return {name, errors_deg, static_cast<int>(errors_deg.size()), color};
}

}  // namespace

cv::Mat draw_error_distribution(const Tally& tally) {
  cv::Mat canvas(kHeight, 2 * kWidth, CV_8UC3, cv::Scalar::all(255));
  Plot joints(canvas.colRange(0, kWidth), 30.0);
  joints.draw_frame("visible joints", "cm");
  using J = Joint;
  joints.draw(
      joint_curve(tally, "trunk, head", {J::kHead, J::kNeck, J::kChest, J::kPelvis}, {60, 60, 60}));
  joints.draw(
      joint_curve(tally, "shoulders", {J::kShoulderLeft, J::kShoulderRight}, {180, 110, 0}));
  joints.draw(joint_curve(tally, "elbows", {J::kElbowLeft, J::kElbowRight}, {0, 130, 230}));
  joints.draw(joint_curve(tally, "wrists", {J::kWristLeft, J::kWristRight}, {50, 50, 220}));
  joints.draw(joint_curve(tally, "hips", {J::kHipLeft, J::kHipRight}, {160, 160, 0}));
  joints.draw(joint_curve(tally, "knees", {J::kKneeLeft, J::kKneeRight}, {60, 160, 60}));
  joints.draw(joint_curve(tally, "ankles", {J::kAnkleLeft, J::kAnkleRight}, {170, 60, 170}));
  Plot directions(canvas.colRange(kWidth, 2 * kWidth), 30.0);
  directions.draw_frame("pointing", "degrees");
  directions.draw(direction_curve("arm axis", tally.pointing_errors_deg, {50, 50, 220}));
  directions.draw(direction_curve("forearm", tally.forearm_errors_deg, {0, 130, 230}));
  directions.draw(direction_curve("head to hand", tally.head_hand_errors_deg, {60, 160, 60}));
  return canvas;
}

}  // namespace limbcast::evaluate

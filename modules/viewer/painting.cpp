#include "modules/viewer/painting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace limbcast::viewer {
namespace {

struct Link {
  Joint from, to;
};
/// The 15 links of Table I.
constexpr std::array<Link, 15> kLinks = {{{Joint::kHead, Joint::kNeck},
                                          {Joint::kNeck, Joint::kChest},
                                          {Joint::kChest, Joint::kPelvis},
                                          {Joint::kNeck, Joint::kShoulderLeft},
                                          {Joint::kNeck, Joint::kShoulderRight},
                                          {Joint::kShoulderLeft, Joint::kElbowLeft},
                                          {Joint::kShoulderRight, Joint::kElbowRight},
                                          {Joint::kElbowLeft, Joint::kWristLeft},
                                          {Joint::kElbowRight, Joint::kWristRight},
                                          {Joint::kPelvis, Joint::kHipLeft},
                                          {Joint::kPelvis, Joint::kHipRight},
                                          {Joint::kHipLeft, Joint::kKneeLeft},
                                          {Joint::kHipRight, Joint::kKneeRight},
                                          {Joint::kKneeLeft, Joint::kAnkleLeft},
                                          {Joint::kKneeRight, Joint::kAnkleRight}}};

const cv::Scalar kLeftColor(255, 170, 40), kRightColor(20, 120, 255), kTrunkColor(40, 230, 250);
const cv::Scalar kRayColor(80, 255, 80), kTruthColor(255, 255, 255);
/// How far a pointing ray is drawn beyond the wrist [m].
constexpr float kRayLength = 1.5F;
/// A ring that is wider says no more [rad].
constexpr float kWidestSigma_rad = 0.8F;

cv::Scalar link_color(Joint to) {
  if (index(to) < index(Joint::kShoulderLeft)) return kTrunkColor;
  return index(to) % 2 == index(Joint::kShoulderLeft) % 2 ? kLeftColor : kRightColor;
}

struct Pen {
  int thickness = 1;
  int joint_radius = 0;
  bool own_colors = true;  ///< else all in `color`
  cv::Scalar color;
};

void draw_line(cv::Mat& canvas, const Viewpoint& view, const Eigen::Vector3f& from_m,
               const Eigen::Vector3f& to_m, const cv::Scalar& color, int thickness) {
  const auto from = view.project(from_m), to = view.project(to_m);
  if (from && to) cv::line(canvas, *from, *to, color, thickness, cv::LINE_AA);
}

/// Where the ray ends with the direction off by one standard deviation: a ring around its end.
void draw_uncertainty(cv::Mat& canvas, const Viewpoint& view, const Eigen::Vector3f& end_m,
                      const Eigen::Vector3f& ray_m, float sigma_rad, const cv::Scalar& color) {
  constexpr int kCorners = 24;
  constexpr float kFullTurn = 6.2831853F;
  const Eigen::Vector3f across = ray_m.unitOrthogonal(), along = ray_m.normalized();
  std::vector<cv::Point> ring;
  for (int i = 0; i < kCorners; ++i) {
    const Eigen::AngleAxisf turn(kFullTurn * static_cast<float>(i) / kCorners, along);
    const auto pixel = view.project(end_m + turn * across * ray_m.norm() * std::tan(sigma_rad));
    if (!pixel) return;
    ring.emplace_back(*pixel);
  }
  cv::polylines(canvas, ring, true, color, 1, cv::LINE_AA);
}

void draw_ray(cv::Mat& canvas, const Viewpoint& view, const BodyPose& person, const Pointing& arm,
              const cv::Scalar& color, int thickness) {
  const JointEstimate& shoulder = person[on_side(Joint::kShoulderLeft, arm.side)];
  const JointEstimate& wrist = person[on_side(Joint::kWristLeft, arm.side)];
  const JointEstimate& from = shoulder.valid ? shoulder : wrist;
  if (!from.valid || arm.direction.isZero()) return;
  const float arm_m = wrist.valid ? (wrist.position_m - from.position_m).norm() : 0.0F;
  // A ray towards the sensor would end behind it: shorten it until its end can be seen.
  for (float length_m = arm_m + kRayLength; length_m > 0.1F; length_m *= 0.8F) {
    const Eigen::Vector3f end_m = from.position_m + length_m * arm.direction;
    const auto begin = view.project(from.position_m), end = view.project(end_m);
    if (!begin || !end) continue;
    cv::arrowedLine(canvas, *begin, *end, color, thickness, cv::LINE_AA, 0, 0.05);
    if (arm.sigma_rad > 0.0F)
      draw_uncertainty(canvas, view, end_m, length_m * arm.direction,
                       std::min(arm.sigma_rad, kWidestSigma_rad), color);
    return;
  }
}

void draw_person(cv::Mat& canvas, const Viewpoint& view, const BodyPose& person, const Pen& pen) {
  for (const Link& link : kLinks) {
    const JointEstimate &from = person[link.from], &to = person[link.to];
    if (from.valid && to.valid)
      draw_line(canvas, view, from.position_m, to.position_m,
                pen.own_colors ? link_color(link.to) : pen.color, pen.thickness);
  }
  if (pen.joint_radius == 0) return;
  for (const JointEstimate& joint : person.joints) {
    if (!joint.valid) continue;
    const auto pixel = view.project(joint.position_m);
    if (pixel)
      cv::circle(canvas, *pixel, pen.joint_radius, cv::Scalar::all(20), cv::FILLED, cv::LINE_AA);
    if (pixel)
      cv::circle(canvas, *pixel, pen.joint_radius - 1, cv::Scalar::all(240), cv::FILLED,
                 cv::LINE_AA);
  }
}

/// Without colours: from blue (low) to red (high).
cv::Vec3b height_color(const Eigen::Vector3f& point_m, const Gravity& gravity) {
  const float share = std::clamp(0.5F - 0.4F * point_m.dot(gravity.down), 0.0F, 1.0F);
  const auto level = static_cast<std::uint8_t>(255.0F * share);
  return {static_cast<std::uint8_t>(255 - level), 120, level};
}

}  // namespace

cv::Scalar person_color(int n) {
  // Okabe and Ito's palette (2008): told apart by colour-blind people too.
  static const std::array<cv::Scalar, 7> kPalette = {
      cv::Scalar(0, 159, 230),  cv::Scalar(233, 180, 86), cv::Scalar(115, 158, 0),
      cv::Scalar(66, 228, 240), cv::Scalar(178, 114, 0),  cv::Scalar(0, 94, 213),
      cv::Scalar(167, 121, 204)};
  return kPalette[static_cast<std::size_t>(n) % kPalette.size()];
}

PointPainter::PointPainter(cv::Mat canvas, const Viewpoint& view)
    : canvas_(std::move(canvas)),
      view_(view),
      depth_m_(canvas_.size(), std::numeric_limits<float>::max()) {}

void PointPainter::draw(const Eigen::Vector3f& point_m, const cv::Vec3b& color) {
  const Eigen::Vector3f seen = view_.eye_from_frame * point_m;
  if (seen.z() < 0.1F) return;
  const Eigen::Vector2f pixel = view_.camera.project(seen);
  if (!(pixel.x() >= 0.0F && pixel.y() >= 0.0F)) return;
  const int u = static_cast<int>(pixel.x()), v = static_cast<int>(pixel.y());
  // Two pixels wide, so that surfaces look closed from other viewpoints.
  for (int y = v; y < std::min(v + 2, canvas_.rows); ++y) {
    for (int x = u; x < std::min(u + 2, canvas_.cols); ++x) {
      if (seen.z() >= depth_m_(y, x)) continue;
      depth_m_(y, x) = seen.z();
      canvas_.at<cv::Vec3b>(y, x) = color;
    }
  }
}

void draw_cloud(cv::Mat& canvas, const Viewpoint& view, const Cloud& cloud, bool dimmed) {
  PointPainter painter(canvas, view);
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    if (cloud.is_hole(i)) continue;
    cv::Vec3b color = height_color(cloud.points_m[i], cloud.stamp.gravity);
    if (!cloud.colors.empty()) color = {cloud.colors[i].b, cloud.colors[i].g, cloud.colors[i].r};
    if (dimmed) color = cv::Vec3b(color[0] / 3, color[1] / 3, color[2] / 3);
    painter.draw(cloud.points_m[i], color);
  }
}

void draw_segments(cv::Mat& canvas, const Viewpoint& view, const Segments& segments) {
  PointPainter painter(canvas, view);
  for (const Segment& segment : segments.segments) {
    if (!segment.valid()) continue;
    const cv::Scalar color = person_color(segment.id);
    for (const Eigen::Vector3f& point_m : segment.points_m)
      painter.draw(point_m, cv::Vec3b(cv::saturate_cast<std::uint8_t>(color[0]),
                                      cv::saturate_cast<std::uint8_t>(color[1]),
                                      cv::saturate_cast<std::uint8_t>(color[2])));
  }
}

void draw_skeletons(cv::Mat& canvas, const Viewpoint& view, const BodyPoses& poses) {
  for (const BodyPose& person : poses.persons) {
    // Rays begin at the shoulder: under the arm, so that they do not hide it.
    for (const Pointing& arm : person.pointing) draw_ray(canvas, view, person, arm, kRayColor, 2);
    draw_person(canvas, view, person, {3, 4, true, {}});
  }
}

void draw_truth(cv::Mat& canvas, const Viewpoint& view, const BodyPoses& truth) {
  for (const BodyPose& person : truth.persons) {
    draw_person(canvas, view, person, {1, 0, false, kTruthColor});
    for (const Pointing& arm : person.pointing) draw_ray(canvas, view, person, arm, kTruthColor, 1);
  }
}

void draw_text(cv::Mat& canvas, const std::string& text, cv::Point place, double size,
               const cv::Scalar& color) {
  cv::putText(canvas, text, place, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(0), 3,
              cv::LINE_AA);
  cv::putText(canvas, text, place, cv::FONT_HERSHEY_SIMPLEX, size, color, 1, cv::LINE_AA);
}

}  // namespace limbcast::viewer

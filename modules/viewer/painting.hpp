#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "modules/viewer/viewpoint.hpp"

namespace limbcast::viewer {

/// Colour of the n-th person or segment.
cv::Scalar person_color(int n);

/// Points through any viewpoint, nearer ones in front.
class PointPainter {
 public:
  PointPainter(cv::Mat canvas, const Viewpoint& view);
  void draw(const Eigen::Vector3f& point_m, const cv::Vec3b& color);

 private:
  cv::Mat canvas_;
  Viewpoint view_;
  cv::Mat1f depth_m_;
};

/// The points of the cloud in their colours (by height where it has none), `dimmed` towards the
/// background.
void draw_cloud(cv::Mat& canvas, const Viewpoint& view, const Cloud& cloud, bool dimmed);
/// The points of valid segments in the colours of their persons.
void draw_segments(cv::Mat& canvas, const Viewpoint& view, const Segments& segments);

/// Links (left blue, right orange, trunk yellow), joints and pointing rays of all persons.
void draw_skeletons(cv::Mat& canvas, const Viewpoint& view, const BodyPoses& poses);
/// The same thin and white, hidden joints too.
void draw_truth(cv::Mat& canvas, const Viewpoint& view, const BodyPoses& truth);

/// One line of text with a dark shadow, so that it can be read on everything.
void draw_text(cv::Mat& canvas, const std::string& text, cv::Point place, double size = 0.5,
               const cv::Scalar& color = cv::Scalar::all(255));

}  // namespace limbcast::viewer

#include "tests/calibrate/boards.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/camera/lens_projection.hpp"
#include "common/camera/opencv_conversion.hpp"

namespace limbcast::calibrate {
namespace {

/// Turns the board about its middle, which stands at `middle_m`.
BoardPose pose_about_middle(const Board& board, const cv::Vec3d& rotation,
                            const cv::Vec3d& middle_m) {
  cv::Matx33d R;
  cv::Rodrigues(rotation, R);
  const cv::Point3f middle = 0.5F * (board.point_m(0) + board.point_m(board.num_points() - 1));
  const cv::Matx31d shift = R * cv::Matx31d(middle.x, middle.y, middle.z);
  return {rotation, middle_m - cv::Vec3d(shift(0), shift(1), shift(2))};
}

BoardPose in_right_camera(const BoardPose& pose, const StereoCalibration& cameras) {
  cv::Mat turn;
  cv::Rodrigues(to_cv(cameras.R), turn);
  BoardPose result;
  cv::composeRT(pose.rotation, pose.translation_m, turn, to_cv(cameras.T), result.rotation,
                result.translation_m);
  return result;
}

BoardPoints project(const Board& board, const BoardPose& pose, const LensCalibration& lens,
                    double sigma_px, cv::RNG& random) {
  std::vector<cv::Point3f> points;
  for (int id = 0; id < board.num_points(); ++id) points.push_back(board.point_m(id));
  std::vector<cv::Point2f> pixels;
  project_points(points, pose.rotation, pose.translation_m, lens, pixels);
  BoardPoints result;
  for (int id = 0; id < board.num_points(); ++id) {
    const cv::Point2f noise(static_cast<float>(random.gaussian(sigma_px)),
                            static_cast<float>(random.gaussian(sigma_px)));
    const cv::Point2f pixel = pixels[id] + noise;
    if (!cv::Rect2f(0, 0, static_cast<float>(lens.camera.width - 1),
                    static_cast<float>(lens.camera.height - 1))
             .contains(pixel))
      continue;
    result.ids.push_back(id);
    result.pixels.push_back(pixel);
  }
  return result;
}

/// Row and column of point 0 in draw_board's picture, in squares: half a square of margin, then a
/// square or half a circle's cell.
double first_point_squares(const Board& board) {
  return board.kind == BoardKind::kCircles ? 1.0 : 1.5;
}

/// Does the pixel show what is in front of the camera, as everything is that a board is seen in?
bool is_before(const cv::Point2f& pixel, const LensCalibration& lens) {
  constexpr double kNearly90Degrees = 1.5;
  return lens.model == LensModel::kPinhole ||
         std::hypot((pixel.x - lens.camera.cx) / lens.camera.fx,
                    (pixel.y - lens.camera.cy) / lens.camera.fy) < kNearly90Degrees;
}

cv::Mat render(const Board& board, const BoardPose& pose, const LensCalibration& lens) {
  // Each pixel is the mean of 2 x 2 rays.
  constexpr int kRays = 2;
  constexpr int kPixelsPerSquare = 50;
  constexpr uchar kBackground = 120;
  const cv::Size size(kRays * lens.camera.width, kRays * lens.camera.height);
  std::vector<cv::Point2f> pixels;
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u)
      pixels.emplace_back((static_cast<float>(u) + 0.5F) / kRays - 0.5F,
                          (static_cast<float>(v) + 0.5F) / kRays - 0.5F);
  }
  std::vector<cv::Point2f> rays;
  undistort_points(pixels, rays, lens);
  cv::Matx33d R;
  cv::Rodrigues(pose.rotation, R);
  // A point (x, y, 0) of the board is seen in the direction H (x, y, 1).
  const cv::Matx33d H(R(0, 0), R(0, 1), pose.translation_m[0],  //
                      R(1, 0), R(1, 1), pose.translation_m[1],  //
                      R(2, 0), R(2, 1), pose.translation_m[2]);
  const cv::Matx33d inverse = H.inv();
  const double first_px = first_point_squares(board) * kPixelsPerSquare - 0.5;
  const double scale = kPixelsPerSquare / board.square_m;
  cv::Mat map(size, CV_32FC2);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!is_before(pixels[i], lens)) {
      map.at<cv::Vec2f>(static_cast<int>(i) / size.width, static_cast<int>(i) % size.width) = {
          -1e3F, -1e3F};
      continue;
    }
    const cv::Matx31d place = inverse * cv::Matx31d(rays[i].x, rays[i].y, 1.0);
    map.at<cv::Vec2f>(static_cast<int>(i) / size.width, static_cast<int>(i) % size.width) = {
        static_cast<float>(first_px + scale * place(0) / place(2)),
        static_cast<float>(first_px + scale * place(1) / place(2))};
  }
  cv::Mat fine;
  cv::remap(draw_board(board, kPixelsPerSquare), fine, map, cv::noArray(), cv::INTER_LINEAR,
            cv::BORDER_CONSTANT, cv::Scalar(kBackground));
  cv::Mat image;
  cv::resize(fine, image, {}, 1.0 / kRays, 1.0 / kRays, cv::INTER_AREA);
  return image;
}

/// Do both cameras see all of the board, as detectors need it?
bool is_whole(const Board& board, const BoardPose& pose, const StereoCalibration& cameras) {
  const View view = project_board(board, pose, cameras, "");
  return static_cast<int>(std::min(view.left.ids.size(), view.right.ids.size())) ==
         board.num_points();
}

/// Is that all within the image circles of both fisheyes?
bool is_lit(const Board& board, const BoardPose& pose) {
  const StereoCalibration cameras = fisheye_cameras();
  const View view = project_board(board, pose, cameras, "");
  const auto is_inside = [](const BoardPoints& points, const PinholeCamera& camera) {
    return std::all_of(points.pixels.begin(), points.pixels.end(), [&](const cv::Point2f& pixel) {
      return std::hypot(pixel.x - camera.cx, pixel.y - camera.cy) < kImageCircle_px;
    });
  };
  return is_whole(board, pose, cameras) && is_inside(view.left, cameras.left.camera) &&
         is_inside(view.right, cameras.right.camera);
}

/// Up and down, and to either side, in turns.
Eigen::AngleAxisd tilted(double angle_rad, int count) {
  const Eigen::Vector3d axis = count % 4 < 2 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  return Eigen::AngleAxisd(count % 2 == 0 ? angle_rad : -angle_rad, axis);
}

/// The board's middle stands where `turn` takes the axis of a camera between both, so far away; the
/// board faces it but for `roll` about its normal and `tilt`.
BoardPose pose_in_direction(const Board& board, const Eigen::AngleAxisd& turn,
                            double distance_squares, double roll, const Eigen::AngleAxisd& tilt) {
  const Eigen::Vector3d middle_m =
      distance_squares * board.square_m * (turn * Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd turned(turn * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) * tilt);
  const Eigen::Vector3d rotation = turned.angle() * turned.axis();
  return pose_about_middle(board, {rotation.x(), rotation.y(), rotation.z()},
                           {middle_m.x() + 0.06, middle_m.y(), middle_m.z()});
}

}  // namespace

StereoCalibration true_cameras() {
  StereoCalibration cameras;
  cameras.left = {{640, 480, 531.2, 530.6, 322.1, 241.3}, {-0.301, 0.102, 0.0004, -0.0003, 0.0}};
  cameras.right = {{640, 480, 529.4, 529.9, 317.8, 237.2}, {-0.296, 0.097, -0.0003, 0.0005, 0.0}};
  cameras.R = (Eigen::AngleAxisd(-0.02, Eigen::Vector3d::UnitY()) *
               Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitX()) *
               Eigen::AngleAxisd(-0.007, Eigen::Vector3d::UnitZ()))
                  .toRotationMatrix();
  cameras.T = {-0.12, 0.0008, -0.0025};
  return cameras;
}

Board large_board() {
  Board board;
  board.square_m = 0.05;
  return board;
}

StereoCalibration fisheye_cameras() {
  StereoCalibration cameras = true_cameras();
  cameras.left = {
      {640, 480, 224.3, 223.8, 322.1, 241.3}, {-0.01, 0.03, -0.02, 0.004}, LensModel::kFisheye};
  cameras.right = {
      {640, 480, 225.6, 225.9, 317.8, 237.2}, {0.005, 0.02, -0.015, 0.003}, LensModel::kFisheye};
  return cameras;
}

std::vector<BoardPose> poses_around(const Board& board) {
  std::vector<BoardPose> poses;
  int count = 0;
  for (const double distance_squares : {9.0, 13.0}) {
    for (const double updown : {-0.55, 0.0, 0.55}) {
      for (const double sideways : {-0.85, -0.4, 0.0, 0.4, 0.85}) {
        const Eigen::AngleAxisd turn(Eigen::AngleAxisd(sideways, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(-updown, Eigen::Vector3d::UnitX()));
        const BoardPose pose =
            pose_in_direction(board, turn, distance_squares, 0.0, tilted(0.4, count++));
        if (is_whole(board, pose, fisheye_cameras())) poses.push_back(pose);
      }
    }
  }
  return poses;
}

std::vector<BoardPose> poses_in_image_circle(const Board& board) {
  constexpr double kOffAxis_rad = 0.7;
  constexpr int kDirections = 10;
  std::vector<BoardPose> poses;
  int count = 0;
  for (const double distance_squares : {8.0, 10.0, 12.0}) {
    for (int i = -1; i < kDirections; ++i) {  // first on the axis
      const double direction = 2.0 * CV_PI * i / kDirections;
      const Eigen::AngleAxisd turn(i < 0 ? 0.0 : kOffAxis_rad,
                                   Eigen::Vector3d(-std::sin(direction), std::cos(direction), 0.0));
      // Along the circle's rim, and upright.
      for (const double roll : {std::remainder(direction + 0.5 * CV_PI, CV_PI), 0.0}) {
        const BoardPose pose =
            pose_in_direction(board, turn, distance_squares, roll, tilted(0.3, count++));
        if (is_lit(board, pose)) poses.push_back(pose);
      }
    }
  }
  return poses;
}

GreyPair lit_in_image_circle(const GreyPair& pair) {
  constexpr uchar kStrayLight = 8;
  const StereoCalibration cameras = fisheye_cameras();
  const auto lit = [](const cv::Mat& image, const PinholeCamera& camera) {
    cv::Mat circle(image.size(), CV_8UC1, cv::Scalar(0));
    cv::circle(circle, {cvRound(camera.cx), cvRound(camera.cy)}, cvRound(kImageCircle_px), 255,
               cv::FILLED);
    cv::Mat result(image.size(), CV_8UC1, cv::Scalar(kStrayLight));
    image.copyTo(result, circle);
    return result;
  };
  return {pair.name, lit(pair.left, cameras.left.camera), lit(pair.right, cameras.right.camera),
          pair.utime};
}

std::vector<BoardPose> varied_poses(const Board& board, int count) {
  constexpr int kColumns = 3, kRows = 3;
  std::vector<BoardPose> poses;
  cv::RNG random(3);
  for (int i = 0; i < count; ++i) {
    const double z_m = 0.55 + 0.1 * (i % 4);
    const double tilt = random.uniform(0.25, 0.55) * (i % 2 == 0 ? 1.0 : -1.0);
    const cv::Vec3d rotation = i % 4 < 2 ? cv::Vec3d(tilt, 0.3 * tilt, random.uniform(-0.2, 0.2))
                                         : cv::Vec3d(0.3 * tilt, tilt, random.uniform(-0.2, 0.2));
    const double x_m = z_m * 0.25 * (i % kColumns - 1) + 0.06;
    const double y_m = z_m * 0.2 * (i / kColumns % kRows - 1);
    poses.push_back(pose_about_middle(board, rotation, {x_m, y_m, z_m}));
  }
  return poses;
}

std::vector<BoardPose> thorough_poses(const Board& board) {
  constexpr double kTilt_rad = 0.35;
  std::vector<BoardPose> poses;
  for (const double z_squares : {14.0, 18.0, 26.0}) {
    const double z_m = z_squares * board.square_m;
    for (int i = 0; i < 9; ++i) {
      const double tilt = i % 4 < 2 ? kTilt_rad : -kTilt_rad;
      const cv::Vec3d rotation = i % 2 == 0 ? cv::Vec3d(tilt, 0.0, 0.0) : cv::Vec3d(0.0, tilt, 0.0);
      const int column = i % 3 - 1, row = i / 3 - 1;
      const double x_m = z_m * 0.36 * column + 0.06;
      const double y_m = z_m * 0.3 * row;
      poses.push_back(pose_about_middle(board, rotation, {x_m, y_m, z_m}));
    }
  }
  return poses;
}

std::vector<BoardPose> frontal_poses(const Board& board, int count) {
  std::vector<BoardPose> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back(pose_about_middle(board, {0.0, 0.0, 0.0},
                                      {0.06 + 0.15 * (i % 3 - 1), 0.1 * (i / 3 % 3 - 1), 0.6}));
  return poses;
}

View project_board(const Board& board, const BoardPose& pose, const StereoCalibration& cameras,
                   const std::string& name, double sigma_px) {
  cv::RNG random(std::hash<std::string>()(name));
  return {name, project(board, pose, cameras.left, sigma_px, random),
          project(board, in_right_camera(pose, cameras), cameras.right, sigma_px, random)};
}

std::vector<View> project_boards(const Board& board, const std::vector<BoardPose>& poses,
                                 const StereoCalibration& cameras) {
  std::vector<View> views;
  for (const BoardPose& pose : poses)
    views.push_back(project_board(board, pose, cameras, "view_" + std::to_string(views.size())));
  return views;
}

GreyPair render_board(const Board& board, const BoardPose& pose, const StereoCalibration& cameras,
                      const std::string& name) {
  return {name, render(board, pose, cameras.left),
          render(board, in_right_camera(pose, cameras), cameras.right)};
}

GreyPair picture_of_wall(const std::string& name, const cv::Size& size) {
  const cv::Mat wall(size, CV_8UC1, cv::Scalar(90));
  return {name, wall, wall};
}

void write_pair(const test::TemporaryFolder& folder, const GreyPair& pair) {
  for (const auto& [grey, side] :
       {std::pair(&pair.left, "_left.jpg"), {&pair.right, "_right.jpg"}}) {
    cv::Mat image;
    cv::cvtColor(*grey, image, cv::COLOR_GRAY2BGR);
    cv::imwrite(folder / (pair.name + side), image);
  }
}

}  // namespace limbcast::calibrate

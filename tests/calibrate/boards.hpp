#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/camera/calibration.hpp"
#include "modules/calibrate/coverage.hpp"
#include "modules/calibrate/views.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::calibrate {

/// A pair of VGA cameras with lens distortion, not parallel, 120 mm apart.
StereoCalibration true_cameras();

/// The same with fisheye lenses, 164 degrees across.
StereoCalibration fisheye_cameras();
/// Squares of 5 cm, which such lenses still see well far off their axes.
Board large_board();

/// p_camera = R * p_board + t, of the left camera.
struct BoardPose {
  cv::Vec3d rotation;  ///< Rodrigues vector
  cv::Vec3d translation_m;
};

/// Poses that fill both images, tilted either way, near and far.
std::vector<BoardPose> varied_poses(const Board& board, int count);
/// Poses that leave nothing to add: all over both images, tilted either way, near and far.
std::vector<BoardPose> thorough_poses(const Board& board);
/// Poses all over the field of fisheye_cameras, tilted either way, near and far, in which both see
/// the whole board.
std::vector<BoardPose> poses_around(const Board& board);
/// Radius of the circle that lenses light about their principal points whose picture ends within
/// the sensor [px].
constexpr double kImageCircle_px = 240.0;
/// Poses all over that circle of both fisheye_cameras, tilted either way, near and far.
std::vector<BoardPose> poses_in_image_circle(const Board& board);
/// A rendered pair as such cameras give it: dark, but for stray light, outside of the circle.
GreyPair lit_in_image_circle(const GreyPair& pair);

/// The places of varied_poses, but parallel to the image and all at one distance.
std::vector<BoardPose> frontal_poses(const Board& board, int count);

/// Where the board's points stand in both images, with noise of `sigma_px`: no pictures needed.
View project_board(const Board& board, const BoardPose& pose, const StereoCalibration& cameras,
                   const std::string& name, double sigma_px = 0.1);
std::vector<View> project_boards(const Board& board, const std::vector<BoardPose>& poses,
                                 const StereoCalibration& cameras);

/// Pictures of the board on a grey background, as lenses with that distortion give them.
GreyPair render_board(const Board& board, const BoardPose& pose, const StereoCalibration& cameras,
                      const std::string& name);

/// A pair that shows no board.
GreyPair picture_of_wall(const std::string& name, const cv::Size& size);

/// Writes "NAME_left.jpg" and "NAME_right.jpg" as cameras give them: coloured.
void write_pair(const test::TemporaryFolder& folder, const GreyPair& pair);

}  // namespace limbcast::calibrate

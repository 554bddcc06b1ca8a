// What no sender may say is refused with the name of what is wrong.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/common/codec/codec_messages.hpp"
#include "tests/common/infinite_numbers.hpp"

namespace limbcast::lcm_io {
namespace {

template <class Message>
struct Refusal {
  std::function<void(Message&)> change;
  std::string told;
};

/// Makes each change to a good message by itself; reading it must end with a text that holds
/// `told`.
template <class Message>
void expect_refused(const Message& good, const std::vector<Refusal<Message>>& refusals) {
  EXPECT_NO_THROW(from_message(good));
  for (std::size_t i = 0; i < refusals.size(); ++i) {
    Message bad = good;
    refusals[i].change(bad);
    try {
      from_message(bad);
      ADD_FAILURE() << "change " << i << " was taken: " << refusals[i].told;
    } catch (const MessageError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(refusals[i].told)) << "change " << i;
    }
  }
}

TEST(CodecRefusals, NameWhatIsWrongWithAStamp) {
  expect_refused<stamp_t>(stamp_message(),
                          {{[](auto& m) { m.sensor = ""; }, "'sensor'"},
                           {[](auto& m) { m.down[0] = 2.0F; }, "'down'"},
                           {[](auto& m) { m.gravity_source = -1; }, "'gravity_source'"},
                           {[](auto& m) { m.sensor_height_m = -kInfinity; }, "'sensor_height_m'"},
                           {[](auto& m) { m.noise_constant_m = -0.1F; }, "noise"},
                           {[](auto& m) { m.noise_constant_m = kNaN; }, "noise"},
                           {[](auto& m) { m.noise_quadratic_per_m = kInfinity; }, "noise"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithABodyPose) {
  using Poses = body_poses_t;
  const auto pointing = [](Poses& m) -> pointing_t& { return m.persons[0].pointing[0]; };
  expect_refused<Poses>(
      body_poses_message(),
      {{[](Poses& m) { m.persons[0].joints[2].confidence = kNaN; }, "confidence or sigma"},
       {[](Poses& m) { m.persons[0].joints[2].sigma_m = kInfinity; }, "confidence or sigma"},
       {[](Poses& m) { m.persons[0].joints[2].position_m[1] = kNaN; }, "coordinate"},
       {[](Poses& m) { std::swap(m.persons[0].joints[2], m.persons[0].joints[3]); }, "name"},
       {[=](Poses& m) { pointing(m).side = 9; }, "unknown side"},
       {[](Poses& m) { m.persons[0].joints[2].position_m[1] = 3e38F; }, "coordinate"},
       {[=](Poses& m) { pointing(m).forearm[0] = kNaN; }, "coordinate"},
       {[=](Poses& m) { pointing(m).direction[0] = 2.0F; }, "no unit vector"},
       {[=](Poses& m) { pointing(m).sigma_rad = kNaN; }, "uncertainty of a direction"},
       {[=](Poses& m) { pointing(m).confidence = kNaN; }, "uncertainty of a direction"},
       {[](Poses& m) { m.persons[0].joints[2].confidence = 1.5F; }, "confidence or sigma"},
       {[=](Poses& m) { pointing(m).sigma_rad = -1.0F; }, "uncertainty of a direction"},
       {[](Poses& m) { m.persons[0].link_lengths_m[3] = kNaN; }, "a link's length"},
       {[](Poses& m) { m.persons[0].angles_rad[3] = kInfinity; }, "an angle is infinite"},
       {[](Poses& m) { m.persons[0].error_terms[1] = kNaN; }, "error is not finite"},
       {[](Poses& m) { m.persons[0].error = kInfinity; }, "error is not finite"},
       {[](Poses& m) { m.persons[0].confidence = kNaN; }, "confidence, scale or rotation"},
       {[](Poses& m) { m.persons[0].scale = kInfinity; }, "confidence, scale or rotation"},
       {[](Poses& m) { m.persons[0].rotation_deg = kNaN; }, "confidence, scale or rotation"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithASegment) {
  using Message = segments_t;
  const auto window = [](Message& m) -> range_image_t& { return m.segments[0].windows[0]; };
  const std::string size = "size of a window", camera = "camera of a window",
                    scale = "'inverse_depth_scale'";
  expect_refused<Message>(
      segments_message(),
      {{[=](Message& m) { window(m).width = 0; }, size},
       {[=](Message& m) { window(m).height = -3; }, size},
       {[=](Message& m) { window(m).width = 9000; }, size},
       {[=](Message& m) { window(m).height = 9000; }, size},
       {[=](Message& m) { window(m).fx = 0.0; }, camera},
       {[=](Message& m) { window(m).fy = -1.0; }, camera},
       {[=](Message& m) { window(m).cx = kNaN; }, camera},
       {[=](Message& m) { window(m).cy = kInfinity; }, camera},
       {[=](Message& m) { window(m).fx = 1e30; }, camera},
       {[=](Message& m) { window(m).origin_u = 2'000'000'000; }, "place of a window"},
       {[=](Message& m) { window(m).full_height = -1; }, "place of a window"},
       {[=](Message& m) { window(m).inverse_depth_scale = 0.0; }, scale},
       {[=](Message& m) { window(m).inverse_depth_scale = 1e12; }, "farther than any sensor sees"},
       {[=](Message& m) { window(m).inverse_depth_scale = kInfinity; }, scale},
       {[=](Message& m) { window(m).frame_from_image[8] = 0.1F; }, "rotation of a window"},
       {[](Message& m) { m.segments[0].seed_m[1] = kNaN; }, "seed is not finite"},
       {[](Message& m) { m.segments[0].facing_log_odds = kNaN; }, "odds of a face"},
       {[](Message& m) { m.segments[0].looks_right_log_odds = kInfinity; }, "odds of a face"},
       {[](Message& m) { m.segments[0].seed_score = kNaN; }, "a seed's score"},
       {[](Message& m) { m.segments[0].filter_figure = kInfinity; }, "a filter's figure"},
       {[](Message& m) { m.segments[0].filter_limit = kNaN; }, "a filter's figure"},
       {[](Message& m) { m.segments[0].seed_kind = -1; }, "'seed_kind'"},
       {[](Message& m) { m.segments[0].seed_kind = 4; }, "'seed_kind'"},
       {[](Message& m) { m.segments[0].rejected_by = -1; }, "'rejected_by'"},
       {[](Message& m) { m.segments[0].rejected_by = 7; }, "'rejected_by'"},
       {[](Message& m) { m.segments[0].num_points = -1; }, "number of points"},
       {[](Message& m) { m.segments[0].num_points = 8'000'001; }, "number of points"},
       {[](Message& m) { m.segments[0].resolution_m = 0.0; }, "'resolution_m'"},
       {[](Message& m) { m.segments[0].skin.pop_back(); }, "skin flags"},
       {[=](Message& m) { m.segments[0].windows.push_back(window(m)); }, "more than one window"},
       {[](Message& m) {
          m.segments[0].windows.clear();
          m.segments[0].has_points = 0;
        },
        "neither points nor window"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithAPersonOfAnImage) {
  using Message = segments_t;
  const auto pose = [](Message& m) -> image_pose_t& { return m.segments[0].image_poses[0]; };
  const auto joint = [=](Message& m) -> image_joint_t& { return pose(m).joints[1]; };
  const std::string score = "score of a person of an image", known = "unknown joint",
                    range = "joint of an image is out of range";
  expect_refused<Message>(
      segments_message(),
      {{[=](Message& m) { m.segments[0].image_poses.resize(4, pose(m)); },
        "too many poses of a person in the image"},
       {[=](Message& m) { pose(m).person_score = -0.1F; }, score},
       {[=](Message& m) { pose(m).person_score = 1.1F; }, score},
       {[=](Message& m) { pose(m).person_score = kNaN; }, score},
       {[=](Message& m) { joint(m).joint = -1; }, known},
       {[=](Message& m) { joint(m).joint = kJointCount; }, known},
       {[=](Message& m) { joint(m).joint = pose(m).joints[0].joint; }, "told twice"},
       {[=](Message& m) { joint(m).u = kNaN; }, range},
       {[=](Message& m) { joint(m).v = kInfinity; }, range},
       {[=](Message& m) { joint(m).u = -1.1e6F; }, range},
       {[=](Message& m) { joint(m).v = 3e38F; }, range},
       {[=](Message& m) { joint(m).visibility = -0.1F; }, range},
       {[=](Message& m) { joint(m).visibility = 1.1F; }, range},
       {[=](Message& m) { joint(m).visibility = kNaN; }, range},
       {[=](Message& m) { joint(m).behind_hips_m = kNaN; }, range},
       {[=](Message& m) { joint(m).behind_hips_m = 1e5F; }, range},
       {[=](Message& m) { joint(m).spread_m = -0.01F; }, range},
       {[=](Message& m) { joint(m).spread_m = kNaN; }, range},
       {[=](Message& m) { joint(m).spread_m = 1e5F; }, range}});
}

void make_fisheye(lens_t& lens, double k6) {
  lens.num_distortion = lens_t::NUM_FISHEYE;
  lens.distortion = {0.01, 0.02, -0.01, 0.002, 0.0, k6};
}

TEST(CodecRefusals, NameWhatIsWrongWithACalibration) {
  using Message = stereo_calibration_t;
  const std::string size = "image size", focal = "focal length or principal point",
                    rotation = "a rotation is none";
  expect_refused<Message>(
      calibration_message(),
      {{[](Message& m) { m.left.width = 0; }, size},
       {[](Message& m) { m.right.height = -1; }, size},
       {[](Message& m) { m.left.width = 100'000; }, size},
       {[](Message& m) { m.left.fx = 0.0; }, focal},
       {[](Message& m) { m.left.fy = 0.0; }, focal},
       {[](Message& m) { m.right.fy = kNaN; }, focal},
       {[](Message& m) { m.left.cx = kNaN; }, focal},
       {[](Message& m) { m.left.cy = kInfinity; }, focal},
       {[](Message& m) { m.left.cy = 1e9; }, focal},
       {[](Message& m) { m.left.fx = 1e-3; }, focal},
       {[](Message& m) { m.left.fy = 1e9; }, focal},
       {[](Message& m) { m.left.num_distortion = 3; }, "number of distortion coefficients"},
       {[](Message& m) { m.left.distortion[1] = kNaN; }, "distortion coefficient is not finite"},
       {[](Message& m) { make_fisheye(m.left, 0.1); }, "k5 and k6 of a fisheye lens must be 0"},
       {[](Message& m) { make_fisheye(m.left, 0.0); }, "one lens is a fisheye, the other is not"},
       {[](Message& m) { m.R[0] = 2.0; }, rotation},
       // Mirrored: orthogonal, but no rotation.
       {[](Message& m) { m.R2[2] = -1.0; }, rotation},
       {[](Message& m) { m.T[1] = kNaN; }, "a number is not finite"},
       {[](Message& m) { m.P2[11] = kInfinity; }, "a number is not finite"},
       {[](Message& m) { m.mounting.down[0] = 1.0; }, "'down'"},
       {[](Message& m) { m.mounting.sensor_height_m = kInfinity; }, "'sensor_height_m'"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithDepthImages) {
  DepthCalibration calibration;
  calibration.color = from_message(lens_message(20.0));
  const depth_images_t good =
      to_message({from_message(stamp_message()), noise_image(CV_8UC3), noise_image(CV_16UC1)},
                 calibration, 90);
  expect_refused<depth_images_t>(
      good,
      {{[](auto& m) { m.depth_scale_m = 0.0; }, "'depth_scale_m'"},
       {[](auto& m) { m.depth_scale_m = kInfinity; }, "'depth_scale_m'"},
       {[](auto& m) { m.depth = to_png_message(noise_image(CV_8UC1)); }, "not 16 bit"},
       {[](auto& m) { m.lens.width = 17; }, "differs from the calibration"},
       {[](auto& m) { m.lens.height = 13; }, "differs from the calibration"},
       {[](auto& m) { m.color = to_png_message(noise_image(CV_16UC1)); }, "colour"},
       {[](auto& m) { m.color = to_png_message(noise_image(CV_8UC3).rowRange(0, 8)); }, "colour"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithStereoImages) {
  const stereo_images_t good =
      to_message({from_message(stamp_message()), noise_image(CV_8UC3), noise_image(CV_8UC3)},
                 ImageCoding::kPng, 90);
  expect_refused<stereo_images_t>(
      good, {{[](auto& m) { m.left = image_t{}; }, "an image is missing"},
             {[](auto& m) { m.right = image_t{}; }, "an image is missing"},
             {[](auto& m) { m.right = to_png_message(noise_image(CV_8UC3).colRange(0, 8)); },
              "differ in size"},
             {[](auto& m) { m.right = to_png_message(noise_image(CV_16UC1)); }, "not 8 bit"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithAnImage) {
  const std::string range = "size is out of range", decoded = "decoded size differs";
  expect_refused<image_t>(to_png_message(noise_image(CV_8UC3)),
                          {{[](auto& m) { m.width = 9000; }, range},
                           {[](auto& m) { m.height = 9000; }, range},
                           {[](auto& m) { m.width = 0; }, range},
                           {[](auto& m) { m.data.clear(); }, "no data"},
                           {[](auto& m) { m.width = 17; }, decoded},
                           {[](auto& m) { m.height = 13; }, decoded},
                           {[](auto& m) { m.data.resize(20); }, "cannot be decoded"},
                           {[](auto& m) { m.encoding = 99; }, "unknown encoding"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithACloud) {
  const std::string camera = "camera is not sound", size = "size is out of range";
  expect_refused<point_cloud_t>(
      to_message(small_cloud()),
      {{[](auto& m) { m.width = -16; }, size},
       {[](auto& m) { m.width = m.height = 1'000'000; }, size},
       {[](auto& m) { m.layout = 9; }, "unknown layout"},
       {[](auto& m) { m.fx = 0.0; }, camera},
       {[](auto& m) { m.fy = -1.0; }, camera},
       {[](auto& m) { m.cy = kNaN; }, camera},
       {[](auto& m) { m.fx = 1e30; }, camera},
       {[](auto& m) { m.inverse_depth_scale = 0.0; }, "'inverse_depth_scale'"},
       {[](auto& m) { m.inverse_depth_scale = 1e12; }, "farther than any sensor sees"},
       {[](auto& m) { m.color = to_png_message(noise_image(CV_8UC3)); }, "colour image"},
       {[](auto& m) { m.color = to_png_message(cv::Mat(16, 16, CV_16UC1, cv::Scalar(1))); },
        "colour image"}});
}

TEST(CodecRefusals, NameWhatIsWrongWithAListOfPoints) {
  Cloud cloud = small_cloud();
  cloud.camera.reset();
  cloud.width = 256;
  cloud.height = 1;
  cloud.intensities.assign(256, 0.5F);
  cloud.rings.assign(256, 3);
  const std::string size = "another size", damaged = "damaged";
  expect_refused<point_cloud_t>(
      to_message(cloud), {{[](auto& m) { m.height = 2; }, "height 1"},
                          {[](auto& m) { m.resolution_m = 0.0; }, "'resolution_m'"},
                          {[](auto& m) { m.color.data.pop_back(); }, "colours of a list"},
                          {[](auto& m) { m.color.encoding = image_t::PNG; }, "colours of a list"},
                          {[](auto& m) { m.intensity_step = 0.0; }, "'intensity_step'"},
                          {[](auto& m) { m.intensity_step = kInfinity; }, "'intensity_step'"},
                          {[](auto& m) {
                             m.intensities = compress({1, 2, 3});
                           },
                           size},
                          {[](auto& m) { m.intensities.pop_back(); }, damaged},
                          {[](auto& m) {
                             m.rings = compress({1, 2, 3});
                           },
                           size},
                          {[](auto& m) { m.rings.pop_back(); }, damaged}});
}

}  // namespace
}  // namespace limbcast::lcm_io

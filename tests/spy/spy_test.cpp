#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <opencv2/imgproc.hpp>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/image_codec.hpp"
#include "tests/replay/log_tools.hpp"
#include "tests/support/virtual_display.hpp"

namespace limbcast::spy {
namespace {

using lcm_io::LogEvent;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Messages can be lost on the way to lcm-spy, and a window takes its time: so often the log is
/// played.
constexpr int kMostPlays = 30;

// The colours of the plugins [BGR].
const cv::Vec3b kLeft(255, 170, 40), kRight(20, 120, 255), kGrid(60, 55, 50),
    kWaiting(190, 245, 255);

/// A log with all that the chain makes of two real frames.
class RealLog : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string folder = test::temporary_folder("spy");
    log_ = folder + "/out.log";
    replay::write_events(folder + "/in.log",
                         replay::first_frames(test::repository_file("logs/demo.log"), 2));
    const auto outcome = test::run({test::program("limbcast-replay"), folder + "/in.log", log_});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  template <class Message>
  static Message last(const std::string& channel) {
    return lcm_io::decode<Message>(
        replay::on_channel(replay::events_of(log_), channel).back().data);
  }

  static std::string log_;
};

std::string RealLog::log_;

TEST(SpyScript, ExplainsItself) {
  const auto outcome = test::run({test::repository_file("modules/spy/limbcast-spy"), "--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("Usage: limbcast-spy [--lcm-url=URL]"));
}

TEST(SpyScript, TellsInOneLineThatThereIsNoDisplay) {
  const auto end_on = [](const std::string& display) {
    const std::string output = test::temporary_folder("no_display") + "/spy.txt";
    test::ChildProcess spy({test::repository_file("modules/spy/limbcast-spy")}, output,
                           {"DISPLAY=" + display});
    EXPECT_EQ(spy.wait(), 2);
    return spy.output();
  };
  const std::string remedy =
      "); start it on a desktop or through ssh -X, or take limbcast-status and limbcast-viewer "
      "--png\n";
  EXPECT_EQ(end_on(""),
            "limbcast-spy: there is no display for its window (DISPLAY is not set" + remedy);
  EXPECT_THAT(end_on("/nowhere:1"),
              AllOf(StartsWith("limbcast-spy: there is no display for its window (DISPLAY is "
                               "/nowhere:1, Can't connect to X11 window server"),
                    EndsWith(remedy)));
}

TEST(SpyOnADisplay, TellsInOneLineThatTheUrlIsWrong) {
  if (!test::VirtualDisplay::available()) GTEST_SKIP() << "Xvfb, xdotool or ImageMagick is missing";
  const test::VirtualDisplay display;
  test::ChildProcess spy({test::repository_file("modules/spy/limbcast-spy"), "--lcm-url=nonsense"},
                         test::temporary_folder("wrong_url") + "/spy.txt", {display.variable()});
  EXPECT_EQ(spy.wait(), 2);
  EXPECT_EQ(spy.output(),
            "limbcast-spy: lcm-url 'nonsense': URLParser: Invalid URL: nonsense; write it like "
            "udpm://239.255.76.67:7667?ttl=1\n");
}

TEST_F(RealLog, EveryTypeIsDecodedByLcmSpy) {
  std::vector<LogEvent> events = replay::events_of(log_);
  const std::string all = test::temporary_folder("types") + "/all.log";
  lcm_io::LogWriter writer(all);
  for (const LogEvent& event : events) writer.write(event);
  depth_images_t depth{};
  depth.depth = lcm_io::to_png_message(cv::Mat1w(2, 3, static_cast<std::uint16_t>(1500)));
  writer.write(events.back().utime, "DEPTH_IMAGES", depth);
  writer.write(events.back().utime, "MODULE_STATUS", module_status_t{});
  writer.close();

  const auto listed = test::run({LIMBCAST_JAVA, "-Djava.awt.headless=true", "-cp",
                                 LIMBCAST_SPY_CLASSES, "limbcast.spy.ListLog", all});
  EXPECT_EQ(listed.exit_code, 0) << listed.output;
  for (const char* line :
       {"BODY_POSES limbcast.body_poses_t 2\n", "DEPTH_IMAGES limbcast.depth_images_t 1\n",
        "MODULE_STATUS limbcast.module_status_t 1\n", "POINT_CLOUD limbcast.point_cloud_t 2\n",
        "SEGMENTS limbcast.segments_t 2\n", "STEREO_CALIBRATION limbcast.stereo_calibration_t 1\n",
        "STEREO_IMAGES limbcast.stereo_images_t 2\n"})
    EXPECT_THAT(listed.output, HasSubstr(line));
}

/// The real lcm-spy beside a tracker and lcm-logplayer.
class LcmSpy : public RealLog {
 protected:
  LcmSpy() : bus_(url_) {
    if (!test::VirtualDisplay::available()) return;
    display_ = std::make_unique<test::VirtualDisplay>();
    bus_.subscribe<module_status_t>("MODULE_STATUS", lcm_io::Keep::kAll,
                                    [this](const module_status_t&) { ++num_status_; });
    tracker_ = start({test::program("limbcast-tracker"), "--lcm-url", url_}, "tracker");
    next_status();
    // Started last, so that it lists no channel of LCM's own test of itself.
    spy_ = start({test::repository_file("modules/spy/limbcast-spy"), "--lcm-url=" + url_}, "spy");
    main_window_ = display_->window("LCM Spy", *spy_);
  }
  void SetUp() override {
    if (!display_) GTEST_SKIP() << "Xvfb, xdotool or ImageMagick is missing";
    ASSERT_FALSE(main_window_.empty()) << spy_->output();
  }
  std::unique_ptr<test::ChildProcess> start(const std::vector<std::string>& command,
                                            const std::string& name) const {
    return std::make_unique<test::ChildProcess>(
        command, folder_ + "/" + name + ".txt",
        // Where lcm-spy listens by itself must not matter.
        std::vector<std::string>{display_->variable(), "LCM_DEFAULT_URL="});
  }
  void next_status() {
    const int before = num_status_;
    while (num_status_ == before) bus_.handle(std::chrono::milliseconds(100));
  }
  void play() const { test::run({"lcm-logplayer", "--lcm-url=" + url_, played_}); }

  /// A double click on the channel's row of the sorted table. Its identifier; empty: none came.
  std::string open(const std::string& channel) {
    const auto row = std::find(rows_.begin(), rows_.end(), channel) - rows_.begin();
    // Of Java's usual table [px].
    constexpr int kHead = 20, kRowHeight = 16;
    const cv::Point place(300, kHead + static_cast<int>(row) * kRowHeight + kRowHeight / 2);
    for (int i = 0; i < kMostPlays && !display_->has_window(channel); ++i) {
      play();
      display_->show(main_window_, {800, 600});
      display_->double_click(place);
    }
    return display_->has_window(channel) ? display_->window(channel, *spy_) : "";
  }
  /// The window in front, once it shows all that `is_right` wants (its parts are painted one by
  /// one); else as it was at last.
  cv::Mat picture_of(const std::string& window, cv::Size size,
                     const std::function<bool(const cv::Mat&)>& is_right) {
    cv::Mat picture;
    for (int i = 0; i < kMostPlays; ++i) {
      play();
      display_->show(window, size);
      picture = display_->screenshot()(cv::Rect({}, size));
      if (is_right(picture)) break;
    }
    return picture;
  }

  const std::string url_ = test::private_lcm_url();
  const std::string folder_ = test::temporary_folder("lcm_spy");
  /// The log that is played, and the channels that lcm-spy lists then.
  std::string played_ = log_;
  std::vector<std::string> rows_ = {"BODY_POSES",    "GROUND_TRUTH", "MODULE_STATUS",
                                    "POINT_CLOUD",   "SEGMENTS",     "STEREO_CALIBRATION",
                                    "STEREO_IMAGES", "TRACKED_POSES"};
  lcm_io::Bus bus_;
  int num_status_ = 0;
  std::unique_ptr<test::VirtualDisplay> display_;
  std::unique_ptr<test::ChildProcess> tracker_, spy_;
  std::string main_window_;
};

cv::Mat1b mask_of(const cv::Mat& picture, const cv::Vec3b& color) {
  cv::Mat1b mask;
  cv::inRange(picture, color, color, mask);
  return mask;
}

/// Where the views stand in the window, told by their grids: the plugin puts the three beside one
/// another with 8 pixels around each.
std::vector<cv::Rect> views_of(const cv::Mat& picture) {
  const cv::Rect all = cv::boundingRect(mask_of(picture, kGrid));
  const int column = (all.width + 15) / 3;
  std::vector<cv::Rect> views;
  for (int i = 0; i < 3; ++i)
    views.emplace_back(all.x + i * column, all.y, column - 16, all.height - 1);
  return views;
}

struct Limb {
  Joint from, to;
  cv::Vec3b color;
};
const std::vector<Limb> kLimbs = {{Joint::kShoulderLeft, Joint::kElbowLeft, kLeft},
                                  {Joint::kElbowLeft, Joint::kWristLeft, kLeft},
                                  {Joint::kHipLeft, Joint::kKneeLeft, kLeft},
                                  {Joint::kKneeLeft, Joint::kAnkleLeft, kLeft},
                                  {Joint::kShoulderRight, Joint::kElbowRight, kRight},
                                  {Joint::kElbowRight, Joint::kWristRight, kRight},
                                  {Joint::kHipRight, Joint::kKneeRight, kRight},
                                  {Joint::kKneeRight, Joint::kAnkleRight, kRight}};

/// Axes level with the ground: rows are right, down, forward.
Eigen::Matrix3f level_axes(const Eigen::Vector3f& down) {
  const Eigen::Vector3f forward = (Eigen::Vector3f::UnitZ() - down.z() * down).normalized();
  Eigen::Matrix3f axes;
  axes << down.cross(forward).transpose(), down.transpose(), forward.transpose();
  return axes;
}

/// Of the limbs of all persons, those whose middle has their colour at `pixel(right, down,
/// forward)`, and all.
std::pair<int, int> limbs_in_place(
    const cv::Mat& picture, const BodyPoses& poses,
    const std::function<cv::Point(const Eigen::Vector3f&)>& pixel_of) {
  const Eigen::Matrix3f axes = level_axes(poses.stamp.gravity.down);
  int in_place = 0, all = 0;
  for (const BodyPose& person : poses.persons) {
    for (const Limb& limb : kLimbs) {
      if (!person[limb.from].valid || !person[limb.to].valid) continue;
      const Eigen::Vector3f middle =
          axes * (person[limb.from].position_m + person[limb.to].position_m) / 2.0F;
      // A window that is not drawn yet has no views: places lie anywhere.
      const cv::Rect around = cv::Rect(pixel_of(middle) - cv::Point(1, 1), cv::Size(3, 3)) &
                              cv::Rect({}, picture.size());
      ++all;
      if (around.empty()) continue;
      in_place += cv::countNonZero(mask_of(picture(around), limb.color)) > 0 ? 1 : 0;
    }
  }
  return {in_place, all};
}

TEST_F(LcmSpy, DrawsSkeletonsWhereThePersonStands) {
  const std::string window = open("BODY_POSES");
  ASSERT_FALSE(window.empty()) << spy_->output();
  const BodyPoses poses = lcm_io::from_message(last<body_poses_t>("BODY_POSES"));
  ASSERT_FALSE(poses.persons.empty());

  // The room that is shown: 4 m wide, 3 m high, 5 m deep, the sensor in the middle of its front.
  const auto front = [](const cv::Rect& view, const Eigen::Vector3f& p) {
    const float scale =
        std::min(static_cast<float>(view.width) / 4.0F, static_cast<float>(view.height) / 3.0F);
    return cv::Point(cvRound(view.x + view.width / 2.0F + scale * p.x()),
                     cvRound(view.y + view.height / 2.0F + scale * p.y()));
  };
  const auto above = [](const cv::Rect& view, const Eigen::Vector3f& p) {
    const float scale =
        std::min(static_cast<float>(view.width) / 4.0F, static_cast<float>(view.height) / 5.0F);
    return cv::Point(cvRound(view.x + view.width / 2.0F + scale * p.x()),
                     cvRound(view.y + view.height / 2.0F - scale * (p.z() - 2.5F)));
  };
  const auto counts = [&](const cv::Mat& picture) {
    const std::vector<cv::Rect> views = views_of(picture);
    return std::pair{
        limbs_in_place(picture, poses, [&](const auto& p) { return front(views[0], p); }),
        limbs_in_place(picture, poses, [&](const auto& p) { return above(views[2], p); })};
  };
  // From above the trunk hides the legs.
  constexpr int kLeastFromAbove = 2;
  const cv::Mat picture = picture_of(window, {1200, 480}, [&](const cv::Mat& shown) {
    const auto [from_front, from_above] = counts(shown);
    return from_front.first == from_front.second && from_above.first >= kLeastFromAbove;
  });
  const auto [from_front, from_above] = counts(picture);
  EXPECT_GE(from_front.second, 6);
  EXPECT_EQ(from_front.first, from_front.second);
  EXPECT_GE(from_above.first, kLeastFromAbove);
  EXPECT_THAT(spy_->output(), HasSubstr("Found 4 plugins"));
}

/// How well the image, `width` pixels wide, is found somewhere in the picture: 1 is equal.
double likeness(const cv::Mat& picture, const cv::Mat& image, int width) {
  cv::Mat resized, score;
  cv::resize(image, resized, {width, width * image.rows / image.cols}, 0.0, 0.0, cv::INTER_AREA);
  cv::matchTemplate(picture, resized, score, cv::TM_CCOEFF_NORMED);
  double best = 0.0;
  cv::minMaxLoc(score, nullptr, &best);
  return best;
}

const cv::Size kImagesWindow(1000, 420);
/// A frame takes a few pixels of the window: so many are left for each image.
constexpr int kImageWidth = 495;
cv::Mat left_half(const cv::Mat& shown) { return shown(cv::Rect(0, 0, 502, 420)); }
cv::Mat right_half(const cv::Mat& shown) { return shown(cv::Rect(498, 0, 502, 420)); }

TEST_F(LcmSpy, ShowsBothImagesOfAPair) {
  const std::string window = open("STEREO_IMAGES");
  ASSERT_FALSE(window.empty()) << spy_->output();
  const auto pair = last<stereo_images_t>("STEREO_IMAGES");
  const cv::Mat left = lcm_io::from_message(pair.left), right = lcm_io::from_message(pair.right);
  const cv::Mat picture = picture_of(window, kImagesWindow, [&](const cv::Mat& shown) {
    return likeness(left_half(shown), left, kImageWidth) > 0.95 &&
           likeness(right_half(shown), right, kImageWidth) > 0.95;
  });
  EXPECT_GT(likeness(left_half(picture), left, kImageWidth), 0.95);
  EXPECT_GT(likeness(right_half(picture), right, kImageWidth), 0.95);
  EXPECT_LT(likeness(left_half(picture), right, kImageWidth),
            likeness(left_half(picture), left, kImageWidth));
}

TEST_F(LcmSpy, ShowsColorAndDepthBesideEachOther) {
  depth_images_t frame{};
  frame.stamp.sensor = "front";
  const cv::Mat color = lcm_io::from_message(last<stereo_images_t>("STEREO_IMAGES").left);
  frame.color = last<stereo_images_t>("STEREO_IMAGES").left;
  frame.depth_scale_m = 0.001;
  // A box half a metre away before a wall at 8 m, with a strip that was not measured.
  cv::Mat1w depth(color.size(), static_cast<std::uint16_t>(8000));
  depth(cv::Rect(200, 100, 200, 250)) = 500;
  depth.colRange(0, 60) = 0;
  frame.depth = lcm_io::to_png_message(depth);
  cv::Mat3b shades(color.size(), cv::Vec3b::all(26));
  shades(cv::Rect(200, 100, 200, 250)) = cv::Vec3b::all(255);
  shades.colRange(0, 60) = cv::Vec3b::all(0);

  played_ = folder_ + "/depth.log";
  rows_ = {"DEPTH_IMAGES", "MODULE_STATUS"};
  lcm_io::LogWriter log(played_);
  log.write(0, "DEPTH_IMAGES", frame);
  log.close();
  const std::string window = open("DEPTH_IMAGES");
  ASSERT_FALSE(window.empty()) << spy_->output();
  const cv::Mat picture = picture_of(window, kImagesWindow, [&](const cv::Mat& shown) {
    return likeness(left_half(shown), color, kImageWidth) > 0.95 &&
           likeness(right_half(shown), shades, kImageWidth) > 0.95;
  });
  EXPECT_GT(likeness(left_half(picture), color, kImageWidth), 0.95);
  EXPECT_GT(likeness(right_half(picture), shades, kImageWidth), 0.95);
}

TEST_F(LcmSpy, ListsModulesInATable) {
  const std::string window = open("MODULE_STATUS");
  ASSERT_FALSE(window.empty()) << spy_->output();
  // A module that waits has a yellow row.
  const auto waits = [](const cv::Mat& shown) {
    return cv::countNonZero(mask_of(shown, kWaiting)) > 5000;
  };
  // One picture tells: the table is painted anew with each status, and the next may be empty.
  bool is_shown = false;
  for (int i = 0; i < kMostPlays && !is_shown; ++i) {
    next_status();
    display_->show(window, {1100, 300});
    is_shown = waits(display_->screenshot());
  }
  EXPECT_TRUE(is_shown);
  EXPECT_THAT(spy_->output(), Not(HasSubstr("xception")));
}

}  // namespace
}  // namespace limbcast::spy

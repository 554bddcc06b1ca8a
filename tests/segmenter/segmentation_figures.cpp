// Prints how well people are found and cut out, set by set: the tables of
// modules/segmenter/README.md. limbcast-segmentation-figures [--true-depth] [--paper] [--kdtree]
// [--skin | --shape] [--true-heads] [--verbose] [--draw FOLDER] [SET...]
// --true-heads: grows from the true heads, so that the figures are those of growing alone.
// --draw: false pixels of segments red, missed ones of people blue.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/config/options.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/recorded_frames.hpp"
#include "tests/support/data_sets.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

constexpr const char* kProgram = "limbcast-segmentation-figures";

struct Arguments {
  DepthFrom depth_from = DepthFrom::kReconstructor;
  bool true_heads = false;
  bool verbose = false;
  std::string draw;
  Params params;
  test::DataSets sets{{"stereo_dev/general", "stereo_dev/pointing", "stereo_dev/multi",
                       "stereo_dev/nohuman", "stereo_dev/hd", "stereo_dev/sequence",
                       "rgbd_pointing", "rgbd_five_people", "laser_dev"}};
};

/// Sums over the people of one half of a set.
struct Sums {
  int people = 0, found = 0, measured = 0;
  double strict = 0.0, banded = 0.0, recall = 0.0, strict_recall = 0.0;
  int hands = 0, hands_kept = 0, ankles = 0, ankles_kept = 0;
};

/// Sums over the frames of a set.
struct SetSums {
  Sums tuning, checking;
  int frames = 0, wrong = 0, twice = 0, candidates = 0;
  double time_ms = 0.0;
};

cv::Mat1b segment_mask(const Segment& segment, cv::Size size) {
  cv::Mat1b mask(size, 0);
  if (!segment.range_image) return mask;
  const RangeImage& image = *segment.range_image;
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      const auto i = static_cast<std::size_t>(v) * static_cast<std::size_t>(image.camera.width) +
                     static_cast<std::size_t>(u);
      if (image.labels[i] == PixelLabel::kPerson)
        mask(v + image.origin_v, u + image.origin_u) = 255;
    }
  }
  return mask;
}

cv::Mat1b measured_pixels(const Cloud& cloud) {
  cv::Mat1b mask(cloud.height, cloud.width, static_cast<std::uint8_t>(0));
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i)
    mask(static_cast<int>(i)) = cloud.is_hole(i) ? 0 : 255;
  return mask;
}

void count_ends(const TruePerson& person, const char* end, const LoadedFrame& frame,
                const cv::Mat1b& mask, int& all, int& kept) {
  for (const char* side : {"_left", "_right"}) {
    const auto joint = person.joints_m.find(std::string(end) + side);
    if (joint == person.joints_m.end()) continue;
    const auto visible = person.visible.find(joint->first);
    if (visible == person.visible.end() || !visible->second) continue;
    const Eigen::Vector2f px = frame.cloud.camera->project(joint->second);
    const cv::Rect around =
        cv::Rect(static_cast<int>(px.x()) - 6, static_cast<int>(px.y()) - 6, 13, 13) &
        cv::Rect(0, 0, mask.cols, mask.rows);
    ++all;
    kept += !around.empty() && cv::countNonZero(mask(around)) > 0 ? 1 : 0;
  }
}

/// Pixels of one person: what the segment holds, and what the truth says that it should.
struct PersonPixels {
  cv::Mat1b segment, truth, wide_truth, measured_truth;

  PersonPixels(const LoadedFrame& frame, const TruePerson& person, const Segment& found)
      : segment(segment_mask(found, frame.mask.size())), truth(frame.mask == person.mask_index) {
    cv::dilate(truth, wide_truth, cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 7}));
    measured_truth = truth & measured_pixels(frame.cloud);
  }
};

double share(const cv::Mat1b& part, const cv::Mat1b& whole) {
  return cv::countNonZero(part & whole) / static_cast<double>(std::max(1, cv::countNonZero(whole)));
}

void measure_pixels(const LoadedFrame& frame, const TruePerson& person, const Segment& segment,
                    bool verbose, Sums& sums) {
  const PersonPixels pixels(frame, person, segment);
  if (cv::countNonZero(pixels.truth) < 400) return;
  const double strict = share(pixels.truth, pixels.segment),
               banded = share(pixels.wide_truth, pixels.segment),
               recall = share(pixels.segment, pixels.measured_truth);
  ++sums.measured;
  sums.strict += strict;
  sums.banded += banded;
  sums.recall += recall;
  const int hands_kept = sums.hands_kept - sums.hands, ankles_kept = sums.ankles_kept - sums.ankles;
  count_ends(person, "hand", frame, pixels.segment, sums.hands, sums.hands_kept);
  count_ends(person, "ankle", frame, pixels.segment, sums.ankles, sums.ankles_kept);
  if (verbose)
    std::printf(
        "  %s: %s precision %.3f (3 px %.3f) recall %.3f, lost %d hands %d ankles, %.1f m\n",
        frame.name.c_str(), person.body.c_str(), strict, banded, recall,
        hands_kept - sums.hands_kept + sums.hands, ankles_kept - sums.ankles_kept + sums.ankles,
        static_cast<double>(person.joints_m.at("head").norm()));
}

/// Colours what a segment holds beyond its person red, and what it lacks of it blue.
void draw_errors(const LoadedFrame& frame, const TruePerson& person, const Segment& segment,
                 cv::Mat& picture) {
  const PersonPixels pixels(frame, person, segment);
  picture.setTo(cv::Scalar(0, 0, 255), pixels.segment & ~pixels.wide_truth);
  picture.setTo(cv::Scalar(255, 0, 0), pixels.measured_truth & ~pixels.segment);
}

/// A segment that started nearer than this to a person's head is that person's.
constexpr float kSameHead_m = 0.20F;

/// Index of the person whose head the segment started from, -1 = none; `distance_m` to the nearest
/// head.
int match(const LoadedFrame& frame, const Segment& segment, float& distance_m) {
  const Eigen::Vector3f center_m = segment.seed_m + 0.085F * segment.seed_m.normalized();
  int best = -1;
  distance_m = 1e9F;
  for (std::size_t p = 0; p < frame.persons.size(); ++p) {
    const auto head = frame.persons[p].joints_m.find("head");
    if (head == frame.persons[p].joints_m.end()) continue;
    const float d = (head->second - center_m).norm();
    if (d < distance_m) {
      distance_m = d;
      best = static_cast<int>(p);
    }
  }
  return best;
}

void draw(const LoadedFrame& frame, const Segments& segments, const std::string& file) {
  static const std::vector<cv::Scalar> colors = {{0, 255, 0},   {255, 0, 0},   {0, 0, 255},
                                                 {255, 255, 0}, {0, 255, 255}, {255, 0, 255}};
  if (frame.color.empty()) return;
  cv::Mat picture = frame.color.clone();
  for (const Segment& segment : segments.segments) {
    const Eigen::Vector2f px = frame.cloud.camera->project(segment.seed_m);
    const cv::Point at(static_cast<int>(px.x()), static_cast<int>(px.y()));
    if (!segment.valid()) {
      cv::circle(picture, at, 4, {160, 160, 160}, 1);
      cv::putText(picture, std::to_string(static_cast<int>(segment.rejected_by)), at, 0, 0.4,
                  {200, 200, 200});
      continue;
    }
    const cv::Scalar& color = colors[static_cast<std::size_t>(segment.id) % colors.size()];
    const cv::Mat1b mask = segment_mask(segment, picture.size());
    cv::Mat tint(picture.size(), CV_8UC3, color), mixed;
    cv::addWeighted(picture, 0.5, tint, 0.5, 0, mixed);
    mixed.copyTo(picture, mask);
    cv::circle(picture, at, 6, color, 2);
    cv::putText(picture, cv::format("%.2f", static_cast<double>(segment.seed_score)), at, 0, 0.5,
                color);
  }
  for (const TruePerson& person : frame.persons) {
    for (const Segment& segment : segments.segments) {
      float distance_m = 0.0F;
      if (segment.valid() && !frame.mask.empty() &&
          match(frame, segment, distance_m) == &person - frame.persons.data() &&
          distance_m < kSameHead_m)
        draw_errors(frame, person, segment, picture);
    }
  }
  cv::imwrite(file, picture);
}

void add_frame(const LoadedFrame& frame, const Segments& segments, bool verbose, SetSums& sums) {
  constexpr float kSamePerson_m = 0.50F;
  std::vector<int> segment_of(frame.persons.size(), -1);
  for (std::size_t k = 0; k < segments.segments.size(); ++k) {
    const Segment& segment = segments.segments[k];
    ++sums.candidates;
    if (!segment.valid()) continue;
    float distance_m = 0.0F;
    const int person = match(frame, segment, distance_m);
    if (person >= 0 && distance_m < kSameHead_m &&
        segment_of[static_cast<std::size_t>(person)] < 0) {
      segment_of[static_cast<std::size_t>(person)] = static_cast<int>(k);
    } else {
      ++(distance_m < kSamePerson_m ? sums.twice : sums.wrong);
      if (verbose)
        std::printf("  %s: false at (%.2f %.2f %.2f), %.2f m from a head\n", frame.name.c_str(),
                    segment.seed_m.x(), segment.seed_m.y(), segment.seed_m.z(), distance_m);
    }
  }
  for (std::size_t p = 0; p < frame.persons.size(); ++p) {
    const TruePerson& person = frame.persons[p];
    if (!person.head_visible()) continue;
    Sums& half = person.for_checking() ? sums.checking : sums.tuning;
    ++half.people;
    if (segment_of[p] < 0) {
      if (verbose) {
        std::string why = "no candidate";
        const Eigen::Vector3f head = person.joints_m.at("head");
        for (const Segment& segment : segments.segments) {
          float d = 0.0F;
          if (!segment.valid() && match(frame, segment, d) == static_cast<int>(p) &&
              d < kSameHead_m) {
            why = cv::format("filter %d: %.2f against %.2f", static_cast<int>(segment.rejected_by),
                             static_cast<double>(segment.filter_figure),
                             static_cast<double>(segment.filter_limit));
          }
        }
        std::printf("  %s: %s missed at (%.2f %.2f %.2f): %s\n", frame.name.c_str(),
                    person.body.c_str(), head.x(), head.y(), head.z(), why.c_str());
      }
      continue;
    }
    ++half.found;
    if (!frame.mask.empty())
      measure_pixels(frame, person, segments.segments[static_cast<std::size_t>(segment_of[p])],
                     verbose, half);
  }
}

void print(const std::string& set, const char* half, const Sums& s) {
  if (s.people == 0) return;
  const double n = std::max(1, s.measured);
  std::printf(
      "%-22s %-8s found %3d/%3d (%5.1f %%)  precision %.3f (3 px %.3f)  recall %.3f  hands %d/%d  "
      "ankles %d/%d\n",
      set.c_str(), half, s.found, s.people, 100.0 * s.found / s.people, s.strict / n, s.banded / n,
      s.recall / n, s.hands_kept, s.hands, s.ankles_kept, s.ankles);
}

std::vector<Eigen::Vector3f> true_heads(const LoadedFrame& frame) {
  std::vector<Eigen::Vector3f> heads_m;
  for (const TruePerson& person : frame.persons) {
    if (person.head_visible()) heads_m.push_back(person.joints_m.at("head"));
  }
  return heads_m;
}

void run_set(const std::string& set, const Arguments& arguments) {
  const Segmenter segmenter(arguments.params);
  if (!arguments.draw.empty()) std::filesystem::create_directories(arguments.draw);
  const FrameReader reader(arguments.sets.folder(set), arguments.depth_from);
  SetSums sums;
  for (const std::string& path : reader.paths()) {
    const LoadedFrame frame = reader.read(path);
    const std::clock_t start = std::clock();
    const Segments segments = arguments.true_heads
                                  ? segmenter.cut_out_people(frame.cloud, true_heads(frame))
                                  : segmenter.segment(frame.cloud);
    ++sums.frames;
    sums.time_ms += 1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (!arguments.draw.empty()) draw(frame, segments, arguments.draw + "/" + frame.name + ".png");
    if (frame.labelled) add_frame(frame, segments, arguments.verbose, sums);
  }
  print(set, "tuning", sums.tuning);
  print(set, "checking", sums.checking);
  const double n = std::max(1, sums.frames);
  std::printf(
      "%-22s %d frames: false %d, twice %d, candidates %.1f a frame, %.2f ms of CPU a frame\n",
      set.c_str(), sums.frames, sums.wrong, sums.twice, sums.candidates / n, sums.time_ms / n);
  std::fflush(stdout);
}

/// Nothing where only help was asked for.
std::optional<Arguments> read_arguments(int argc, char** argv) {
  Arguments arguments;
  bool true_depth = false, paper = false, kd_tree = false, skin = false, shape = false;
  config::Section section("figures");
  section.add("true-depth", true_depth, "true depths instead of matched ones");
  section.add("paper", paper, "regions grow as in the paper");
  section.add("kdtree", kd_tree, "neighbours are found in a k-d tree");
  section.add("skin", skin, "seeds by skin colour alone");
  section.add("shape", shape, "seeds by shape alone");
  section.add("true-heads", arguments.true_heads, "true heads instead of seeds");
  section.add("verbose", arguments.verbose, "a line a person");
  section.add("draw", arguments.draw, "folder for pictures of the segments");
  config::Parser parser(kProgram, "Prints how much of people their segments hold, and of others.");
  arguments.sets.declare(section, parser);
  parser.add(section);
  if (!parser.parse(argc, argv)) return std::nullopt;
  if (true_depth) arguments.depth_from = DepthFrom::kTruth;
  if (paper) arguments.params.growing = Growing::kPaper;
  if (kd_tree) arguments.params.search = SearchStructure::kKdTree;
  if (skin) arguments.params.seeds = SeedSource::kSkin;
  if (shape) arguments.params.seeds = SeedSource::kShape;
  return arguments;
}

}  // namespace

int main(int argc, char** argv) {
  return config::run_program(kProgram, [&] {
    const auto arguments = read_arguments(argc, argv);
    if (!arguments) return;
    for (const std::string& set : arguments->sets.names) run_set(set, *arguments);
  });
}

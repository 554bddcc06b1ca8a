#include "modules/segmenter/faces_and_joints/depth_pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "common/human_model/joints.hpp"
#include "common/units.hpp"
#include "modules/segmenter/networks/network.hpp"
#include "modules/segmenter/range_image.hpp"

// The files in ../networks/network_files.S.
extern "C" const char limbcast_depth_pose[];
extern "C" const char limbcast_scan_depth_pose[];
extern "C" const char limbcast_bent_depth_pose[];

namespace limbcast::segmenter {
namespace {

// The networks' output: cells of a grid over the picture, what a cell tells of each joint, and a
// last figure whose mean over all cells is the log odds that a person is there.
constexpr int kCells = 32, kCellSide_px = kDepthPictureSide_px / kCells;
constexpr std::size_t kCellCount = std::size_t{kCells} * kCells;
enum Kind { kPresence, kOffsetU, kOffsetV, kBehind, kSight, kKinds };
constexpr int kPersonFigure = kKinds * kJointCount, kFigures = kPersonFigure + 1;
/// What a unit of the depths it tells is [m].
constexpr float kDepthUnit_m = 0.25F;

/// Read when it is first asked for.
template <const char* kBytes>
const TfliteFile& file_in() {
  static const TfliteFile file = read_tflite(kBytes);
  return file;
}

/// What all cells tell, row by row.
using Figures = std::vector<float>;

Figures figures_of(TfliteNetwork& network, const cv::Mat4f& picture) {
  const auto* channels = picture.ptr<float>();
  std::copy(channels, channels + picture.total() * picture.channels(), network.input());
  network.run();
  const float* output = network.output(0);
  return {output, output + kCellCount * kFigures};
}

/// Adds what the mirrored picture's cells tell, of the joints as they are in the picture itself.
void add_mirrored(const Figures& mirrored_figures, Figures& figures) {
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      const auto begin = [row](int of_column) {
        return static_cast<std::size_t>(row * kCells + of_column) * kFigures;
      };
      float* sums = figures.data() + begin(column);
      const float* seen = mirrored_figures.data() + begin(kCells - 1 - column);
      for (int kind = 0; kind < kKinds; ++kind) {
        const float sign = kind == kOffsetU ? -1.0F : 1.0F;
        for (int joint = 0; joint < kJointCount; ++joint)
          sums[kind * kJointCount + joint] += sign * seen[kind * kJointCount + mirrored(joint)];
      }
      sums[kPersonFigure] += seen[kPersonFigure];
    }
  }
}

/// The mean of what the network told of a picture and of what it tells of its mirror image: a tenth
/// to a sixth less is told wrong than by one look (tests/accuracy/README.md).
Figures figures_of_both(TfliteNetwork& network, const cv::Mat4f& picture, Figures figures) {
  cv::Mat4f mirror;
  constexpr int kLeftToRight = 1;
  cv::flip(picture, mirror, kLeftToRight);
  add_mirrored(figures_of(network, mirror), figures);
  for (float& figure : figures) figure *= 0.5F;
  return figures;
}

/// What one cell tells of a joint.
class Cell {
 public:
  Cell(const Figures& figures, std::size_t cell, int joint)
      : figures_(figures.data() + cell * kFigures + joint) {}

  float presence_odds() const { return figure(kPresence); }
  /// From the cell's middle [cells].
  Eigen::Vector2f offset() const { return {figure(kOffsetU), figure(kOffsetV)}; }
  float behind_middle_m() const { return kDepthUnit_m * figure(kBehind); }
  float visibility() const { return probability(figure(kSight)); }

 private:
  float figure(Kind kind) const { return figures_[kind * kJointCount]; }
  const float* figures_;
};

/// A joint in the picture.
struct SeenInDepths {
  Eigen::Vector2f px;
  float behind_middle_m, presence_odds, visibility;
};

/// As the cell tells that is surest of it.
SeenInDepths find_joint(const Figures& figures, int joint) {
  std::size_t best = 0;
  for (std::size_t cell = 1; cell < kCellCount; ++cell) {
    if (Cell(figures, cell, joint).presence_odds() > Cell(figures, best, joint).presence_odds())
      best = cell;
  }
  const Cell cell(figures, best, joint);
  const std::size_t column = best % kCells, row = best / kCells;
  const Eigen::Vector2f middle_cell(static_cast<float>(column), static_cast<float>(row));
  constexpr float kHalf = 0.5F;
  const Eigen::Vector2f px =
      ((middle_cell + cell.offset()).array() + kHalf) * static_cast<float>(kCellSide_px) - kHalf;
  return {px, cell.behind_middle_m(), cell.presence_odds(), cell.visibility()};
}

float person_odds(const Figures& figures) {
  float sum = 0.0F;
  for (std::size_t cell = 0; cell < kCellCount; ++cell)
    sum += figures[cell * kFigures + kPersonFigure];
  return sum / static_cast<float>(kCellCount);
}

/// What the network sees in a picture.
struct SeenPerson {
  float odds = 0.0F;
  std::array<SeenInDepths, kJointCount> joints;
};

SeenPerson read_figures(const Figures& figures) {
  SeenPerson seen;
  seen.odds = person_odds(figures);
  for (int joint = 0; joint < kJointCount; ++joint)
    seen.joints[static_cast<std::size_t>(joint)] = find_joint(figures, joint);
  return seen;
}

Eigen::Vector3f place_in_picture_m(const DepthPicture& picture, const SeenInDepths& joint) {
  return picture.camera.back_project(joint.px.x(), joint.px.y(),
                                     picture.middle_m + joint.behind_middle_m);
}

/// Angle of the spine against gravity.
float trunk_lean_deg(const DepthPicture& picture, const SeenPerson& person) {
  const auto middle_m = [&](Joint left, Joint right) -> Eigen::Vector3f {
    const auto& joints = person.joints;
    return 0.5F * (place_in_picture_m(picture, joints[index(left)]) +
                   place_in_picture_m(picture, joints[index(right)]));
  };
  const Eigen::Vector3f spine_m = middle_m(Joint::kHipLeft, Joint::kHipRight) -
                                  middle_m(Joint::kShoulderLeft, Joint::kShoulderRight);
  return kDegreesPerRadian<float> * std::atan2(std::hypot(spine_m.x(), spine_m.z()), spine_m.y());
}

/// Of a mark whose log odds are so high.
float spread_m(float presence_odds, const DepthPoseParams& params) {
  return std::min(params.even_odds_spread_m * std::exp(-params.spread_log_slope * presence_odds),
                  params.max_spread_m);
}

/// Nothing where the log odds of a person are lower than that.
std::optional<SeenPerson> ask(InstancePool<TfliteNetwork>& networks, const DepthPicture& picture,
                              float min_odds, const DepthPoseParams& params) {
  return networks.with([&](TfliteNetwork& network) -> std::optional<SeenPerson> {
    Figures figures = figures_of(network, picture.channels);
    if (person_odds(figures) < min_odds - params.mirror_adds_odds) return std::nullopt;
    figures = figures_of_both(network, picture.channels, std::move(figures));
    if (person_odds(figures) < min_odds) return std::nullopt;
    return read_figures(figures);
  });
}

}  // namespace

std::optional<ImagePose> in_pixels(const PoseInDepths& pose, const RangeImage& view) {
  ImagePose seen;
  seen.person_score = pose.person_score;
  std::array<float, kJointCount> depth_m{};
  for (std::size_t i = 0; i < pose.places_m.size(); ++i) {
    const Eigen::Vector3f place_m = view.frame_from_image.transpose() * pose.places_m[i];
    if (!(place_m.z() > 0.0F)) return std::nullopt;
    depth_m[i] = place_m.z();
    seen.joints.push_back({static_cast<Joint>(i), image_px(view, place_m), pose.visibilities[i],
                           0.0F, pose.spreads_m[i]});
  }
  const float hips_m = 0.5F * (depth_m[index(Joint::kHipLeft)] + depth_m[index(Joint::kHipRight)]);
  for (ImageJoint& joint : seen.joints) joint.behind_hips_m = depth_m[index(joint.joint)] - hips_m;
  return seen;
}

DepthPose::DepthPose(const DepthPoseParams& params) : params_(params) {
  if (!params.enabled) return;
  // A robot's sensors are mostly of one kind: the other's network is never loaded.
  const auto pool = [library = params.library](const TfliteFile& (*file)()) {
    return std::make_unique<InstancePool<TfliteNetwork>>(
        [library, file] {
          return std::make_unique<TfliteNetwork>(file(), std::vector<std::string>{"joints"},
                                                 library);
        },
        FirstInstance::kWhenAskedFor);
  };
  of_cameras_ = pool(file_in<limbcast_depth_pose>);
  of_scans_ = pool(file_in<limbcast_scan_depth_pose>);
  of_bent_ = pool(file_in<limbcast_bent_depth_pose>);
}

std::optional<PoseInDepths> DepthPose::look(const DepthPicture& picture) const {
  return see_person(picture, -std::numeric_limits<float>::infinity());
}

std::optional<PoseInDepths> DepthPose::see_person(const DepthPicture& picture,
                                                  float min_person_odds) const {
  if (!params_.enabled) return std::nullopt;
  auto seen = ask(picture.of_scan ? *of_scans_ : *of_cameras_, picture, min_person_odds, params_);
  if (!seen || seen->odds < params_.sure_person_odds) {
    const float asked_odds = (seen ? seen->odds : min_person_odds) + params_.bent_surer_by;
    auto bent = ask(*of_bent_, picture, asked_odds, params_);
    if (bent && (!picture.of_scan || trunk_lean_deg(picture, *bent) > params_.min_scanned_lean_deg))
      seen = std::move(bent);
  }
  if (!seen) return std::nullopt;
  PoseInDepths pose;
  pose.person_score = probability(seen->odds);
  for (std::size_t i = 0; i < seen->joints.size(); ++i) {
    const SeenInDepths& joint = seen->joints[i];
    pose.places_m[i] = picture.frame_from_picture * place_in_picture_m(picture, joint);
    pose.visibilities[i] = probability(joint.presence_odds) * joint.visibility;
    pose.spreads_m[i] = spread_m(joint.presence_odds, params_);
  }
  return pose;
}

}  // namespace limbcast::segmenter

#include <opencv2/imgproc.hpp>

#include "common/formatted.hpp"
#include "common/units.hpp"
#include "modules/viewer/painting.hpp"
#include "modules/viewer/pictures.hpp"

namespace limbcast::viewer {
namespace {

constexpr int kColumns = 4, kRows = 2;
const cv::Size kCell(kSheetSize.width / kColumns, kSheetSize.height / kRows);  // one picture [px]
constexpr double kTextSize = 0.45;
constexpr int kLineHeight = 18;
/// Lines that fit into the cell of words.
constexpr int kMaxLines = 19;

const char* source_name(GravitySource source) {
  switch (source) {
    case GravitySource::kRecording:
      return "recording";
    case GravitySource::kOption:
      return "option";
    case GravitySource::kGroundPlane:
      return "ground plane";
    case GravitySource::kLevel:
      return "taken as level";
  }
  return "";
}

/// Nothing where it is not told.
std::string degrees(float sigma_rad) {
  return sigma_rad > 0.0F
             ? formatted(" +-%.1f deg", kDegreesPerRadian<double> * static_cast<double>(sigma_rad))
             : "";
}

void append_modules(const std::vector<ModuleFigures>& modules, std::vector<std::string>& lines) {
  for (const ModuleFigures& figures : modules) {
    std::string line = formatted("%.20s on %.16s: %.1f/s", figures.module.c_str(),
                                 figures.host.c_str(), figures.rate_out_hz);
    if (figures.latency_p50_ms) line += formatted(", latency %.0f ms", *figures.latency_p50_ms);
    lines.push_back(line);
  }
}

void append_person(const BodyPose& person, std::vector<std::string>& lines) {
  lines.push_back(formatted("person %d: error %.3f, confidence %.2f", person.id,
                            static_cast<double>(person.error),
                            static_cast<double>(person.confidence)));
  for (const Pointing& arm : person.pointing) {
    lines.push_back(formatted("  points, %s arm%s, confidence %.2f",
                              arm.side == Side::kLeft ? "left" : "right",
                              degrees(arm.sigma_rad).c_str(), static_cast<double>(arm.confidence)));
    lines.push_back(formatted("    to (%.2f %.2f %.2f)", static_cast<double>(arm.direction.x()),
                              static_cast<double>(arm.direction.y()),
                              static_cast<double>(arm.direction.z())));
  }
}

std::vector<std::string> words(const ViewFrame& frame) {
  std::vector<std::string> lines = {
      formatted("frame %d of sensor %.40s", frame.number, frame.stamp.sensor.c_str()),
      formatted("utime %lld", static_cast<long long>(frame.stamp.utime)),
      formatted("gravity: %s", source_name(frame.stamp.gravity.source))};
  append_modules(frame.modules, lines);
  if (frame.segments) {
    int valid = 0;
    for (const Segment& segment : frame.segments->segments) valid += segment.valid() ? 1 : 0;
    lines.push_back(formatted("%d segments, %d rejected", valid,
                              static_cast<int>(frame.segments->segments.size()) - valid));
  }
  if (frame.truth)
    lines.push_back(formatted("%d people in truth", static_cast<int>(frame.truth->persons.size())));
  if (frame.poses) {
    lines.push_back(formatted("%d people found", static_cast<int>(frame.poses->persons.size())));
    for (const BodyPose& person : frame.poses->persons) append_person(person, lines);
  }
  if (static_cast<int>(lines.size()) > kMaxLines) lines.resize(kMaxLines);
  return lines;
}

/// The picture scaled into the cell without changing its shape.
void place(const cv::Mat& picture, const cv::Mat& cell) {
  const double scale = std::min(static_cast<double>(cell.cols) / picture.cols,
                                static_cast<double>(cell.rows) / picture.rows);
  const cv::Size size(cvRound(picture.cols * scale), cvRound(picture.rows * scale));
  cv::Mat target =
      cell(cv::Rect({(cell.cols - size.width) / 2, (cell.rows - size.height) / 2}, size));
  cv::resize(picture, target, size, 0.0, 0.0, cv::INTER_AREA);
}

}  // namespace

cv::Mat draw_sheet(const ViewFrame& frame, const std::vector<Picture>& pictures) {
  cv::Mat sheet(kSheetSize, CV_8UC3, cv::Scalar::all(0));
  const auto cell = [&sheet](int i) {
    return sheet(cv::Rect({i % kColumns * kCell.width, i / kColumns * kCell.height}, kCell));
  };
  for (int i = 0; i < static_cast<int>(pictures.size()) && i < kColumns * kRows - 1; ++i) {
    const Picture& picture = pictures[static_cast<std::size_t>(i)];
    cv::Mat target = cell(i);
    place(picture.image, target);
    draw_text(target, picture.title, {8, 18}, kTextSize);
  }
  cv::Mat last = cell(kColumns * kRows - 1);
  int y = 24;
  for (const std::string& line : words(frame)) {
    draw_text(last, line, {12, y}, kTextSize);
    y += kLineHeight;
  }
  return sheet;
}

}  // namespace limbcast::viewer

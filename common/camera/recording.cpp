#include "common/camera/recording.hpp"

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "common/config/byte_order_mark.hpp"
#include "common/file_extension.hpp"
#include "common/input_file.hpp"

namespace limbcast {
namespace {

namespace fs = std::filesystem;

const std::string kTimestampsFile = "timestamps.csv";
constexpr std::size_t kColumnsWithoutGravity = 2;
constexpr std::size_t kColumnsWithGravity = 5;
/// In the year 2100; nanoseconds, as ROS and many drivers count them, lie far beyond.
constexpr std::int64_t kLatest_us = 4'102'444'800'000'000;
constexpr const char* kBlanks = " \t\r";

bool is_blank(const std::string& line) {
  return line.find_first_not_of(kBlanks) == std::string::npos;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) {
    const auto begin = field.find_first_not_of(kBlanks);
    const auto end = field.find_last_not_of(kBlanks);
    fields.push_back(begin == std::string::npos ? "" : field.substr(begin, end - begin + 1));
  }
  if (!line.empty() && line.back() == ',') fields.emplace_back();
  return fields;
}

template <class T>
std::optional<T> number(const std::string& text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

std::optional<Eigen::Vector3f> read_down(const std::vector<std::string>& fields) {
  Eigen::Vector3f down;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value =
        number<float>(fields[kColumnsWithoutGravity + static_cast<std::size_t>(axis)]);
    if (!value) return std::nullopt;
    down[axis] = *value;
  }
  // Written with few digits a unit vector still has about this length.
  if (!(std::abs(down.norm() - 1.0F) < 0.05F)) return std::nullopt;
  return down.normalized();
}

class TimestampsReader {
 public:
  explicit TimestampsReader(const std::string& path) : path_(path) {
    check_is_file(path, "remove or rename it");
    file_.open(path);
    if (!file_) throw InputError(path + ": cannot be read; check that it may be read");
  }

  std::vector<FrameTime> read() {
    read_header();
    std::vector<FrameTime> times;
    for (std::string line; std::getline(file_, line);) {
      ++line_number_;
      if (!is_blank(line)) times.push_back(read_line(split(line)));
    }
    std::stable_sort(times.begin(), times.end(),
                     [](const FrameTime& a, const FrameTime& b) { return a.utime < b.utime; });
    return times;
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& advice) const {
    throw InputError(path_ + ":" + std::to_string(line_number_) + ": " + found + "; " + advice);
  }

  void read_header() {
    std::string line;
    while (std::getline(file_, line)) {
      line = config::without_byte_order_mark(line);
      if (!is_blank(line)) break;
      ++line_number_;
    }
    const std::vector<std::string> header = split(line);
    const std::vector<std::string> full = {"name", "utime", "down_x", "down_y", "down_z"};
    columns_ = header.size();
    if ((columns_ != kColumnsWithoutGravity && columns_ != kColumnsWithGravity) ||
        !std::equal(header.begin(), header.end(), full.begin())) {
      fail("the header is '" + line + "'",
           "write 'name,utime' or 'name,utime,down_x,down_y,down_z'");
    }
  }

  FrameTime read_line(const std::vector<std::string>& fields) {
    if (fields.size() != columns_) {
      fail("has " + std::to_string(fields.size()) + " fields, the header " +
               std::to_string(columns_),
           "is the file complete?");
    }
    FrameTime time;
    time.name = fields[0];
    const auto utime = number<std::int64_t>(fields[1]);
    if (!utime || *utime < 0)
      fail("utime is '" + fields[1] + "'", "must be whole microseconds >= 0");
    if (*utime > kLatest_us)
      fail("utime is '" + fields[1] + "'", "must be microseconds since 1970, not nanoseconds");
    time.utime = *utime;
    if (columns_ == kColumnsWithGravity) {
      time.down = read_down(fields);
      if (!time.down) fail("down_x, down_y, down_z are no unit vector", "correct them");
    }
    if (!names_.insert(time.name).second) fail("'" + time.name + "' stands twice", "remove one");
    if (!utimes_.insert(time.utime).second)
      fail("utime " + fields[1] + " stands twice", "correct one");
    return time;
  }

  std::string path_;
  std::ifstream file_;
  std::size_t columns_ = 0;
  int line_number_ = 1;
  std::set<std::string> names_;
  std::set<std::int64_t> utimes_;
};

bool is_picture(const fs::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

bool is_link(const fs::path& path) {
  std::error_code nothing_there;
  return fs::is_symlink(path, nothing_there);
}

/// A file or a link to one: a folder or a pipe may be called like a frame. Throws InputError for a
/// link that leads to nothing: a disk that is not there must not pass for a recording of fewer
/// frames.
bool is_file(const fs::path& path) {
  std::error_code unreachable;
  const fs::file_status status = fs::status(path, unreachable);
  if (unreachable && is_link(path))
    throw InputError(path.string() +
                     ": is a link to what is not there or may not be read; mount or "
                     "copy it, or remove the link");
  return fs::is_regular_file(status);
}

/// Frames of a folder by name, without times.
std::map<std::string, RecordedFrame> find_files(const fs::path& folder, const FilePair& pair) {
  std::map<std::string, RecordedFrame> frames;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!is_picture(entry.path()) || !is_file(entry.path())) continue;
    const std::string stem = entry.path().stem().string();
    for (const bool is_first : {true, false}) {
      const std::string end = "_" + (is_first ? pair.first : pair.second);
      if (stem.size() == end.size() || !boost::algorithm::ends_with(stem, end)) continue;
      RecordedFrame& frame = frames[stem.substr(0, stem.size() - end.size())];
      std::string& path = is_first ? frame.first_path : frame.second_path;
      if (!path.empty()) {
        throw InputError(entry.path().string() + ": the same picture is there as " + path +
                         " too; remove one");
      }
      path = entry.path().string();
    }
  }
  for (auto& [name, frame] : frames) {
    const fs::path truth = folder / (name + "_gt.json");
    if (is_file(truth)) frame.truth_path = truth.string();
  }
  return frames;
}

void check_partners(const RecordedFrame& frame, const std::string& name, const std::string& folder,
                    const FilePair& pair) {
  for (const bool is_first : {true, false}) {
    if (!(is_first ? frame.first_path : frame.second_path).empty()) continue;
    const std::string& lonely = is_first ? frame.second_path : frame.first_path;
    const std::string& partner = is_first ? pair.first : pair.second;
    std::ostringstream text;
    text << folder << ": " << lonely << " has no partner " << name << "_" << partner
         << ".jpg or .png; add it or remove the frame";
    throw InputError(text.str());
  }
}

/// Puts the files in the order of their times.
Recording with_times(const std::map<std::string, RecordedFrame>& files, const std::string& folder,
                     const RecordingParams& params) {
  Recording recording;
  const fs::path timestamps = fs::path(folder) / kTimestampsFile;
  recording.has_timestamps = fs::exists(timestamps) || is_link(timestamps);
  if (recording.has_timestamps) {
    for (const FrameTime& time : read_timestamps(timestamps.string())) {
      const auto found = files.find(time.name);
      if (found == files.end()) {
        throw InputError(timestamps.string() + ": names '" + time.name +
                         "', but there is no such frame; add it or remove the line");
      }
      recording.frames.push_back(found->second);
      recording.frames.back().time = time;
    }
    recording.frames_without_time =
        static_cast<int>(files.size()) - static_cast<int>(recording.frames.size());
  } else {
    for (const auto& [name, frame] : files) {
      const double offset_us = 1e6 * static_cast<double>(recording.frames.size()) / params.rate_hz;
      recording.frames.push_back(frame);
      recording.frames.back().time = {name, params.start_utime + std::llround(offset_us), {}};
    }
  }
  if (recording.frames.empty()) {
    throw InputError(timestamps.string() + ": names no frame; add lines or remove the file");
  }
  return recording;
}

}  // namespace

std::vector<FrameTime> read_timestamps(const std::string& path) {
  return TimestampsReader(path).read();
}

Recording find_recording(const std::string& folder, const FilePair& pair,
                         const RecordingParams& params) {
  if (!fs::is_directory(folder)) {
    throw InputError(folder + ": is no folder; give one with NAME_" + pair.first +
                     ".jpg and NAME_" + pair.second + " pictures");
  }
  std::map<std::string, RecordedFrame> files = find_files(folder, pair);
  if (files.empty()) {
    throw InputError(folder + ": has no NAME_" + pair.first + " and NAME_" + pair.second +
                     " pictures (jpg or png); give another folder");
  }
  const bool has_first = std::any_of(
      files.begin(), files.end(), [](const auto& file) { return !file.second.first_path.empty(); });
  if (has_first || !params.first_is_optional) {
    for (const auto& [name, frame] : files) check_partners(frame, name, folder, pair);
  }
  return with_times(files, folder, params);
}

Recording find_recording_of_files(const std::string& folder,
                                  const std::vector<std::string>& extensions,
                                  const RecordingParams& params) {
  std::map<std::string, RecordedFrame> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) continue;
    if (!is_file(entry.path())) continue;
    const std::string name = entry.path().stem().string();
    RecordedFrame& frame = files[name];
    if (!frame.first_path.empty()) {
      throw InputError(entry.path().string() + ": the same frame is there as " + frame.first_path +
                       " too; remove one");
    }
    frame.first_path = entry.path().string();
    const fs::path truth = fs::path(folder) / (name + "_gt.json");
    if (is_file(truth)) frame.truth_path = truth.string();
  }
  if (files.empty()) {
    std::string wanted;
    for (const std::string& extension : extensions) wanted.append(" ").append(extension);
    throw InputError(folder + ": has no files of" + wanted + "; give another folder");
  }
  return with_times(files, folder, params);
}

std::int64_t round_duration_us(const Recording& recording, double rate_hz) {
  const std::vector<RecordedFrame>& frames = recording.frames;
  if (frames.size() < 2) return std::llround(1e6 / rate_hz);
  const std::int64_t duration_us = frames.back().time.utime - frames.front().time.utime;
  return duration_us + duration_us / static_cast<std::int64_t>(frames.size() - 1);
}

}  // namespace limbcast

#include "modules/evaluate/truth_folder.hpp"

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/human_model/ground_truth_json.hpp"
#include "common/input_error.hpp"

namespace limbcast::evaluate {
namespace {

std::vector<std::string> files_of(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (boost::algorithm::ends_with(entry.path().string(), "_gt.json"))
      paths.push_back(entry.path().string());
  }
  if (error) throw InputError(folder + ": cannot be read (" + error.message() + "); give a folder");
  if (paths.empty()) throw InputError(folder + ": holds no *_gt.json; give a folder with truth");
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Name of the body of each person; read_ground_truth() has found the file sound.
std::vector<std::string> body_names(const std::string& path) {
  std::ifstream file(path);
  const nlohmann::json truth = nlohmann::json::parse(file);
  std::vector<std::string> names;
  for (const nlohmann::json& person : truth.at("persons")) {
    const auto body = person.find("body");
    names.push_back(body != person.end() && body->is_string() ? body->get<std::string>() : "");
  }
  return names;
}

bool begins_with_any(const std::string& name, const std::vector<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(), [&name](const std::string& beginning) {
    return name.rfind(beginning, 0) == 0;
  });
}

TruthFrame read_frame(const std::string& path, const std::vector<std::string>& bodies) {
  TruthFrame frame{read_ground_truth(path), {}};
  if (bodies.empty()) return frame;
  for (const std::string& name : body_names(path))
    frame.counts.push_back(begins_with_any(name, bodies));
  return frame;
}

bool any_person_counts(const std::vector<TruthFrame>& frames) {
  return std::any_of(frames.begin(), frames.end(), [](const TruthFrame& frame) {
    return std::count(frame.counts.begin(), frame.counts.end(), true) > 0;
  });
}

}  // namespace

std::vector<TruthFrame> read_truth_folders(const std::vector<std::string>& folders,
                                           const std::vector<std::string>& bodies) {
  std::vector<TruthFrame> frames;
  std::map<std::int64_t, std::string> path_at;
  for (const std::string& path : truth_files(folders)) {
    frames.push_back(read_frame(path, bodies));
    const std::int64_t utime = frames.back().poses.stamp.utime;
    const auto [first, is_new] = path_at.emplace(utime, path);
    if (!is_new)
      throw InputError(path + ": has the same utime (" + std::to_string(utime) + ") as " +
                       first->second +
                       ", so that one report would count twice; leave out one of the folders or "
                       "files");
  }
  if (!bodies.empty() && !any_person_counts(frames))
    throw InputError("no person of the truth has one of the bodies; see \"body\" in NAME_gt.json");
  std::stable_sort(frames.begin(), frames.end(), [](const TruthFrame& a, const TruthFrame& b) {
    return a.poses.stamp.utime < b.poses.stamp.utime;
  });
  return frames;
}

std::vector<std::string> truth_files(const std::vector<std::string>& folders) {
  std::vector<std::string> paths;
  for (const std::string& folder : folders) {
    const std::vector<std::string> files = files_of(folder);
    paths.insert(paths.end(), files.begin(), files.end());
  }
  return paths;
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

}  // namespace limbcast::evaluate

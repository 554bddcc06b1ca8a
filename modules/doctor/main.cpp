#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/segments_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <sstream>

#include "common/config/log.hpp"
#include "common/config/options.hpp"
#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/lcm_url.hpp"
#include "common/lcm_io/module.hpp"
#include "modules/doctor/host_checks.hpp"
#include "modules/doctor/report.hpp"
#include "modules/doctor/traffic.hpp"

namespace limbcast::doctor {
namespace {

constexpr const char* kStatusChannel = lcm_io::kStatusChannel;
/// LCM sends on it when a program starts.
constexpr const char* kSelfTestChannel = "LCM_SELF_TEST";

struct Options {
  double listen_s = 3.0;
  std::string expect;
  bool json = false;
};

KnownChannels known_channels() {
  return {{"STEREO_IMAGES", stereo_images_t::getHash()},
          {"STEREO_CALIBRATION", stereo_calibration_t::getHash()},
          {"DEPTH_IMAGES", depth_images_t::getHash()},
          {"POINT_CLOUD", point_cloud_t::getHash()},
          {"SEGMENTS", segments_t::getHash()},
          {"BODY_POSES", body_poses_t::getHash()},
          {"TRACKED_POSES", body_poses_t::getHash()},
          {"GROUND_TRUTH", body_poses_t::getHash()},
          {kStatusChannel, module_status_t::getHash()}};
}

std::string this_host() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream in(list);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  if (std::count(words.begin(), words.end(), "") > 0 || list.find(' ') != std::string::npos)
    throw config::UsageError("'expect' is '" + list +
                             "', must be names with commas between, as segmenter,pose_fitter");
  return words;
}

void add_status(const lcm_io::ReceivedMessage& message, Traffic& traffic) {
  try {
    const auto status = lcm_io::decode<module_status_t>(message.bytes);
    traffic.reports.push_back({status.module, status.host, status.pid, status.utime,
                               message.received_utime, status.num_lost, status.state,
                               status.last_error});
  } catch (const lcm_io::MessageError&) {
    // The channel's check names the foreign type.
  }
}

void add(const lcm_io::ReceivedMessage& message, Traffic& traffic) {
  if (message.channel == kSelfTestChannel) return;
  ChannelTraffic& channel = traffic.channels[message.channel];
  const auto size = static_cast<std::int64_t>(message.bytes.size());
  ++channel.messages;
  channel.bytes += size;
  channel.largest = std::max(channel.largest, size);
  channel.fingerprints.insert(lcm_io::fingerprint_of(message.bytes));
  if (message.channel == kStatusChannel) add_status(message, traffic);
}

Traffic listen(const std::string& url, double duration_s) {
  using Clock = std::chrono::steady_clock;
  Traffic traffic;
  lcm_io::Bus bus(url);
  bus.subscribe_everything(
      [&traffic](const lcm_io::ReceivedMessage& message) { add(message, traffic); });
  const auto start = Clock::now();
  const auto elapsed_s = [&start] {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  constexpr std::chrono::milliseconds kWait{50};
  while (elapsed_s() < duration_s && !lcm_io::stop_requested()) bus.handle(kWait);
  traffic.duration_s = elapsed_s();
  return traffic;
}

void append(Findings& all, Findings findings) {
  all.insert(all.end(), std::make_move_iterator(findings.begin()),
             std::make_move_iterator(findings.end()));
}

/// True: all is good.
bool examine(const Options& options, const std::string& url_text) {
  const std::vector<std::string> expected = words_of(options.expect);
  const auto multicast = lcm_io::parse_multicast_url(url_text);
  if (!multicast)
    throw config::UsageError("lcm-url '" + url_text +
                             "': is no multicast URL such as udpm://239.255.76.67:7667?ttl=1");
  const auto with_buffer =
      lcm_io::parse_multicast_url(lcm_io::with_receive_buffer(url_text)).value();
  const UrlFacts url{url_text, multicast->address, multicast->ttl, with_buffer.recv_buf_size,
                     multicast->recv_buf_size > 0};
  const HostFacts before = read_host_facts("/", url.group);
  Findings findings = check_route(before, url);
  Traffic traffic;
  if (lcm_io::why_unreachable(*multicast).empty()) traffic = listen(url_text, options.listen_s);
  append(findings, check_ttl(url));
  append(findings, check_receive_buffer(before, url, largest_message(traffic)));
  append(findings, check_reassembly(before, url));
  append(findings, check_drops(before, read_host_facts("/", url.group)));
  append(findings, check_cpu(before));
  append(findings, check_channels(traffic, known_channels()));
  append(findings, check_modules(traffic, expected));
  append(findings, check_clocks(traffic, this_host()));
  const std::string report =
      options.json ? report_json(findings, traffic, this_host(), url_text) : report_text(findings);
  std::fputs(report.c_str(), stdout);
  return !has_problem(findings);
}

/// True: all is good.
bool run(int argc, const char* const* argv) {
  Options options;
  config::Section section("doctor");
  section.add("listen-s", options.listen_s, "s", "how long to listen; modules report each second",
              {1.0, 3600.0});
  section.add("expect", options.expect,
              "modules that must be heard, separated by commas, e.g. segmenter,pose_fitter; "
              "default: the chain, once any module is heard");
  section.add("json", options.json, "print the findings as JSON");
  config::Parser parser("limbcast-doctor",
                        "Checks whether this host and what it hears are fit for limbcast; exits "
                        "with 0 where all is good, 1 where something is to be mended.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return true;
  config::configure_log("doctor", parser.common().log_level);
  lcm_io::install_signal_handlers();
  return examine(options, lcm_io::chosen_url(parser.common().lcm_url));
}

}  // namespace
}  // namespace limbcast::doctor

int main(int argc, char** argv) {
  bool good = true;
  const int exit_code = limbcast::config::run_program(
      "limbcast-doctor", [&] { good = limbcast::doctor::run(argc, argv); });
  return exit_code != 0 ? exit_code : good ? 0 : 1;
}

#include "modules/log/message_types.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/segments_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <string_view>

#include "common/lcm_io/decode.hpp"

namespace limbcast::logs {
namespace {

constexpr std::size_t kFingerprintBytes = 8;

/// What LCM itself sends, on LCM_SELF_TEST, at the start of a program: no message of any type.
constexpr std::string_view kSelfTest = "lcm self test";

std::optional<stamp_t> stamp_of(const module_status_t& /*message*/) { return std::nullopt; }
std::optional<stamp_t> stamp_of(const stereo_calibration_t& /*message*/) { return std::nullopt; }
template <class Message>
std::optional<stamp_t> stamp_of(const Message& message) {
  return message.stamp;
}

template <class Message>
MessageSummary summary_of(const lcm_io::LogEvent& event) {
  MessageSummary summary;
  summary.type = Message::getTypeName();
  try {
    summary.stamp = stamp_of(lcm_io::decode<Message>(event.data));
  } catch (const lcm_io::MessageError& error) {
    summary.malformed = error.what();
  }
  return summary;
}

struct KnownType {
  std::int64_t fingerprint;
  MessageSummary (*summarize)(const lcm_io::LogEvent&);
};

template <class Message>
KnownType known() {
  return {Message::getHash(), &summary_of<Message>};
}

const std::array<KnownType, 7>& known_types() {
  static const std::array<KnownType, 7> types = {
      known<stereo_images_t>(),      known<depth_images_t>(), known<point_cloud_t>(),
      known<segments_t>(),           known<body_poses_t>(),   known<module_status_t>(),
      known<stereo_calibration_t>(),
  };
  return types;
}

/// Big endian, as LCM writes all numbers.
std::optional<std::int64_t> fingerprint_of(const lcm_io::LogEvent& event) {
  if (event.data.size() < kFingerprintBytes) return std::nullopt;
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < kFingerprintBytes; ++i) value = (value << 8U) | event.data[i];
  return static_cast<std::int64_t>(value);
}

}  // namespace

MessageSummary summarize(const lcm_io::LogEvent& event) {
  if (std::equal(event.data.begin(), event.data.end(), kSelfTest.begin(), kSelfTest.end()))
    return {"LCM's self-test", {}, {}};
  const auto fingerprint = fingerprint_of(event);
  for (const KnownType& type : known_types())
    if (fingerprint == type.fingerprint) return type.summarize(event);
  return {};
}

std::string fingerprint_text(const lcm_io::LogEvent& event) {
  const auto fingerprint = fingerprint_of(event);
  if (!fingerprint) return "none";
  std::array<char, 2 * kFingerprintBytes + 1> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(*fingerprint));
  return text.data();
}

}  // namespace limbcast::logs

#include "tests/multi_host/cable.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>

namespace limbcast::test {
namespace {

/// How long the thread may take to see that it shall end [ms].
constexpr int kWaitMs = 50;
/// An Ethernet frame with a payload of 1500 bytes, and room for tags.
constexpr std::size_t kLargestFrame = 2048;

/// The next frame that a device holds; empty: none, or the link is down.
std::vector<std::uint8_t> read_frame(int tap) {
  std::vector<std::uint8_t> frame(kLargestFrame);
  const ssize_t size = read(tap, frame.data(), frame.size());
  frame.resize(static_cast<std::size_t>(std::max<ssize_t>(0, size)));
  return frame;
}

/// A device that is down refuses the frame; so does a cable that is not plugged in.
void write_frame(int tap, const std::vector<std::uint8_t>& frame) {
  [[maybe_unused]] const ssize_t written = write(tap, frame.data(), frame.size());
}

}  // namespace

Cable::Cable(int host_tap, int switch_tap)
    : host_tap_(host_tap), switch_tap_(switch_tap), carrier_(&Cable::carry, this) {}

Cable::~Cable() {
  ending_ = true;
  carrier_.join();
  close(host_tap_);
  close(switch_tap_);
}

void Cable::impair(const Impairment& impairment) {
  const std::lock_guard lock(mutex_);
  impairment_ = impairment;
}

void Cable::carry() {
  while (!ending_) {
    std::array<pollfd, 2> devices{{{host_tap_, POLLIN, 0}, {switch_tap_, POLLIN, 0}}};
    poll(devices.data(), devices.size(), wait_ms());
    if ((devices[0].revents & POLLIN) != 0) read_host();
    if ((devices[1].revents & POLLIN) != 0) write_frame(host_tap_, read_frame(switch_tap_));
    send_due();
  }
}

void Cable::read_host() {
  std::vector<std::uint8_t> frame = read_frame(host_tap_);
  const std::lock_guard lock(mutex_);
  if (happens(impairment_.loss_percent)) return;
  const bool at_once = happens(impairment_.reorder_percent);
  const std::chrono::duration<double, std::milli> delay{at_once ? 0.0 : impairment_.delay_ms};
  delayed_.push({Clock::now() + std::chrono::duration_cast<Clock::duration>(delay), next_order_++,
                 std::move(frame)});
}

void Cable::send_due() {
  while (!delayed_.empty() && delayed_.top().due <= Clock::now()) {
    write_frame(switch_tap_, delayed_.top().frame);
    delayed_.pop();
  }
}

int Cable::wait_ms() const {
  if (delayed_.empty()) return kWaitMs;
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(delayed_.top().due - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, kWaitMs));
}

bool Cable::happens(double percent) {
  return std::uniform_real_distribution<double>(0.0, 100.0)(random_) < percent;
}

}  // namespace limbcast::test

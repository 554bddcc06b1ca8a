#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <queue>
#include <random>
#include <thread>
#include <vector>

namespace limbcast::test {

/// What a link does to the packets that a host sends; the words are those of tc-netem(8).
struct Impairment {
  double loss_percent = 0.0;
  double delay_ms = 0.0;
  /// Packets that are sent at once instead of being delayed, and so overtake others.
  double reorder_percent = 0.0;
};

/// A link in user space, for kernels without netem: carries Ethernet frames between two TAP devices
/// and treats those of the first as the impairment says. Random, but the same with every run.
class Cable {
 public:
  /// File descriptors of the devices, closed with the cable.
  Cable(int host_tap, int switch_tap);
  ~Cable();
  Cable(const Cable&) = delete;
  Cable& operator=(const Cable&) = delete;

  void impair(const Impairment& impairment);

 private:
  using Clock = std::chrono::steady_clock;
  struct Delayed {
    Clock::time_point due;
    std::uint64_t order;
    std::vector<std::uint8_t> frame;
    bool operator<(const Delayed& other) const {
      return due != other.due ? due > other.due : order > other.order;
    }
  };

  void carry();
  void read_host();
  void send_due();
  int wait_ms() const;
  bool happens(double percent);

  int host_tap_, switch_tap_;
  std::atomic<bool> ending_{false};
  std::mutex mutex_;
  Impairment impairment_;
  std::mt19937 random_;
  std::priority_queue<Delayed> delayed_;
  std::uint64_t next_order_ = 0;
  std::thread carrier_;
};

}  // namespace limbcast::test

#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "common/sources/live_capture.hpp"

namespace limbcast::test {

/// A camera that the test plays: gives what `push` gave, fails where `end` was called.
class PlayedCamera {
 public:
  void push(CapturedFrame frame) { queue_->push(std::move(frame)); }
  /// The reader fails once all frames were read.
  void end() { queue_->push(std::nullopt); }
  OpenReader opener() const {
    return [queue = queue_] { return std::make_unique<Reader>(queue); };
  }

 private:
  /// Shared with the capture's thread, which may live longer than the test.
  struct Queue {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::optional<CapturedFrame>> frames;

    void push(std::optional<CapturedFrame> frame) {
      const std::lock_guard lock(mutex);
      frames.push_back(std::move(frame));
      changed.notify_all();
    }
    std::optional<CapturedFrame> pop() {
      std::unique_lock lock(mutex);
      changed.wait(lock, [this] { return !frames.empty(); });
      std::optional<CapturedFrame> frame = std::move(frames.front());
      frames.pop_front();
      return frame;
    }
  };
  class Reader : public FrameReader {
   public:
    explicit Reader(std::shared_ptr<Queue> queue) : queue_(std::move(queue)) {}
    std::optional<CapturedFrame> read() override { return queue_->pop(); }

   private:
    std::shared_ptr<Queue> queue_;
  };
  std::shared_ptr<Queue> queue_ = std::make_shared<Queue>();
};

}  // namespace limbcast::test

#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/sources/picture.hpp"

namespace limbcast {

/// A picture and when it was taken.
struct CapturedFrame {
  std::int64_t utime = 0;  ///< [us since the Unix epoch]
  Picture picture;
};

struct CapturedPair {
  std::int64_t utime = 0;  ///< middle of the two
  Picture first, second;
};

/// Brings frames of two cameras together that were taken at the same time.
class PairMatcher {
 public:
  /// `tolerance_us`: largest difference of the two times. A synchronised pair of cameras differs by
  /// less than 1 ms; two free running ones by up to half a frame.
  explicit PairMatcher(std::int64_t tolerance_us) : tolerance_us_(tolerance_us) {}

  /// Frames of one camera come in the order of their times.
  void add_first(CapturedFrame frame) { add(firsts_, std::move(frame)); }
  void add_second(CapturedFrame frame) { add(seconds_, std::move(frame)); }
  /// The oldest pair that is complete. Frames that cannot get a partner any more are dropped and
  /// counted.
  std::optional<CapturedPair> take();
  std::int64_t unpaired() const { return unpaired_; }

 private:
  void add(std::deque<CapturedFrame>& frames, CapturedFrame frame);
  void drop_front(std::deque<CapturedFrame>& frames);

  std::int64_t tolerance_us_;
  std::deque<CapturedFrame> firsts_, seconds_;
  std::int64_t unpaired_ = 0;
};

}  // namespace limbcast

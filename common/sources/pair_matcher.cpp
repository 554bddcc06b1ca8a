#include "common/sources/pair_matcher.hpp"

#include <cstdlib>
#include <utility>

namespace limbcast {
namespace {

constexpr std::size_t kLongestQueue = 8;

}  // namespace

std::optional<CapturedPair> PairMatcher::take() {
  while (!firsts_.empty() && !seconds_.empty()) {
    const std::int64_t difference_us = seconds_.front().utime - firsts_.front().utime;
    // A later frame of the one that is behind may fit better than its present one.
    std::deque<CapturedFrame>& behind = difference_us > 0 ? firsts_ : seconds_;
    const std::int64_t other_utime =
        difference_us > 0 ? seconds_.front().utime : firsts_.front().utime;
    const bool next_is_nearer = behind.size() > 1 && std::abs(behind[1].utime - other_utime) <
                                                         std::abs(behind[0].utime - other_utime);
    if (next_is_nearer || std::abs(difference_us) > tolerance_us_) {
      drop_front(behind);
      continue;
    }
    CapturedPair pair{firsts_.front().utime + difference_us / 2, std::move(firsts_.front().picture),
                      std::move(seconds_.front().picture)};
    firsts_.pop_front();
    seconds_.pop_front();
    return pair;
  }
  return std::nullopt;
}

/// Where the other camera is silent, frames would pile up without end.
void PairMatcher::add(std::deque<CapturedFrame>& frames, CapturedFrame frame) {
  frames.push_back(std::move(frame));
  if (frames.size() > kLongestQueue) drop_front(frames);
}

void PairMatcher::drop_front(std::deque<CapturedFrame>& frames) {
  frames.pop_front();
  ++unpaired_;
}

}  // namespace limbcast

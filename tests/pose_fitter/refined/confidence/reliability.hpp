#pragma once

#include <vector>

namespace limbcast::pose_fitter {

/// A probability that was told, and whether it came true.
struct Told {
  double probability = 0.0;
  bool came_true = false;
};

/// Prints how many of the cases came true that were told with about a probability.
void print_reliability(const char* what, const std::vector<Told>& cases);

}  // namespace limbcast::pose_fitter

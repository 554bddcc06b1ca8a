#include "tests/pose_fitter/refined/confidence/reliability.hpp"

#include <cstdio>
#include <iterator>

namespace limbcast::pose_fitter {

void print_reliability(const char* what, const std::vector<Told>& cases) {
  constexpr double kEdges[] = {0.0, 0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 1.0};
  std::printf("%s\n     told   cases  mean told  came true\n", what);
  for (std::size_t k = 0; k + 1 < std::size(kEdges); ++k) {
    int count = 0, positive = 0;
    double sum = 0.0;
    for (const Told& told : cases) {
      if (told.probability < kEdges[k] || told.probability >= kEdges[k + 1]) continue;
      ++count;
      positive += told.came_true ? 1 : 0;
      sum += told.probability;
    }
    if (count == 0) continue;
    std::printf("%.2f-%.2f  %6d  %9.3f  %9.3f\n", kEdges[k], kEdges[k + 1], count, sum / count,
                static_cast<double>(positive) / count);
  }
}

}  // namespace limbcast::pose_fitter

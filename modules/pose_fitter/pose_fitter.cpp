#include "modules/pose_fitter/pose_fitter.hpp"

#include <tbb/parallel_for.h>

#include <utility>
#include <vector>

#include "modules/pose_fitter/paper/paper_fitter.hpp"
#include "modules/pose_fitter/refined/refined_fitter.hpp"
#include "modules/pose_fitter/same_person.hpp"

namespace limbcast::pose_fitter {

PoseFitter::PoseFitter(const PoseFitterOptions& options) {
  if (options.method == "paper") {
    fit_one_ = [fitter = PaperFitter(to_paper_params(options))](const Segment& segment,
                                                                const Stamp& stamp) {
      std::optional<PersonCandidate> candidate;
      if (auto pose = fitter.fit(segment, stamp)) candidate.emplace().pose = std::move(*pose);
      return candidate;
    };
  } else {
    fit_one_ = [fitter = RefinedFitter(options.refined)](const Segment& segment,
                                                         const Stamp& stamp) {
      return fitter.fit(segment, stamp);
    };
  }
}

BodyPoses PoseFitter::fit(const Segments& segments) const {
  std::vector<std::optional<PersonCandidate>> fitted(segments.segments.size());
  tbb::parallel_for(std::size_t{0}, fitted.size(), [&](std::size_t i) {
    const Segment& segment = segments.segments[i];
    if (segment.valid()) fitted[i] = fit_one_(segment, segments.stamp);
  });
  std::vector<PersonCandidate> candidates;
  for (std::optional<PersonCandidate>& candidate : fitted) {
    if (candidate) candidates.push_back(std::move(*candidate));
  }
  BodyPoses poses{segments.stamp, leave_out_doubtful(std::move(candidates))};
  remove_double_reports(poses.persons);
  return poses;
}

}  // namespace limbcast::pose_fitter

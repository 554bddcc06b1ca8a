#include "modules/pose_fitter/company.hpp"

#include <algorithm>
#include <utility>

namespace limbcast::pose_fitter {

std::vector<BodyPose> leave_out_doubtful(std::vector<PersonCandidate> candidates) {
  const bool company =
      std::any_of(candidates.begin(), candidates.end(), [](const PersonCandidate& candidate) {
        return !candidate.needs_company && candidate.pose.confidence >= kLeastCompanyConfidence;
      });
  std::vector<BodyPose> persons;
  for (PersonCandidate& candidate : candidates) {
    if (company || !candidate.needs_company) persons.push_back(std::move(candidate.pose));
  }
  return persons;
}

}  // namespace limbcast::pose_fitter

#pragma once

#include <optional>

#include "modules/pose_fitter/refined/confidence/person_evidence.hpp"

namespace limbcast::pose_fitter::refined {

/// The body of least cost, in the observation's frame, and what speaks for it.
struct FittedBody {
  Observation observation;
  BodyState body;
  Real cost = 0.0;
  Evidence evidence;
  PersonEvidence person;
};

/// Nothing when there are too few points for a person.
std::optional<FittedBody> fit_body(const Segment& segment, const Stamp& stamp,
                                   const RefinedParams& params);

}  // namespace limbcast::pose_fitter::refined

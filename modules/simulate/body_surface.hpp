#pragma once

#include "modules/simulate/body.hpp"
#include "modules/simulate/skeleton.hpp"
#include "modules/simulate/surface.hpp"

namespace limbcast::simulate {

/// Indices of a person's materials.
enum BodyMaterial : int {
  kSkin,
  kTop,
  kBottom,
  kHairColor,
  kShoes,
  kHatColor,
  kBagColor,
  kFaceSkin
};

/// The dressed skin of `body` around `skeleton`, in the skeleton's frame. `person`: index in the
/// mask.
///
/// Radii are fractions of the stature, read off the profiles of bodies D1-D3 of the rendered data
/// (depth of the trunk 0.13, width at waist 0.15 and hips 0.20, head 0.11 deep and 0.095 wide) and
/// off the depths of the joints behind the skin in data/README.md.
Surface make_body_surface(const BodyShape& body, const Posture& posture, const Skeleton& skeleton,
                          int person);

/// Head, face, hair and hat: the part of make_body_surface above the neck.
void add_head(const BodyShape& body, const Skeleton& skeleton, SurfaceBuilder& builder);
/// Hand with fingers as `shape` says, `side` the value of Side.
void add_hand(const BodyShape& body, const Skeleton& skeleton, HandShape shape, int side,
              SurfaceBuilder& builder);

}  // namespace limbcast::simulate

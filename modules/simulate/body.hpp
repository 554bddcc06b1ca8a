#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "common/cloud/cloud.hpp"
#include "modules/simulate/random.hpp"

namespace limbcast::simulate {

enum class Sleeve { kNone, kShort, kLong };
enum class Legwear { kTrousers, kShorts, kSkirt, kLongSkirt };
enum class Hair { kBald, kShort, kLong, kBun, kAfro, kHeadscarf };
enum class Hat { kNone, kCap, kBeanie, kBrim };

/// What a person wears and how it lies on the body.
struct Clothes {
  Sleeve sleeve = Sleeve::kLong;
  Legwear legwear = Legwear::kTrousers;
  Hair hair = Hair::kShort;
  Hat hat = Hat::kNone;
  bool jacket = false;
  bool beard = false;
  bool backpack = false;
  double sleeve_m = 0.006;   ///< thickness of cloth and air over the arm [m]
  double torso_m = 0.006;    ///< over the trunk [m]
  double legs_m = 0.010;     ///< over the leg [m]
  double wrinkle_m = 0.003;  ///< height of folds [m]
  Bgr skin, top, top_second, bottom, hair_color, shoes, hat_color;
  int top_pattern = 0;  ///< see Material::pattern
};

/// One person's body: bone lengths and girths in metres, all of them already scaled by the stature.
///
/// Means: bone lengths between joint centres and profiles of bodies D1-D3 of the rendered data
/// (fractions of stature); spread: about that of ANSUR II (Gordon et al. 2014), 3 to 6 %. Children:
/// head and trunk grow, legs shrink with falling stature (Snyder et al., Anthropometry of Infants,
/// Children and Youths to Age 18, 1977: head height 0.19 of the stature at 1.0 m, 0.13 in adults;
/// sitting height 0.57 and 0.52).
struct BodyShape {
  std::string name;
  double stature_m = 1.75;
  bool female = false;
  double upper_arm_m = 0.0, forearm_m = 0.0, hand_m = 0.0;  ///< hand: wrist to fingertip
  double thigh_m = 0.0, shank_m = 0.0, ankle_height_m = 0.0, foot_m = 0.0;
  double shoulder_half_m = 0.0, hip_half_m = 0.0;
  double pelvis_chest_m = 0.0, chest_neck_m = 0.0, neck_head_m = 0.0;
  double shoulder_drop_m = 0.0;  ///< shoulders under the neck joint, arms level
  double scapula_gain = 1.0;     ///< how much of the mean shoulder motion this person shows
  double head_scale = 1.0;       ///< of the head of a mean adult of this stature
  double trunk_girth = 1.0, limb_girth = 1.0, hip_girth = 1.0, waist_girth = 1.0;
  double belly_m = 0.0;   ///< how far the belly stands out [m]
  double breast_m = 0.0;  ///< radius [m], 0 = none
  Clothes clothes;
};

struct BodyParams {
  double child_share = 0.2;    ///< of all people; the rest are adults
  double min_stature_m = 1.0;  ///< of children
  double plain_share = 0.35;   ///< of tops in one colour
  double coat_share = 0.0;     ///< of all people; who stands outdoors in winter wears one
};

/// Draws a person. The same generator state gives the same person.
BodyShape draw_body(Rng& rng, const BodyParams& params = {});

}  // namespace limbcast::simulate

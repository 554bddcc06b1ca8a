#include "modules/simulate/body_surface.hpp"

#include <algorithm>
#include <utility>

namespace limbcast::simulate {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<Material> materials_of(const BodyShape& body) {
  const Clothes& clothes = body.clothes;
  const auto plain = [](Bgr color, float grain) {
    Material material;
    material.color = material.second = color;
    material.grain = grain;
    return material;
  };
  std::vector<Material> materials(8);
  materials[kSkin] = plain(clothes.skin, 0.05F);
  materials[kTop] = plain(clothes.top, 0.12F);
  materials[kTop].second = clothes.top_second;
  materials[kTop].pattern = static_cast<Pattern>(clothes.top_pattern);
  materials[kTop].scale_m = 0.06F;
  materials[kBottom] = plain(clothes.bottom, 0.12F);
  materials[kHairColor] = plain(clothes.hair_color, 0.20F);
  materials[kShoes] = plain(clothes.shoes, 0.08F);
  materials[kHatColor] = plain(clothes.hat_color, 0.10F);
  materials[kBagColor] = plain(clothes.top_second, 0.10F);
  materials[kFaceSkin] = materials[kSkin];
  materials[kFaceSkin].second = clothes.hair_color;
  materials[kFaceSkin].pattern = Pattern::kFace;
  materials[kFaceSkin].scale_m = static_cast<float>(body.stature_m * body.head_scale);
  return materials;
}

/// Everything that the parts need.
struct Figure {
  const BodyShape& body;
  const Posture& posture;
  const Skeleton& skeleton;

  double height() const { return body.stature_m; }
  Vector3d at_pelvis(double x, double y, double z) const {
    return skeleton[Joint::kPelvis] + skeleton.pelvis_R * (height() * Vector3d(x, y, z));
  }
  Vector3d at_chest(double x, double y, double z) const {
    return skeleton[Joint::kChest] + skeleton.chest_R * (height() * Vector3d(x, y, z));
  }
  Vector3d joint(Joint left, int side) const { return skeleton[on_side(left, Side(side))]; }
};

void add_trunk(const Figure& figure, SurfaceBuilder& builder) {
  const BodyShape& body = figure.body;
  const Clothes& clothes = body.clothes;
  const double h = figure.height();
  const double cloth = clothes.torso_m;
  const Vector3d pelvis_left = figure.skeleton.pelvis_R.col(0);
  const Vector3d chest_left = figure.skeleton.chest_R.col(0);
  const auto thick = [&](double fraction, double girth) { return fraction * h * girth + cloth; };

  builder.begin_group(0.020 * h);
  builder.as(Part::kTrunk, kBottom, clothes.wrinkle_m);
  const double hips = 0.057 * h * body.hip_girth + 0.5 * clothes.legs_m;
  builder.cone(figure.at_pelvis(0, -0.010, 0.008), figure.at_pelvis(0, 0.030, 0.016), hips, hips,
               pelvis_left, 1.48);
  builder.ellipsoid(figure.at_pelvis(0.045, -0.02, -0.014), figure.skeleton.pelvis_R,
                    Vector3d::Constant(0.047 * h * body.hip_girth));
  builder.ellipsoid(figure.at_pelvis(-0.045, -0.02, -0.014), figure.skeleton.pelvis_R,
                    Vector3d::Constant(0.047 * h * body.hip_girth));

  builder.as(Part::kTrunk, kTop, clothes.wrinkle_m);
  const Vector3d waist =
      0.5 * (figure.at_pelvis(0, 0.090, 0.020) + figure.at_chest(0, -0.090, 0.0));
  const Vector3d ribs = figure.at_chest(0, 0.015, 0.000);
  const Vector3d breast = figure.at_chest(0, 0.070, -0.003);
  const double waist_girth = body.trunk_girth * body.waist_girth;
  builder.cone(figure.at_pelvis(0, 0.035, 0.016), waist, thick(0.057, body.hip_girth),
               thick(0.056, waist_girth), pelvis_left, 1.32);
  builder.cone(waist, ribs, thick(0.056, waist_girth), thick(0.058, body.trunk_girth), chest_left,
               1.28);
  builder.cone(ribs, breast, thick(0.058, body.trunk_girth), thick(0.047, body.trunk_girth),
               chest_left, 1.45);
  if (body.belly_m > 0.005) {
    builder.ball(waist + figure.skeleton.pelvis_R * Vector3d(0, -0.01 * h, body.belly_m),
                 thick(0.055, waist_girth));
  }
  for (int side = 0; side < 2; ++side) {
    const double out = side == 0 ? 1.0 : -1.0;
    const Vector3d shoulder = figure.joint(Joint::kShoulderLeft, side);
    if (body.breast_m > 0.0) {
      builder.ball(figure.at_chest(0.040 * out, 0.025, 0.060) -
                       figure.skeleton.chest_R.col(2) * (0.6 * body.breast_m),
                   body.breast_m + 0.5 * cloth);
    }
    const double shoulder_radius = thick(0.026, body.limb_girth);
    // Chest muscle, shoulder blade and trapezius hold the shoulder wherever the arm takes it.
    builder.cone(figure.at_chest(0.045 * out, 0.045, 0.005), shoulder,
                 thick(0.040, body.trunk_girth), shoulder_radius);
    builder.cone(figure.at_chest(0.030 * out, 0.125, -0.008), shoulder,
                 thick(0.027, body.trunk_girth), 0.9 * shoulder_radius);
  }
  builder.as(Part::kNeck, clothes.jacket ? kTop : kSkin);
  const Vector3d head = figure.skeleton[Joint::kHead];
  const Vector3d neck = figure.skeleton[Joint::kNeck];
  builder.cone(neck - 0.02 * h * figure.skeleton.chest_R.col(1), neck + 0.55 * (head - neck),
               0.031 * h * body.limb_girth + 0.5 * cloth, 0.029 * h * body.limb_girth);
}

/// The open jacket or long shirt that falls over the hips.
void add_hem(const Figure& figure, SurfaceBuilder& builder) {
  const BodyShape& body = figure.body;
  const bool skirt =
      body.clothes.legwear == Legwear::kSkirt || body.clothes.legwear == Legwear::kLongSkirt;
  if (!body.clothes.jacket || skirt || figure.posture.seated) return;
  const double h = figure.height();
  const double radius = 0.062 * h * body.hip_girth + body.clothes.torso_m;
  builder.begin_group(0.02 * h);
  builder.as(Part::kTrunk, kTop, body.clothes.wrinkle_m);
  builder.cone(figure.at_pelvis(0, 0.06, 0.016), figure.at_pelvis(0, -0.035, 0.008), radius,
               1.08 * radius, figure.skeleton.pelvis_R.col(0), 1.42);
}

void add_backpack(const Figure& figure, SurfaceBuilder& builder) {
  if (!figure.body.clothes.backpack) return;
  builder.begin_group(0.02);
  builder.as(Part::kBag, kBagColor);
  const double depth = 0.045 * figure.height();
  builder.cone(figure.at_chest(0, 0.06, -0.095), figure.at_chest(0, -0.09, -0.100), depth,
               1.2 * depth, figure.skeleton.chest_R.col(0), 1.9);
}

void add_arm(const Figure& figure, int side, SurfaceBuilder& builder) {
  const BodyShape& body = figure.body;
  const Clothes& clothes = body.clothes;
  const double h = figure.height();
  const Vector3d shoulder = figure.joint(Joint::kShoulderLeft, side);
  const Vector3d elbow = figure.joint(Joint::kElbowLeft, side);
  const Vector3d wrist = figure.joint(Joint::kWristLeft, side);
  const double girth = h * body.limb_girth;
  const bool upper_covered = clothes.sleeve != Sleeve::kNone;
  const bool lower_covered = clothes.sleeve == Sleeve::kLong;
  const double upper_cloth = upper_covered ? clothes.sleeve_m : 0.0;
  const double lower_cloth = lower_covered ? clothes.sleeve_m : 0.0;

  builder.begin_group(0.008 * h);
  const double elbow_cloth = clothes.sleeve == Sleeve::kShort ? 0.0 : upper_cloth;
  builder.as(on_side(Part::kUpperArmLeft, side),
             upper_covered && clothes.sleeve == Sleeve::kLong ? kTop : kSkin,
             elbow_cloth > 0.0 ? clothes.wrinkle_m : 0.0);
  builder.cone(shoulder, elbow, 0.0305 * girth + upper_cloth, 0.0222 * girth + elbow_cloth);
  if (clothes.sleeve == Sleeve::kShort) {
    builder.as(on_side(Part::kUpperArmLeft, side), kTop, clothes.wrinkle_m);
    builder.cone(shoulder, shoulder + 0.55 * (elbow - shoulder), 0.033 * girth + upper_cloth,
                 0.030 * girth + 1.3 * upper_cloth);
  }
  builder.as(on_side(Part::kForearmLeft, side), lower_covered ? kTop : kSkin,
             lower_covered ? clothes.wrinkle_m : 0.0);
  const Vector3d belly = elbow + 0.25 * (wrist - elbow);  // the forearm's muscles
  builder.cone(elbow, belly, 0.0215 * girth + lower_cloth, 0.0222 * girth + lower_cloth);
  builder.cone(belly, elbow + 0.96 * (wrist - elbow), 0.0222 * girth + lower_cloth,
               0.0148 * girth + lower_cloth);
  add_hand(body, figure.skeleton, figure.posture.arms[side].hand, side, builder);
}

void add_leg(const Figure& figure, int side, SurfaceBuilder& builder) {
  const BodyShape& body = figure.body;
  const Clothes& clothes = body.clothes;
  const double h = figure.height();
  const Vector3d hip = figure.joint(Joint::kHipLeft, side);
  const Vector3d knee = figure.joint(Joint::kKneeLeft, side);
  const Vector3d ankle = figure.joint(Joint::kAnkleLeft, side);
  const Vector3d left = figure.skeleton.pelvis_R.col(0);
  const Vector3d thigh_front = (knee - hip).normalized().cross(left);
  const Vector3d shank_front = (ankle - knee).normalized().cross(left);
  const double girth = h * body.limb_girth;
  const bool trousers = clothes.legwear == Legwear::kTrousers;
  const bool shorts = clothes.legwear == Legwear::kShorts;
  const double thigh_cloth = trousers || shorts ? clothes.legs_m : 0.0;
  const double shank_cloth = trousers ? clothes.legs_m : 0.0;
  const double folds = clothes.wrinkle_m;

  builder.begin_group(0.010 * h);
  builder.as(on_side(Part::kThighLeft, side), trousers || shorts ? kBottom : kSkin,
             trousers ? folds : 0.0);
  builder.cone(hip + 0.012 * h * thigh_front, knee, 0.052 * h * body.hip_girth + thigh_cloth,
               0.0345 * girth + 0.6 * shank_cloth);
  if (shorts) {
    builder.as(on_side(Part::kThighLeft, side), kBottom, folds);
    builder.cone(hip + 0.012 * h * thigh_front, hip + 0.75 * (knee - hip),
                 0.054 * h * body.hip_girth + thigh_cloth, 0.043 * girth + 1.5 * thigh_cloth);
  }
  builder.as(on_side(Part::kShankLeft, side), trousers ? kBottom : kSkin, trousers ? folds : 0.0);
  const Vector3d calf = knee + 0.30 * (ankle - knee) - 0.007 * h * shank_front;
  builder.cone(knee, calf, 0.0335 * girth + 0.6 * shank_cloth, 0.0335 * girth + 0.6 * shank_cloth);
  builder.cone(calf, ankle, 0.0345 * girth + 0.6 * shank_cloth, 0.0210 * girth + 1.1 * shank_cloth);

  builder.as(on_side(Part::kFootLeft, side), kShoes);
  const Matrix3d& foot = figure.skeleton.foot_R[side];
  const double sole = body.ankle_height_m;
  const auto at_foot = [&](double y, double z) {
    return Vector3d(ankle + foot * Vector3d(0, y * sole, z * body.foot_m));
  };
  builder.cone(at_foot(-0.50, -0.10), at_foot(-0.62, 0.62), 0.50 * sole, 0.36 * sole, foot.col(0),
               1.35);
  builder.cone(at_foot(-0.15, 0.05), at_foot(-0.55, 0.45), 0.48 * sole, 0.42 * sole, foot.col(0),
               1.15);
}

void add_skirt(const Figure& figure, SurfaceBuilder& builder) {
  const BodyShape& body = figure.body;
  const Clothes& clothes = body.clothes;
  const bool is_long = clothes.legwear == Legwear::kLongSkirt;
  if (!is_long && clothes.legwear != Legwear::kSkirt) return;
  const double h = figure.height();
  const double hips = 0.054 * h * body.hip_girth + clothes.legs_m;
  builder.begin_group(0.03 * h);
  builder.as(Part::kSkirt, kBottom, 1.5 * clothes.wrinkle_m);
  Vector3d hem = Vector3d::Zero();
  for (int side = 0; side < 2; ++side) {
    const Vector3d hip = figure.joint(Joint::kHipLeft, side);
    const Vector3d knee = figure.joint(Joint::kKneeLeft, side);
    const Vector3d ankle = figure.joint(Joint::kAnkleLeft, side);
    const double flare = 0.044 * h + 2.0 * clothes.legs_m;
    builder.cone(hip, knee, hips, flare);
    if (is_long) builder.cone(knee, knee + 0.7 * (ankle - knee), flare, flare);
    hem += 0.5 * (is_long && !figure.posture.seated ? knee + 0.6 * (ankle - knee)
                                                    : hip + 0.85 * (knee - hip));
  }
  builder.cone(figure.at_pelvis(0, 0, 0.01), hem, 1.1 * hips, 0.048 * h + 2.0 * clothes.legs_m,
               figure.skeleton.pelvis_R.col(0), 1.4);
}

}  // namespace

Surface make_body_surface(const BodyShape& body, const Posture& posture, const Skeleton& skeleton,
                          int person) {
  const Figure figure{body, posture, skeleton};
  SurfaceBuilder builder(materials_of(body));
  add_trunk(figure, builder);
  add_head(body, skeleton, builder);
  for (int side = 0; side < 2; ++side) add_arm(figure, side, builder);
  for (int side = 0; side < 2; ++side) add_leg(figure, side, builder);
  add_skirt(figure, builder);
  add_hem(figure, builder);
  add_backpack(figure, builder);
  return std::move(builder).build(person);
}

}  // namespace limbcast::simulate

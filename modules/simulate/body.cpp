#include "modules/simulate/body.hpp"

#include <algorithm>

namespace limbcast::simulate {
namespace {

Bgr from_rgb(double r, double g, double b) {
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
  };
  return {byte(b), byte(g), byte(r)};
}

/// From very light to very dark: the line through the tones of the Fitzpatrick scale.
Bgr draw_skin(Rng& rng) {
  const double dark = rng.uniform();
  const double blue = 178 - 148 * dark + rng.normal(0, 6);
  const double green = 200 - 152 * dark + rng.normal(0, 6);
  return from_rgb(235 - 165 * dark + rng.normal(0, 8), green, blue);
}

Bgr draw_cloth(Rng& rng) {
  const double kind = rng.uniform();
  if (kind < 0.25) {  // grey, black, white
    const double value = rng.uniform(20, 235);
    return from_rgb(value, value, value);
  }
  if (kind < 0.40) return draw_skin(rng);    // beige, brown: hard for a skin detector
  const double grey = rng.uniform(30, 200);  // few clothes have a pure colour
  const double purity = rng.uniform(0.2, 1.0);
  const auto channel = [&] { return grey + purity * (rng.uniform(15, 230) - grey); };
  const double red = channel();
  const double green = channel();
  return from_rgb(red, green, channel());
}

Bgr draw_hair_color(Rng& rng) {
  const double kind = rng.uniform();
  if (kind < 0.40) return from_rgb(25, 20, 18);
  if (kind < 0.70) return from_rgb(80 + rng.normal(0, 12), 55, 35);
  if (kind < 0.85) return from_rgb(190, 160, 105);
  return from_rgb(180, 180, 180);
}

Clothes draw_clothes(Rng& rng, bool female, double girth, const BodyParams& params) {
  Clothes clothes;
  const double sleeve = rng.uniform();
  clothes.sleeve = sleeve < 0.12 ? Sleeve::kNone : sleeve < 0.42 ? Sleeve::kShort : Sleeve::kLong;
  const double legs = rng.uniform();
  clothes.legwear = female && legs < 0.20   ? Legwear::kSkirt
                    : female && legs < 0.32 ? Legwear::kLongSkirt
                    : legs > 0.85           ? Legwear::kShorts
                                            : Legwear::kTrousers;
  const double hair = rng.uniform();
  if (female) {
    clothes.hair = hair < 0.25   ? Hair::kShort
                   : hair < 0.70 ? Hair::kLong
                   : hair < 0.85 ? Hair::kBun
                   : hair < 0.92 ? Hair::kHeadscarf
                                 : Hair::kAfro;
  } else {
    clothes.hair = hair < 0.18   ? Hair::kBald
                   : hair < 0.86 ? Hair::kShort
                   : hair < 0.93 ? Hair::kLong
                                 : Hair::kAfro;
    clothes.beard = rng.chance(0.2);
  }
  const double hat = rng.uniform();
  clothes.hat = hat < 0.82   ? Hat::kNone
                : hat < 0.90 ? Hat::kCap
                : hat < 0.96 ? Hat::kBeanie
                             : Hat::kBrim;
  if (clothes.hair == Hair::kHeadscarf) clothes.hat = Hat::kNone;
  clothes.jacket = clothes.sleeve == Sleeve::kLong && rng.chance(0.35);
  clothes.backpack = rng.chance(0.05);
  clothes.sleeve_m =
      girth * (clothes.jacket ? rng.uniform(0.008, 0.022) : rng.uniform(0.000, 0.009));
  clothes.torso_m =
      girth * (clothes.jacket ? rng.uniform(0.010, 0.030) : rng.uniform(0.000, 0.010));
  clothes.legs_m = girth * rng.uniform(0.001, 0.016);
  clothes.wrinkle_m = girth * rng.uniform(0.000, 0.006);
  clothes.skin = draw_skin(rng);
  clothes.top = draw_cloth(rng);
  clothes.top_second = draw_cloth(rng);
  clothes.bottom = draw_cloth(rng);
  clothes.hair_color = draw_hair_color(rng);
  clothes.shoes = draw_cloth(rng);
  clothes.hat_color = draw_cloth(rng);
  clothes.top_pattern = rng.chance(params.plain_share) ? 0 : 1 + rng.pick(3);
  return clothes;
}

/// Fractions of the stature; `child` runs from 0 (adult) to 1 (a child of 1.0 m).
void set_lengths(BodyShape& body, Rng& rng, double child) {
  const double height = body.stature_m;
  // Legs, trunk and head share the stature: what a child's head and trunk gain, its legs lose.
  const double legs = (1.0 - 0.09 * child) * rng.normal(1.0, 0.02);
  body.ankle_height_m = 0.048 * height;
  body.thigh_m = 0.241 * height * legs * rng.normal(1.0, 0.02);
  body.shank_m = 0.251 * height * legs * rng.normal(1.0, 0.02);
  body.head_scale = (1.0 + 0.42 * child) * rng.normal(1.0, 0.03);
  body.neck_head_m = 0.076 * height * (1.0 + 0.12 * child) * rng.normal(1.0, 0.03);
  const double crown = 0.048 * height * body.head_scale;
  const double trunk = height - crown - 0.97 * body.neck_head_m - body.ankle_height_m -
                       0.990 * (body.thigh_m + body.shank_m);
  body.pelvis_chest_m = 0.540 * trunk;
  body.chest_neck_m = 0.465 * trunk;
  const double arms = (1.0 - 0.05 * child) * rng.normal(1.0, 0.025);
  body.upper_arm_m = 0.152 * height * arms * rng.normal(1.0, 0.035);
  body.forearm_m = 0.147 * height * arms * rng.normal(1.0, 0.035) * (body.female ? 0.96 : 1.0);
  body.hand_m = 0.106 * height * rng.normal(1.0, 0.03);
  body.foot_m = 0.152 * height * rng.normal(1.0, 0.03);
  body.shoulder_half_m =
      height * (body.female ? 0.098 : 0.105) * (1.0 - 0.03 * child) * rng.normal(1.0, 0.04);
  body.shoulder_drop_m = 0.179 * trunk * rng.normal(1.0, 0.08);
  body.hip_half_m = 0.058 * height * rng.normal(1.0, 0.05);
  body.scapula_gain = rng.uniform(0.7, 1.3);
}

void set_girths(BodyShape& body, Rng& rng, double child) {
  const double build = rng.normal(1.0, 0.09);
  body.trunk_girth = build * rng.normal(1.0, 0.03) * (1.0 + 0.05 * child);
  body.limb_girth = build * rng.normal(1.0, 0.05) * (body.female ? 0.95 : 1.0);
  body.hip_girth = build * rng.normal(1.0, 0.03) * (body.female ? 1.05 : 0.98);
  body.waist_girth = build * rng.normal(1.0, 0.06) * (body.female ? 0.90 : 1.0);
  body.belly_m = std::max(0.0, rng.normal(0.0, 0.03)) * body.stature_m / 1.75;
  const bool adult = child < 0.3;
  body.breast_m = body.female && adult ? rng.uniform(0.045, 0.075) * body.stature_m / 1.65 : 0.0;
}

/// Thick, wide clothes over what was drawn.
void put_on_coat(Rng rng, double girth, Clothes& clothes) {
  clothes.sleeve = Sleeve::kLong;
  clothes.jacket = true;
  clothes.sleeve_m = girth * rng.uniform(0.015, 0.040);
  clothes.torso_m = girth * rng.uniform(0.025, 0.065);
  clothes.legs_m = girth * rng.uniform(0.005, 0.030);
  clothes.backpack = rng.chance(0.2);
}

}  // namespace

BodyShape draw_body(Rng& rng, const BodyParams& params) {
  BodyShape body;
  body.female = rng.chance(0.5);
  if (rng.chance(params.child_share)) {
    body.stature_m = rng.uniform(params.min_stature_m, 1.55);
  } else {
    body.stature_m =
        std::clamp(body.female ? rng.normal(1.64, 0.07) : rng.normal(1.77, 0.07), 1.45, 2.0);
  }
  const double child = std::clamp((1.55 - body.stature_m) / 0.55, 0.0, 1.0);
  set_lengths(body, rng, child);
  set_girths(body, rng, child);
  const double girth = body.stature_m / 1.75;
  body.clothes = draw_clothes(rng, body.female, girth, params);
  const Rng coat = rng.derive(1);
  if (coat.derive(1).chance(params.coat_share)) put_on_coat(coat, girth, body.clothes);
  body.name = child > 0.0 ? "child" : body.female ? "woman" : "man";
  return body;
}

}  // namespace limbcast::simulate

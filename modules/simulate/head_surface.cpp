#include "modules/simulate/body_surface.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Places on the head in fractions of a mean adult's stature: x own left, y up, z forward, from its
/// centre.
class Head {
 public:
  Head(const BodyShape& body, const Skeleton& skeleton)
      : size_(body.stature_m * body.head_scale),
        axes_(skeleton.head_R),
        center_(skeleton[Joint::kHead]) {}

  double size(double fraction) const { return size_ * fraction; }
  Vector3d at(double x, double y, double z) const {
    return center_ + axes_ * (size_ * Vector3d(x, y, z));
  }
  const Matrix3d& axes() const { return axes_; }
  void ellipsoid(SurfaceBuilder& builder, const Vector3d& place, const Vector3d& half_axes) const {
    builder.ellipsoid(at(place.x(), place.y(), place.z()), axes_, size_ * half_axes);
  }

 private:
  double size_;
  Matrix3d axes_;
  Vector3d center_;
};

void add_face(const Head& head, const Clothes& clothes, SurfaceBuilder& builder) {
  builder.as(Part::kFace, kFaceSkin);
  head.ellipsoid(builder, {0, 0.004, 0.000}, {0.0425, 0.046, 0.054});
  head.ellipsoid(builder, {0, -0.036, 0.016}, {0.032, 0.036, 0.034});
  builder.cone(head.at(0, -0.006, 0.050), head.at(0, -0.022, 0.058), head.size(0.004),
               head.size(0.0065));
  for (const double side : {1.0, -1.0}) {
    head.ellipsoid(builder, {0.043 * side, -0.010, -0.004}, {0.004, 0.017, 0.010});
    builder.ball(head.at(0.018 * side, 0.008, 0.046), head.size(0.008));  // the brow
  }
  if (clothes.beard) {
    builder.as(Part::kHair, kHairColor);
    head.ellipsoid(builder, {0, -0.050, 0.026}, {0.030, 0.026, 0.030});
  }
}

void add_hair(const Head& head, const Clothes& clothes, const Skeleton& skeleton,
              SurfaceBuilder& builder) {
  builder.as(Part::kHair, kHairColor);
  switch (clothes.hair) {
    case Hair::kBald:
      break;
    case Hair::kAfro:
      head.ellipsoid(builder, {0, 0.022, -0.022}, {0.066, 0.060, 0.062});
      break;
    case Hair::kHeadscarf:
      builder.as(Part::kHair, kHatColor);
      head.ellipsoid(builder, {0, 0.004, -0.006}, {0.052, 0.054, 0.058});
      builder.cone(head.at(0, -0.045, -0.004),
                   skeleton[Joint::kNeck] - 0.03 * head.size(1) * skeleton.chest_R.col(1),
                   head.size(0.042), head.size(0.058), head.axes().col(0), 1.25);
      break;
    case Hair::kLong:
      head.ellipsoid(builder, {0, 0.010, -0.010}, {0.049, 0.049, 0.054});
      builder.cone(
          head.at(0, 0.000, -0.026),
          skeleton[Joint::kNeck] + skeleton.chest_R * (head.size(1) * Vector3d(0, -0.045, -0.045)),
          head.size(0.036), head.size(0.026), head.axes().col(0), 1.5);
      break;
    case Hair::kBun:
      head.ellipsoid(builder, {0, 0.010, -0.008}, {0.047, 0.047, 0.053});
      builder.ball(head.at(0, 0.022, -0.066), head.size(0.022));
      break;
    case Hair::kShort:
      head.ellipsoid(builder, {0, 0.010, -0.008}, {0.047, 0.048, 0.054});
      break;
  }
}

void add_hat(const Head& head, const Clothes& clothes, SurfaceBuilder& builder) {
  builder.as(Part::kHair, kHatColor);
  if (clothes.hat == Hat::kNone) return;
  head.ellipsoid(builder, {0, 0.022, -0.002}, {0.050, 0.042, 0.060});
  if (clothes.hat == Hat::kCap) {
    head.ellipsoid(builder, {0, 0.018, 0.066}, {0.040, 0.008, 0.042});
  } else if (clothes.hat == Hat::kBrim) {
    head.ellipsoid(builder, {0, 0.018, 0.0}, {0.095, 0.010, 0.100});
  }
}

}  // namespace

void add_head(const BodyShape& body, const Skeleton& skeleton, SurfaceBuilder& builder) {
  const Head head(body, skeleton);
  builder.head(skeleton[Joint::kHead], skeleton.head_R);
  builder.begin_group(head.size(0.010));
  add_face(head, body.clothes, builder);
  add_hair(head, body.clothes, skeleton, builder);
  builder.begin_group(head.size(0.003));
  add_hat(head, body.clothes, builder);
}

void add_hand(const BodyShape& body, const Skeleton& skeleton, HandShape shape, int side,
              SurfaceBuilder& builder) {
  const double hand = body.hand_m;
  const Matrix3d& axes = skeleton.hand_R[side];
  const Vector3d wrist = skeleton[on_side(Joint::kWristLeft, Side(side))];
  // x: share of the hand's length towards the thumb, y: along the fingers, z: out of the back.
  const auto at = [&](double x, double y, double z) {
    return Vector3d(wrist + hand * (axes * Vector3d(x, y, z)));
  };
  const auto finger = [&](const Vector3d& from, const Vector3d& to) {
    builder.cone(from, to, 0.047 * hand, 0.038 * hand);
  };

  builder.as(on_side(Part::kHandLeft, side), kSkin);
  builder.cone(at(0, 0.05, 0), at(0, 0.42, 0), 0.075 * hand, 0.080 * hand, axes.col(0), 2.3);
  finger(at(0.14, 0.12, -0.02), at(0.27, 0.40, -0.06));
  finger(at(0.27, 0.40, -0.06), at(0.27, 0.55, -0.08));
  const double x_of_finger[4] = {0.155, 0.055, -0.045, -0.140};
  const double length[4] = {0.92, 1.0, 0.95, 0.80};
  for (int i = 0; i < 4; ++i) {
    const bool stretched = shape == HandShape::kOpen || (shape == HandShape::kPointing && i == 0);
    const Vector3d knuckle = at(x_of_finger[i], 0.48, 0.0);
    if (stretched) {
      finger(knuckle,
             at(1.12 * x_of_finger[i], shape == HandShape::kPointing ? 1.0 : length[i], -0.03) -
                 0.038 * hand * axes.col(1));
    } else {
      finger(knuckle, at(x_of_finger[i], 0.60, -0.15));
      finger(at(x_of_finger[i], 0.60, -0.15), at(x_of_finger[i], 0.42, -0.20));
    }
  }
}

}  // namespace limbcast::simulate

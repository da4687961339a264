#include "device/hand.h"

namespace hl {

namespace {

constexpr double kWishRate_1_s = 25;    // of the critically damped filter: a reach takes about 0.2 s
constexpr double kWishSpeed_m_s = 0.3;  // an unhurried hand
constexpr double kWishAcceleration_m_s2 = 8;

}  // namespace

void stepWish(HandState& hand, const Vec3& goal, double dt_s) {
  const Vec3 wanted = limited(0.5 * kWishRate_1_s * (goal - hand.wish), kWishSpeed_m_s);
  const Vec3 acceleration = limited(2 * kWishRate_1_s * (wanted - hand.wish_velocity), kWishAcceleration_m_s2);
  hand.wish_velocity += dt_s * acceleration;
  hand.wish += dt_s * hand.wish_velocity;
}

Vec3 padForce(const GripParameters& grip, const HandState& hand, const Vec3& tip, const Vec3& tip_velocity) {
  return grip.pad_stiffness_N_m * (hand.position - tip) + grip.pad_damping_Ns_m * (hand.velocity - tip_velocity);
}

void stepHand(const GripParameters& grip, HandState& hand, const Vec3& pad_force, double dt_s) {
  const Vec3 arm = grip.arm_stiffness_N_m * (hand.wish - hand.position) +
                   grip.arm_damping_Ns_m * (hand.wish_velocity - hand.velocity);
  hand.velocity += dt_s / grip.hand_mass_kg * (arm - pad_force);
  hand.position += dt_s * hand.velocity;
}

}  // namespace hl

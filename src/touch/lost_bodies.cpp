#include "touch/lost_bodies.h"

#include <algorithm>
#include <cmath>

#include "bodies/sleep.h"

namespace hl {

namespace {

bool isFinite(const BodyState& body) {
  return std::isfinite(body.centre.sum() + body.velocity.sum() + body.spin.sum() + body.turned.coeffs().sum());
}

bool isOutside(const Box& room, const Vec3& place) {
  return (place.array() < room.min.array()).any() || (place.array() > room.max.array()).any();
}

}  // namespace

LostBodies::LostBodies(const WorldState& starts)
    : starts_(starts.bodies), joint_starts_(starts.joints), lost_(starts.bodies.size()) {}

LostBodies::Kind LostBodies::findNotFinite(const MovingBodies& moving) {
  Kind worst = Kind::kNone;
  for (std::size_t i = 0; i < lost_.size(); ++i) {
    const BodyState& body = moving.state.bodies[i];
    lost_[i] = body.island == 0 && !isFinite(body) ? 1 : 0;
    if (lost_[i] != 0) worst = Kind::kNotFinite;
  }
  return worst;
}

LostBodies::Kind LostBodies::find(const MovingBodies& moving) {
  Kind worst = Kind::kNone;
  for (std::size_t i = 0; i < lost_.size(); ++i) {
    const BodyState& body = moving.state.bodies[i];
    Kind kind = Kind::kNone;
    if (isOutside(moving.bodies[i]->poses->room(), body.centre)) kind = Kind::kOutside;
    if (!isFinite(body)) kind = Kind::kNotFinite;
    lost_[i] = kind == Kind::kNone ? 0 : 1;
    worst = std::max(worst, kind);
  }
  return worst;
}

void LostBodies::addJoined(const MovingBodies& moving, std::span<const std::uint32_t> groups) {
  for (std::size_t i = 0; i < lost_.size(); ++i) {
    if (lost_[i] != 0) lost_[groups[i]] = 1;
  }
  for (std::size_t i = 0; i < lost_.size(); ++i) lost_[i] = lost_[groups[i]];
  for (std::size_t i = 0; i < joint_starts_.size(); ++i) {
    if (lost_[moving.world.numberOf(moving.world.joints[i].body_a)] != 0) moving.state.joints[i] = joint_starts_[i];
  }
}

std::size_t LostBodies::putBack(const MovingBodies& moving, std::span<const std::uint32_t> groups) {
  addJoined(moving, groups);
  std::size_t count = 0;
  for (std::size_t i = 0; i < lost_.size(); ++i) {
    if (lost_[i] == 0) continue;
    wake(moving.world, moving.state, moving.world.bodies[i].key);
    BodyState& body = moving.state.bodies[i];
    body = starts_[i];
    body.velocity.setZero();
    body.spin.setZero();
    moving.bodies[i]->poses->jumpTo(moving.bodies[i]->start);
    ++count;
  }
  return count;
}

}  // namespace hl

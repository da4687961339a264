#include "touch/hand_account.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace hl {

namespace {

// False: there is no room.
template <typename List>
bool addTo(List& list, const BodyImpulse& impulse) {
  for (BodyImpulse& one : list) {
    if (one.key != impulse.key) continue;
    one.impulse_N_s += impulse.impulse_N_s;
    one.point = impulse.point;
    return true;
  }
  return list.push(impulse);
}

// Returns what there is no room for, or what had to make room for it.
std::optional<BodyImpulse> owe(OwedImpulses& owed, const BodyImpulse& change) {
  if (addTo(owed, change)) return std::nullopt;
  const auto less = [](const BodyImpulse& a, const BodyImpulse& b) {
    return a.impulse_N_s.squaredNorm() < b.impulse_N_s.squaredNorm();
  };
  return std::exchange(*std::min_element(owed.begin(), owed.end(), less), change);
}

}  // namespace

Vec3 HandAccount::sum_N_s() const {
  Vec3 sum = Vec3::Zero();
  for (const BodyImpulse& one : owed_) sum += one.impulse_N_s;
  for (const BodyImpulse& one : drawn_) sum += one.impulse_N_s;
  return sum;
}

void HandAccount::beginStep() {
  given_.clear();
  paid_ = 0;
}

DrawnImpulses HandAccount::takeDrawn() {
  const DrawnImpulses drawn = drawn_;
  drawn_.clear();
  return drawn;
}

// In the order of owed_; what sleeps and is owed nothing got nothing.
void HandAccount::pay(const GivenImpulses& given) {
  given_ = given;
  paid_ = 0;
  for (BodyImpulse& owed : owed_) {
    if (paid_ == given_.size() || given_[paid_].key != owed.key) continue;
    owed.impulse_N_s -= given_[paid_].impulse_N_s;
    ++paid_;
  }
}

// Of each body: what the hand felt, less what the step has given. `of_fixed`: the same, of what is no body.
ChangedImpulses HandAccount::changesBy(const World& world, const ObjectForces& forces, double period_s,
                                       Vec3& of_fixed) const {
  ChangedImpulses changes;
  const auto add = [&](std::uint64_t key, const Vec3& point, const Vec3& impulse) {
    if (!world.has(key))
      of_fixed += impulse;
    else
      addTo(changes, {key, point, impulse});
  };
  for (const ObjectForce& force : forces) add(force.key, force.point, -period_s * force.force_N);
  for (std::size_t i = paid_; i < given_.size(); ++i) add(given_[i].key, given_[i].point, -given_[i].impulse_N_s);
  return changes;
}

// What a wall has given through the proxy to a body that is pinched against it is owed to nobody: it acts on both, one
// against the other.
ChangedImpulses HandAccount::settle(const World& world, const ObjectForces& forces, double period_s) {
  Vec3 of_fixed = Vec3::Zero();
  ChangedImpulses changes = changesBy(world, forces, period_s, of_fixed);
  ChangedImpulses at_once;
  for (BodyImpulse& change : changes) {
    const Vec3 with_wall = change.impulse_N_s + of_fixed;
    if (with_wall.squaredNorm() < change.impulse_N_s.squaredNorm()) {
      change.impulse_N_s = with_wall;
      of_fixed.setZero();
    }
    if (const std::optional<BodyImpulse> least = owe(owed_, change)) at_once.push(*least);
  }
  return at_once;
}

void HandAccount::draw(const World& world, const FieldForces& fields, double period_s) {
  drawn_.clear();
  for (const ObjectForce& force : fields.forces) {
    if (world.has(force.key)) drawn_.push({force.key, force.point, -period_s * force.force_N});
  }
}

void HandAccount::keepOwed(FunctionRef<bool(std::uint64_t key)> goes_on) {
  std::size_t kept = 0;
  for (const BodyImpulse& owed : owed_) {
    if (goes_on(owed.key)) owed_[kept++] = owed;
  }
  owed_.resize(kept);
}

void HandAccount::forgetOwed() {
  owed_.clear();
  beginStep();
}

void HandAccount::resume(const OwedImpulses& owed, const DrawnImpulses& drawn) {
  owed_ = owed;
  drawn_ = drawn;
}

}  // namespace hl

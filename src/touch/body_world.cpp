#include "touch/body_world.h"

namespace hl {

namespace {

std::vector<Pose> posesOf(const std::vector<std::shared_ptr<BodyPoses>>& drivers) {
  std::vector<Pose> poses;
  for (const std::shared_ptr<BodyPoses>& driver : drivers) poses.push_back(driver->to());
  return poses;
}

}  // namespace

BodyWorld::BodyWorld(std::shared_ptr<const World> world, std::vector<std::shared_ptr<BodyPoses>> poses)
    : stepper_(world), state_(startWorld(*world, posesOf(poses))), poses_(std::move(poses)) {}

void BodyWorld::step(std::int64_t now_ns, double period_s, const HandAtBodies& hand) {
  const std::int64_t before_ns = time_ns_;
  time_ns_ = now_ns;
  const bool first = !begun_;
  begun_ = true;
  if (first || now_ns <= before_ns) return;
  HandNode node;
  node.stretch = hand.stretch;
  node.spring_N_m = hand.spring_N_m;
  if (hand.spring_N_m > 0) node.contacts = hand.contacts;
  node.owed = owed_;
  const bool there = hand.spring_N_m > 0 || !owed_.empty();
  if (!(node.spring_N_m > 0)) node.spring_N_m = 1;
  report_ = stepper_.step(state_, period_s, std::span(&node, there ? 1 : 0), std::span(&given_, there ? 1 : 0));
  if (!there) given_.clear();
  paid_ = there ? owed_.size() : 0;
  owed_.clear();
  for (std::size_t i = 0; i < poses_.size(); ++i)
    poses_[i]->moveTo(poseOf(world().bodies[i], state_.bodies[i]), before_ns, now_ns);
}

// Of each object: what the hand felt, less what the step has given.
void BodyWorld::settle(const ObjectForces& forces, double period_s) {
  owed_.clear();
  const auto add = [&](std::uint64_t key, const Vec3& point, const Vec3& impulse) {
    for (BodyImpulse& one : owed_) {
      if (one.key != key) continue;
      one.impulse_N_s += impulse;
      return;
    }
    owed_.push({key, point, impulse});
  };
  for (const ObjectForce& force : forces) add(force.key, force.point, -period_s * force.force_N);
  for (std::size_t i = paid_; i < given_.size(); ++i) add(given_[i].key, given_[i].point, -given_[i].impulse_N_s);
}

Vec3 BodyWorld::owed_N_s() const {
  Vec3 sum = Vec3::Zero();
  for (const BodyImpulse& one : owed_) sum += one.impulse_N_s;
  return sum;
}

}  // namespace hl

#include "bodies/sleep.h"

#include <algorithm>

namespace hl {

namespace {

// Rounding of the sum of many periods.
constexpr double kPeriods_s = 1e-9;
// What overlaps is pushed apart before it sleeps. If it cannot come free it sleeps later, by this part of the time.
constexpr double kOverlapping = 0.1;
// What scenery may touch in a step, beyond where it goes.
constexpr double kNear_m = 1e-3;

void setIsland(const World& world, WorldState& state, std::uint64_t from, std::uint64_t to, ContactMemory& old_place,
               ContactMemory& new_place) {
  old_place.moveTo(new_place, [&](const RememberedContact& contact) {
    const std::size_t body = world.numberOf(contact.pair.a);
    return body != World::kNoBody && state.bodies[body].island == from;
  });
  for (BodyState& body : state.bodies) {
    if (body.island == from) body.island = to;
  }
}

void wakeIsland(const World& world, WorldState& state, std::uint64_t island) {
  for (BodyState& body : state.bodies) {
    if (body.island == island) body.still_s = 0;
  }
  setIsland(world, state, island, 0, state.asleep, state.memory);
}

double speedOf(const BodyState& body, double reach) { return body.velocity.norm() + body.spin.norm() * reach; }

void stop(const Body& body, BodyState& state, EnergyBook& energy) {
  energy.contact_J += kineticEnergy_J(body, state);
  state.velocity.setZero();
  state.spin.setZero();
  state.stopped_short = 0;
}

bool overlaps(const Row& row) { return row.gap < -kLeft_m; }

bool overlaps(const BodyProblem& problem, std::size_t body) {
  const auto number = static_cast<int>(body);
  return std::any_of(problem.rows.begin(), problem.rows.end(),
                     [&](const Row& row) { return overlaps(row) && (row.a == number || row.b == number); });
}

// True: some island may fall asleep.
bool countStill(const BodyProblem& problem, WorldState& state) {
  const bool any = std::any_of(problem.rows.begin(), problem.rows.end(), [](const Row& row) { return overlaps(row); });
  for (const std::size_t i : problem.awake) {
    BodyState& body = state.bodies[i];
    const double counted_s = (any && overlaps(problem, i) ? kOverlapping : 1) * problem.period_s;
    body.still_s = speedOf(body, problem.reachOf(i)) < kStill_m_s ? body.still_s + counted_s : 0;
  }
  for (const Row& row : problem.rows) {
    const bool of_hand = static_cast<std::size_t>(row.a) >= problem.bodies();
    if (of_hand && row.b != Row::kFixed && row.pressed > 0) state.bodies[static_cast<std::size_t>(row.b)].still_s = 0;
  }
  return std::any_of(problem.awake.begin(), problem.awake.end(),
                     [&](std::size_t i) { return state.bodies[i].still_s >= kFallsAsleep_s - kPeriods_s; });
}

}  // namespace

void wake(const World& world, WorldState& state, std::uint64_t key) {
  const std::size_t body = world.numberOf(key);
  if (body == World::kNoBody) return;
  const std::uint64_t island = state.bodies[body].island;
  if (island != 0) wakeIsland(world, state, island);
}

void wakeAll(WorldState& state) {
  for (BodyState& body : state.bodies) {
    if (body.island != 0) body.still_s = 0;
    body.island = 0;
  }
  state.asleep.moveTo(state.memory, [](const RememberedContact&) { return true; });
}

void wakeNearMoving(const World& world, WorldState& state, const StepTimes& times) {
  for (const std::uint32_t number : world.fixed->moving) {
    const Instance& instance = world.fixed->instances[number];
    const PoseSource& poses = instance.poses();
    if (times.begin_ns >= poses.restsFrom_ns()) continue;
    const Box reach = poses.reach(instance.shape->bounds);
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      const Vec3 size = Vec3::Constant(world.bodies[i].shape.reach + kNear_m);
      const Vec3& centre = state.bodies[i].centre;
      const bool near =
          ((centre + size).array() >= reach.min.array()).all() && ((centre - size).array() <= reach.max.array()).all();
      if (near && state.bodies[i].island != 0) wakeIsland(world, state, state.bodies[i].island);
    }
  }
}

bool sleepsWhole(const World& world, const WorldState& state) {
  const auto island = [&](std::uint64_t key) { return state.bodies[world.numberOf(key)].island; };
  return std::all_of(world.joints.begin(), world.joints.end(), [&](const Joint& joint) {
    return joint.body_b == 0 || island(joint.body_a) == island(joint.body_b);
  });
}

bool wakePushed(const BodyProblem& problem, WorldState& state) {
  bool any = false;
  for (const Row& row : problem.rows) {
    if (row.b == Row::kFixed || !(row.pressed > 0)) continue;
    const auto b = static_cast<std::size_t>(row.b);
    if (b >= problem.bodies() || state.bodies[b].island == 0) continue;
    wakeIsland(*problem.world, state, state.bodies[b].island);
    any = true;
  }
  return any;
}

// An island sleeps when all of it has been still for long enough: the first of its bodies, whose key is the lowest,
// gives it its name.
void fallAsleep(const BodyProblem& problem, Islands& islands, WorldState& state) {
  if (!countStill(problem, state)) return;
  islands.begin(problem.nodes.size());
  for (const Row& row : problem.rows) {
    if (row.b != Row::kFixed && row.pressed > 0) islands.join(row.a, row.b);
  }
  const std::vector<JointBlock>& joints = problem.joints.blocks;
  for (const std::uint32_t joint : problem.awake_joints) {
    if (joints[joint].b != Row::kFixed) islands.join(joints[joint].a, joints[joint].b);
  }
  const World& world = *problem.world;
  for (const std::size_t first : problem.awake) {
    if (islands.of(static_cast<int>(first)) != static_cast<int>(first)) continue;
    const auto belongs = [&](std::size_t i) { return islands.of(static_cast<int>(i)) == static_cast<int>(first); };
    const bool still = std::all_of(problem.awake.begin(), problem.awake.end(), [&](std::size_t i) {
      return !belongs(i) || state.bodies[i].still_s >= kFallsAsleep_s - kPeriods_s;
    });
    if (!still) continue;
    for (const std::size_t i : problem.awake) {
      if (!belongs(i)) continue;
      stop(world.bodies[i], state.bodies[i], state.energy);
      state.bodies[i].island = world.bodies[first].key;
    }
    for (const std::uint32_t joint : problem.awake_joints) {
      if (belongs(static_cast<std::size_t>(joints[joint].a))) state.joints[joint].velocity = 0;
    }
    const std::uint64_t name = world.bodies[first].key;
    setIsland(world, state, name, name, state.memory, state.asleep);
  }
}

}  // namespace hl

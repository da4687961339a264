#include "bodies/motion_bounds.h"

#include <algorithm>

namespace hl {

namespace {

// Larger crowds are faster and meet more, and so on. After so many times all bodies are one crowd.
constexpr int kTimes = 4;
// Of the way of a body in a step: the velocities found may be faster than the way that it then goes, and the scene
// beyond has a part in them. Without it four of 24 falls of a pile of 100 had an overlap of more than 50 um; with it
// none had.
constexpr double kAhead = 2;

}  // namespace

MotionBounds::MotionBounds(const BodyProblem& problem, const JointRows& joints)
    : problem_(problem),
      joints_(joints),
      near_(*problem.world),
      crowds_(problem.bodies()),
      speeds_(problem.bodies()),
      added_(problem.bodies()) {
  ways_.bodies.resize(problem.bodies());
  ways_.to_scene.resize(problem.bodies());
}

void MotionBounds::find(const WorldState& state, std::span<const HandNode> hands, double scenery_m_s) {
  ways_.scenery = problem_.period_s * scenery_m_s;
  std::fill(ways_.bodies.begin(), ways_.bodies.end(), 0);
  std::fill(added_.begin(), added_.end(), 0);
  near_.sort(state);
  joints_.findSpeeds(added_);
  crowds_.begin(problem_.bodies());
  for (const std::size_t i : problem_.awake) {
    const Node& node = problem_.nodes[i];
    speeds_[i] = std::max(scenery_m_s, node.velocity.norm() + node.spin.norm() * problem_.reachOf(i));
    crowds_.join(static_cast<int>(i), static_cast<int>(problem_.groups[i]));
  }
  for (const HandNode& hand : hands) addHand(hand);
  addCrowds(state);
}

bool MotionBounds::makeRoom(const WorldState& state, std::span<const Meeting> meetings) {
  bool made = false;
  for (const Meeting& meeting : meetings) {
    const double speed_m_s = apartSpeed_m_s(deepestOf(meeting.manifold), problem_.period_s);
    for (const int number : {meeting.a, meeting.b}) {
      if (number == Row::kFixed) continue;
      const auto i = static_cast<std::size_t>(number);
      if (ways_.bodies[i] == 0 || 2 * problem_.period_s * speed_m_s <= ways_.bodies[i]) continue;
      added_[i] = std::max(added_[i], speed_m_s);
      made = true;
    }
  }
  if (made) addCrowds(state);
  return made;
}

// Bodies that it may meet in this step are no faster after it has stopped at them. A hand that is far beyond a surface
// counts by what it does to bodies. What it stands between is one crowd.
void MotionBounds::addHand(const HandNode& hand) {
  const double period_s = problem_.period_s;
  const double reach = hand.stretch.norm(), impulse_N_s = hand.spring_N_m * period_s * reach;
  const auto is_near = [&](std::size_t i) {
    const double near = problem_.reachOf(i) + hand.radius_m + 2 * reach + 2 * period_s * speeds_[i];
    return (problem_.nodes[i].centre - hand.proxy).squaredNorm() <= near * near;
  };
  double fastest = 0;
  for (const std::size_t i : problem_.awake) {
    if (!is_near(i)) continue;
    const Node& node = problem_.nodes[i];
    const double square = problem_.reachOf(i) * problem_.reachOf(i);
    fastest = std::max(fastest, impulse_N_s * (node.inverse_mass + square * node.inverse_inertia.trace()));
  }
  fastest = std::min(fastest, reach / period_s);
  int first = -1;
  for (const std::size_t i : problem_.awake) {
    if (!is_near(i)) continue;
    speeds_[i] = std::max(speeds_[i], fastest);
    if (first < 0) first = static_cast<int>(i);
    crowds_.join(first, static_cast<int>(i));
  }
}

// Each becomes as fast as the fastest of its crowd.
void MotionBounds::spread() {
  for (const std::size_t i : problem_.awake) {
    const auto crowd = static_cast<std::size_t>(crowds_.of(static_cast<int>(i)));
    speeds_[crowd] = std::max(speeds_[crowd], speeds_[i]);
    added_[crowd] = std::max(added_[crowd], added_[i]);
  }
  for (const std::size_t i : problem_.awake) {
    const auto crowd = static_cast<std::size_t>(crowds_.of(static_cast<int>(i)));
    speeds_[i] = speeds_[crowd];
    added_[i] = added_[crowd];
    ways_.bodies[i] = 2 * problem_.period_s * (speeds_[i] + added_[i]) + kTouching_m;
    ways_.to_scene[i] = ways_.bodies[i] + kAhead * problem_.period_s * speeds_[i];
  }
}

void MotionBounds::addCrowds(const WorldState& state) {
  for (int time = 0; time < kTimes; ++time) {
    spread();
    bool joined = false;
    near_.forEachPair(state, ways_.bodies, [&](std::uint32_t one, std::uint32_t other) {
      const int a = static_cast<int>(one), b = static_cast<int>(other);
      if (state.bodies[other].island != 0 || crowds_.of(a) == crowds_.of(b)) return;
      crowds_.join(a, b);
      joined = true;
    });
    if (!joined) return;
  }
  for (const std::size_t i : problem_.awake)
    crowds_.join(static_cast<int>(problem_.awake.front()), static_cast<int>(i));
  spread();
}

}  // namespace hl

#include "bodies/motion_plan.h"

#include <algorithm>
#include <limits>

namespace hl {

namespace {

// What is left of an overlap, as it is but a part, is the next step's; joints are held to the last digits.
constexpr int kSweepsApart = 10;
// Of all the sweeps that put joints right.
constexpr int kWorkApart = StepWork::kMax / 2;
// How often joints are put right.
constexpr int kCorrections = 4;
// Of what is off, nothing moves farther than this: a mechanism that is stretched out would be flung aside.
constexpr double kMaxMoved = 10;
// How often all pairs are looked at; each time what would pass goes a quarter of its part. Then it stays where it is,
// as that place was clear.
constexpr int kLooks = 8;
constexpr double kShorter = 0.25;
constexpr int kNeverClear = -1;
constexpr double kAnyGap = std::numeric_limits<double>::infinity();

}  // namespace

MotionPlan::MotionPlan(const BodyProblem& problem, const JointRows& joints, const MotionBounds& bounds)
    : problem_(problem),
      joints_(joints),
      bounds_(bounds),
      ends_(*problem.world),
      joints_apart_(problem.joints),
      sweeps_(problem.nodes.capacity()) {
  plan_.ways.resize(problem.bodies());
  plan_.turns.resize(problem.bodies());
  plan_.parts.resize(problem.bodies());
  apart_.reserve(problem.nodes.capacity());
  overlaps_.reserve(problem.rows.capacity());
  last_plan_ = plan_;
  kept_ = plan_.parts;
  changed_.resize(problem.bodies());
  clear_.reserve(problem.meetings.room());
  stops_.reserve(problem.meetings.room());
}

void MotionPlan::make(const WorldState& state, bool converged) {
  goWithVelocities();
  correct(state);
  limit();
  stopShort(state, converged && !pressesDeeper());
}

// Without contact the path of a fall is a parabola: half of what gravity adds to the velocity has not acted on the way.
void MotionPlan::goWithVelocities() {
  const double period_s = problem_.period_s;
  for (const std::size_t i : problem_.awake) {
    plan_.ways[i] = period_s * problem_.nodes[i].velocity - period_s * period_s / 2 * problem_.world->gravity_m_s2;
    plan_.turns[i] = problem_.nodes[i].spin;
    plan_.parts[i] = 1;
  }
  for (const std::uint32_t joint : problem_.awake_joints) {
    for (const int number : {problem_.joints.blocks[joint].a, problem_.joints.blocks[joint].b}) {
      if (number == Row::kFixed) continue;
      const auto i = static_cast<std::size_t>(number);
      plan_.ways[i] = period_s * problem_.nodes[i].velocity;
    }
  }
  for (const Row& row : problem_.rows) {
    if (!(row.pressed > 0)) continue;
    for (const int number : {row.a, row.b}) {
      const auto i = static_cast<std::size_t>(number);
      if (number != Row::kFixed && i < problem_.bodies()) plan_.ways[i] = period_s * problem_.nodes[i].velocity;
    }
  }
}

// Overlaps, and what joints are off, are removed by velocities of their own, which act for this step alone and leave
// no kinetic energy.
void MotionPlan::findOverlaps() {
  overlaps_.clear();
  apart_.clear();
  for (const Row& row : problem_.rows) {
    if (row.gap >= -kTouching_m) continue;
    overlaps_.push_back(row);
    overlaps_.back().friction = 0;
    overlaps_.back().dragged.setZero();
    overlaps_.back().carried.setZero();
    overlaps_.back().least_velocity = apartSpeed_m_s(-row.gap, problem_.period_s);
  }
}

// Whether what was pushed apart is pressed into something else.
bool MotionPlan::pressesDeeper() const {
  if (apart_.empty()) return false;
  return std::any_of(problem_.rows.begin(), problem_.rows.end(), [&](const Row& row) {
    const double nearer = -problem_.period_s * row.normal.dot(relativeVelocity(row, apart_));
    return nearer > std::max(row.gap, 0.0) + kLeft_m;
  });
}

// What joints are off at the end of the plan is not linear in what moves them: it takes a few rounds, in which what
// overlaps stays apart. A round that makes it worse is taken back.
void MotionPlan::correct(const WorldState& state) {
  findOverlaps();
  work_.begin(kWorkApart);
  double last_off = 0;
  for (int round = 0; round < kCorrections; ++round) {
    const double off = joints_.straighten(state, plan_, joints_apart_);
    if (off == 0 && (round > 0 || overlaps_.empty())) return;
    if (round > 0 && off > last_off) {
      plan_ = last_plan_;
      return;
    }
    last_off = off;
    last_plan_ = plan_;
    pushApart();
    goApart(off > 0 ? kMaxMoved * off : 0);
    for (Row& row : overlaps_) row.least_velocity = 0;
  }
}

// Without joints each body counts as one of 1 kg: no momentum has to stay, and a heavy one that lies on a light one
// does not press it into what is beneath.
void MotionPlan::pushApart() {
  for (Row& row : overlaps_) row.pressed = 0;
  apart_ = problem_.nodes;
  for (Node& node : apart_) node.velocity = node.spin = Vec3::Zero();
  if (problem_.awake_joints.empty()) {
    for (const std::size_t i : problem_.awake) {
      apart_[i].inverse_inertia *= problem_.world->bodies[i].mass.mass_kg;
      apart_[i].inverse_mass = 1;
    }
  }
  for (Row& row : overlaps_) prepareRow(row, apart_);
  const int of_sweep = static_cast<int>(overlaps_.size() + joints_apart_.work(problem_.awake_joints)) + 1;
  RowSolverLimits limits;
  limits.sweeps = problem_.awake_joints.empty() ? kSweepsApart : work_.sweepsOf(of_sweep, kSweepsApart);
  const RowSolver::Report report =
      sweeps_.solve(overlaps_, {&joints_apart_, problem_.awake_joints}, apart_, problem_.period_s, limits);
  work_.spend(report.sweeps * of_sweep);
}

// All by one part, so that nothing of a body moves farther than `most` (m); 0: as far as it may.
void MotionPlan::goApart(double most) {
  double farthest = 0;
  for (const std::size_t i : problem_.awake)
    farthest = std::max(farthest, apart_[i].velocity.norm() + apart_[i].spin.norm() * problem_.reachOf(i));
  farthest *= problem_.period_s;
  const double part = most > 0 && farthest > most ? most / farthest : 1;
  for (const std::size_t i : problem_.awake) {
    plan_.ways[i] += part * problem_.period_s * apart_[i].velocity;
    plan_.turns[i] += part * apart_[i].spin;
  }
}

// So do all bodies that joints connect with it, or the joints would be torn apart.
void MotionPlan::goPart(std::size_t body, double part) {
  const std::uint32_t group = problem_.groups[body];
  ++changes_;
  for (const std::size_t i : problem_.awake) {
    if (problem_.groups[i] != group) continue;
    plan_.parts[i] *= part;
    changed_[i] = changes_;
  }
}

void MotionPlan::goPart(const Meeting& meeting, double part) {
  const auto a = static_cast<std::size_t>(meeting.a);
  goPart(a, part);
  if (meeting.b == Row::kFixed) return;
  const auto b = static_cast<std::size_t>(meeting.b);
  if (problem_.groups[a] != problem_.groups[b]) goPart(b, part);
}

// m, of the whole way of any of its points.
double MotionPlan::farthestOf(std::size_t body) const {
  return plan_.ways[body].norm() + problem_.period_s * plan_.turns[body].norm() * problem_.reachOf(body);
}

void MotionPlan::limit() {
  for (const std::size_t i : problem_.awake) {
    const double way = farthestOf(i);
    const double most = bounds_.ways().bodies[i];
    if (plan_.parts[i] * way > most) goPart(i, most / way / plan_.parts[i]);
  }
}

// m: how far the pair would end inside each other or, of what is fast or has passed, on another side. No more than they
// then overlap along the normal of the begin: where that is at most `enough`, it stands for both.
double MotionPlan::depthAtEnd(const WorldState& state, const Meeting& meeting, double enough) {
  return depthOf(PairAtEnd(problem_, state, meeting, plan_, ends_), meeting, enough);
}

double MotionPlan::depthOf(const PairAtEnd& pair, const Meeting& meeting, double enough) const {
  const double along = -pair.along.gap;
  if (along <= enough) return std::max(along, 0.0);
  Manifold end;
  const double overlap = findManifold(pair.a, pair.b, 0, end) ? deepestOf(end) : 0;
  const bool may_have_passed = pair.along.hasPassed() || (paceOf(problem_, meeting).fast && !turnsApart(pair, meeting));
  return may_have_passed ? std::max(overlap, along) : overlap;
}

// Of a pair whose middles are in order: whether it can only have grazed a corner on its way, as a plane parts it at the
// end that has turned a little from that of the begin. While the plane turns from n0 to n1 and the shapes go straight,
// n(t) . (p_a - p_b) is at least what it is at the ends but for 1/4 |n1 - n0| times the way of one past the other.
bool MotionPlan::turnsApart(const PairAtEnd& pair, const Meeting& meeting) const {
  Manifold end;
  if (!findManifold(pair.a, pair.b, kAnyGap, end) || pairAlong(pair.a, pair.b, end.normal).hasPassed()) return false;
  const double grazed = 0.25 * (end.normal - meeting.manifold.normal).norm() * wayPastEachOther(problem_, meeting);
  return grazed <= kLeft * (pair.a.shape->thin + pair.b.shape->thin);
}

// Farther than it began.
bool MotionPlan::passes(const WorldState& state, const Meeting& meeting) {
  const PairAtEnd pair(problem_, state, meeting, plan_, ends_);
  if (isKeptApart(problem_, meeting, pair)) return false;
  const double most =
      std::max(leftOf(pair.a, pair.b) + roughnessOf(pair.a, pair.b), deepestOf(meeting.manifold) + kTouching_m);
  return depthOf(pair, meeting, most) > most;
}

// Scenery that its client moves toward the body does not wait for it.
bool MotionPlan::comesToward(const Meeting& meeting) const {
  if (meeting.b != Row::kFixed) return false;
  const Vec3& centre = problem_.nodes[static_cast<std::size_t>(meeting.a)].centre;
  return problem_.sceneryVelocityAt(meeting.primitive, centre).dot(meeting.manifold.normal) > 0;
}

void MotionPlan::shorten(const WorldState& state, const Meeting& meeting) {
  constexpr int kTimes = 4;
  const double depth = comesToward(meeting) ? depthAtEnd(state, meeting, 0) : 0;
  kept_ = plan_.parts;
  for (int time = 0; time < kTimes; ++time) {
    goPart(meeting, kShorter);
    if (!passes(state, meeting)) return;
  }
  goPart(meeting, 0);
  if (depth > 0 && depthAtEnd(state, meeting, depth) > depth) plan_.parts = kept_;  // it is in the body all the more
}

void MotionPlan::beginLooks() {
  changes_ = 0;
  std::fill(changed_.begin(), changed_.end(), 0);
  clear_.assign(problem_.meetings.all().size(), kNeverClear);
}

// A look found so, and neither of the two has got another part since.
bool MotionPlan::isClear(std::size_t number) const {
  const Meeting& meeting = problem_.meetings.all()[number];
  const auto unchanged = [&](int body) {
    return body == Row::kFixed || changed_[static_cast<std::size_t>(body)] <= clear_[number];
  };
  return clear_[number] != kNeverClear && unchanged(meeting.a) && unchanged(meeting.b);
}

void MotionPlan::stopShort(const WorldState& state, bool converged) {
  beginLooks();
  stops_.clear();
  for (int look = 0; look < kLooks; ++look) {
    bool shortened = false;
    for (std::size_t i = 0; i < clear_.size(); ++i) {
      const Meeting& meeting = problem_.meetings.all()[i];
      const Pace pace = converged && look == 0 ? paceOf(problem_, meeting) : Pace{true, true};
      if (isClear(i) || (!pace.fast && !pace.turns)) continue;
      if (!passes(state, meeting)) {
        clear_[i] = changes_;
        continue;
      }
      shortened = true;
      if (stops_.size() < stops_.capacity()) stops_.push_back({meeting.a, meeting.b});
      if (look + 1 < kLooks || comesToward(meeting)) {
        shorten(state, meeting);
      } else {
        goPart(meeting, 0);
      }
    }
    if (!shortened) return;
  }
}

}  // namespace hl

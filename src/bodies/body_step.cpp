#include "bodies/body_step.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bodies/free_motion.h"
#include "bodies/row_solver.h"

namespace hl {

namespace {

// m; a contact with no more of a gap bears load, and no less of an overlap is pushed apart. At 1000 N/m a nanometre is
// a micronewton; rounding at a metre is a millionth of it.
constexpr double kTouching_m = 1e-9;
// m; a contact that bore load keeps its row up to this gap, so that the rows of what rests are the same in each step.
constexpr double kHeld_m = 1e-6;
// Of the size of a body, and rad: contacts as near as that are one.
constexpr double kTwin = 1e-3;
// Of the size of a body: a contact as near as that to one of the last step goes on from its impulse.
constexpr double kSamePlace = 0.05;
// Of an overlap this part is removed in a step.
constexpr double kPushedApart = 0.2;
// m/s; slower impacts do not bounce, so that what rests comes to rest (dynamics of Newton's restitution).
constexpr double kBounces_m_s = 0.02;
// How often rows are added for what the motion found would pass; the last time without a look at the end pose.
constexpr int kRounds = 8;
// Where bodies move by more than this part of their size in a step, an end pose does not show what they passed.
constexpr double kFast = 0.1;
// rad; a body that turns by less in a step goes straight: what the turn bends is 5e-7 of its size.
constexpr double kStraight_rad = 1e-3;
// Updates of a row in one solve, so that the work of a step is bounded.
constexpr int kMostUpdates = 20'000;
constexpr int kMostSweeps = 1000, kLeastSweeps = 20;

RowSolverLimits limitsFor(std::size_t rows) {
  const int sweeps = kMostUpdates / static_cast<int>(rows + 1);
  return {std::clamp(sweeps, kLeastSweeps, kMostSweeps), 1e-11};
}

double meanOf(double x, double y) { return std::sqrt(x * y); }

BodySurface between(const BodySurface& x, const BodySurface& y) {
  return {meanOf(x.static_friction, y.static_friction), meanOf(x.dynamic_friction, y.dynamic_friction),
          meanOf(x.restitution, y.restitution)};
}

double deepestOf(const Manifold& manifold) {
  double deepest = 0;
  for (const ManifoldPoint& point : manifold.points) deepest = std::max(deepest, -point.gap);
  return deepest;
}

}  // namespace

BodyStepper::BodyStepper(std::shared_ptr<const World> world)
    : world_(std::move(world)), placed_(*world_), meetings_(*world_) {
  const std::size_t bodies = world_->bodies.size();
  nodes_.reserve(bodies + kMostHands);
  before_.reserve(bodies + kMostHands);
  apart_.reserve(bodies + kMostHands);
  turned_.resize(bodies);
  ways_.resize(bodies);
  turns_.resize(bodies);
  rows_.reserve(mostRows(*world_));
  overlaps_.reserve(rows_.capacity());
  touching_.reserve(rows_.capacity() / 2);
}

int BodyStepper::numberOf(std::uint64_t key) const {
  const auto at = std::lower_bound(world_->bodies.begin(), world_->bodies.end(), key,
                                   [](const Body& body, std::uint64_t k) { return body.key < k; });
  const bool found = at != world_->bodies.end() && at->key == key;
  return found ? static_cast<int>(at - world_->bodies.begin()) : Row::kFixed;
}

void BodyStepper::begin(const WorldState& state, double period_s, std::span<const HandNode> hands,
                        std::span<GivenImpulses> given) {
  nodes_.clear();
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const BodyState& body = state.bodies[i];
    nodes_.push_back({body.velocity, body.spin, 1 / world_->bodies[i].mass.mass_kg,
                      inverseInertia(world_->bodies[i], body), body.centre});
  }
  for (std::size_t i = 0; i < state.bodies.size(); ++i) turned_[i] = state.bodies[i].turned.toRotationMatrix();
  before_ = nodes_;
  for (std::size_t i = 0; i < state.bodies.size(); ++i) nodes_[i].velocity += period_s * world_->gravity_m_s2;
  for (std::size_t hand = 0; hand < hands.size(); ++hand) {
    const HandNode& one = hands[hand];
    given[hand].clear();
    for (const BodyImpulse& owed : one.owed) {
      const int number = numberOf(owed.key);
      if (number == Row::kFixed) continue;
      Node& node = nodes_[static_cast<std::size_t>(number)];
      node.push(owed.impulse_N_s, owed.point - node.centre);
      given[hand].push(owed);
    }
    Node node;
    node.velocity = -one.stretch / period_s;
    node.inverse_mass = 1 / (one.spring_N_m * period_s * period_s);
    nodes_.push_back(node);
    before_.push_back(node);
  }
}

void BodyStepper::addHandRows(const HandNode& hand, std::size_t number, ContactMemory& memory) {
  for (const HandContact& contact : hand.contacts) {
    Row row;
    row.a = static_cast<int>(world_->bodies.size() + number);
    row.b = contact.key == 0 ? Row::kFixed : numberOf(contact.key);
    row.pair = {~std::uint64_t{number}, contact.key};
    row.normal = contact.normal;
    if (row.b != Row::kFixed) row.arm_b = contact.point - nodes_[static_cast<std::size_t>(row.b)].centre;
    row.static_friction = contact.static_friction;
    row.dynamic_friction = contact.dynamic_friction;
    recall(row, memory);
    row.slipping = contact.slipping;
    row.friction = row.slipping ? row.dynamic_friction : row.static_friction;
    rows_.push_back(row);
  }
}

// Nothing moves farther in this step: twice the speed of the fastest, for one that is hit, and two that meet.
double BodyStepper::marginOf(double period_s) const {
  double fastest = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double reach = i < world_->bodies.size() ? world_->bodies[i].shape.reach : 0;
    fastest = std::max(fastest, nodes_[i].velocity.norm() + nodes_[i].spin.norm() * reach);
  }
  return 4 * period_s * fastest + kTouching_m;
}

Row BodyStepper::rowOf(const Meeting& meeting, std::size_t number) const {
  const Body& body = world_->bodies[static_cast<std::size_t>(meeting.a)];
  const bool fixed = meeting.b == Row::kFixed;
  const BodySurface surface = between(
      body.surface, fixed ? world_->fixed_surface : world_->bodies[static_cast<std::size_t>(meeting.b)].surface);
  const ManifoldPoint& point = meeting.manifold.points[number];
  Row row;
  row.pair = pairOf(meeting);
  row.a = meeting.a;
  row.b = meeting.b;
  row.normal = meeting.manifold.normal;
  row.arm_a = point.point - nodes_[static_cast<std::size_t>(row.a)].centre;
  if (!fixed) row.arm_b = point.point - nodes_[static_cast<std::size_t>(row.b)].centre;
  row.gap = point.gap;
  row.restitution = surface.restitution;
  row.static_friction = surface.static_friction;
  row.dynamic_friction = surface.dynamic_friction;
  row.friction = row.static_friction;
  return row;
}

void BodyStepper::addRow(ContactMemory& memory, Meeting& meeting, std::size_t number) {
  if (rows_.size() == rows_.capacity()) return;
  meeting.used |= 1u << number;
  Row row = rowOf(meeting, number);
  recall(row, memory);
  row.approach = row.normal.dot(relativeVelocity(row, nodes_));
  rows_.push_back(row);
}

ContactPair BodyStepper::pairOf(const Meeting& meeting) const {
  const std::uint64_t a = world_->bodies[static_cast<std::size_t>(meeting.a)].key;
  return {a, meeting.b == Row::kFixed ? 0 : world_->bodies[static_cast<std::size_t>(meeting.b)].key};
}

Vec3 BodyStepper::placeOf(const Row& row) const {
  const auto a = static_cast<std::size_t>(row.a);
  return a < turned_.size() ? Vec3(turned_[a].transpose() * row.arm_a) : row.normal;
}

// Of a hand, whose contacts all are at its proxy, the normal takes the place of the place.
void BodyStepper::recall(Row& row, ContactMemory& memory) const {
  const auto a = static_cast<std::size_t>(row.a);
  const double near = a < turned_.size() ? kSamePlace * world_->bodies[a].shape.reach : kSamePlace;
  RememberedContact* const last = memory.find(row.pair, placeOf(row), near);
  if (last == nullptr) return;
  last->taken = true;
  row.pressed = last->pressed;
  row.dragged = last->dragged;
  row.slipping = last->slipped;
  row.friction = row.slipping ? row.dynamic_friction : row.static_friction;
}

// What bore load in the last step, and has not come off since. Of the contacts near the place where one bore, the
// nearest goes on with it.
void BodyStepper::addBearing(ContactMemory& memory) {
  std::vector<Meeting>& meetings = meetings_.all();
  touching_.clear();
  for (std::uint32_t i = 0; i < meetings.size(); ++i) {
    const auto& points = meetings[i].manifold.points;
    for (std::uint32_t point = 0; point < points.size() && touching_.size() < touching_.capacity(); ++point) {
      if (points[point].gap <= kHeld_m) touching_.push_back({i, point, points[point].gap});
    }
  }
  std::sort(touching_.begin(), touching_.end(), [&](const Touching& x, const Touching& y) {
    const Meeting &of_x = meetings[x.meeting], &of_y = meetings[y.meeting];
    return std::tie(of_x.a, of_x.b, x.gap, x.meeting, x.point) < std::tie(of_y.a, of_y.b, y.gap, y.meeting, y.point);
  });
  for (const Touching& one : touching_) {
    if (hasTwin(meetings[one.meeting], one.point)) continue;
    addRow(memory, meetings[one.meeting], one.point);
    if (rows_.back().pressed > 0) continue;
    rows_.pop_back();
    meetings[one.meeting].used &= ~(1u << one.point);
  }
}

// A row that bears at the same place in the same direction: the triangle on the other side of an edge.
bool BodyStepper::hasTwin(const Meeting& meeting, std::size_t number) const {
  const ManifoldPoint& point = meeting.manifold.points[number];
  const Vec3 arm = point.point - nodes_[static_cast<std::size_t>(meeting.a)].centre;
  const double near = kTwin * world_->bodies[static_cast<std::size_t>(meeting.a)].shape.reach;
  return std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) {
    return row.a == meeting.a && row.b == meeting.b && (row.arm_a - arm).squaredNorm() < near * near &&
           (row.normal - meeting.manifold.normal).squaredNorm() < kTwin * kTwin;
  });
}

// The manifold where the bodies would be at the end of the step; false: they would be apart.
bool BodyStepper::meetsAtEnd(const WorldState& state, const Meeting& meeting, double period_s, Manifold& end) const {
  PlacedRoom room_a, room_b;
  const auto placedAtEnd = [&](int number, PlacedRoom& room) {
    const auto i = static_cast<std::size_t>(number);
    BodyState moved = state.bodies[i];
    moved.spin = nodes_[i].spin;
    moveFreely(world_->bodies[i], moved, period_s * nodes_[i].velocity, period_s);
    return placed(world_->bodies[i], moved, room);
  };
  const PlacedConvex a = placedAtEnd(meeting.a, room_a);
  const SceneAt* const scene = meetings_.scene();
  const PlacedConvex b = meeting.b == Row::kFixed ? placed(scene->primitive(meeting.primitive),
                                                           scene->instance(meeting.primitive).poses().to(), room_b)
                                                  : placedAtEnd(meeting.b, room_b);
  return findManifold(a, b, 0, end);
}

bool BodyStepper::goesThrough(const Meeting& meeting, std::size_t number, double period_s) const {
  if (meeting.uses(number)) return false;
  const ManifoldPoint& point = meeting.manifold.points[number];
  const Node& a = nodes_[static_cast<std::size_t>(meeting.a)];
  Vec3 velocity = a.velocityAt(point.point - a.centre);
  if (meeting.b != Row::kFixed) {
    const Node& b = nodes_[static_cast<std::size_t>(meeting.b)];
    velocity -= b.velocityAt(point.point - b.centre);
  }
  return point.gap + period_s * meeting.manifold.normal.dot(velocity) < -kTouching_m;
}

BodyStepper::Pace BodyStepper::paceOf(const Meeting& meeting, double period_s) const {
  Pace pace;
  double size = 0, way = 0;
  for (const int number : {meeting.a, meeting.b}) {
    if (number == Row::kFixed) continue;
    const auto i = static_cast<std::size_t>(number);
    const double reach = world_->bodies[i].shape.reach, turn = period_s * nodes_[i].spin.norm();
    size = size == 0 ? reach : std::min(size, reach);
    way += period_s * nodes_[i].velocity.norm() + turn * reach;
    pace.turns |= turn > kStraight_rad && world_->bodies[i].shape.vertices.size() > 1;
  }
  pace.fast = way > kFast * size;
  return pace;
}

// Rows for the points that would be passed through. What turns or is fast is looked at where it would end, once it has
// rows: they were made for the begin.
bool BodyStepper::addPassed(WorldState& state, double period_s) {
  const std::size_t before = rows_.size();
  for (Meeting& meeting : meetings_.all()) {
    bool predicted = false;
    for (std::size_t point = 0; point < meeting.manifold.points.size(); ++point)
      predicted |= goesThrough(meeting, point, period_s);
    const Pace pace = paceOf(meeting, period_s);
    Manifold end;
    if (predicted && (pace.fast || (meetsAtEnd(state, meeting, period_s, end) && deepestOf(end) > kTouching_m))) {
      for (std::size_t point = 0; point < meeting.manifold.points.size(); ++point) {
        if (goesThrough(meeting, point, period_s) && !hasTwin(meeting, point)) addRow(state.memory, meeting, point);
      }
    } else if (meeting.used != 0 && (pace.fast || pace.turns) && meetsAtEnd(state, meeting, period_s, end) &&
               deepestOf(end) > kHeld_m) {
      addRowsOfEnd(meeting, end, period_s);
    }
  }
  for (std::size_t i = before; i < rows_.size(); ++i) prepareRow(rows_[i], nodes_);
  return rows_.size() > before;
}

// The same contact, as it would be at the end: its gap there is what the motion found makes of the row's gap.
void BodyStepper::addRowsOfEnd(const Meeting& meeting, const Manifold& end, double period_s) {
  Meeting at_end = meeting;
  at_end.manifold = end;
  const auto wayOf = [&](int number) {
    return number == Row::kFixed ? Vec3(Vec3::Zero())
                                 : Vec3(period_s * nodes_[static_cast<std::size_t>(number)].velocity);
  };
  for (std::size_t point = 0; point < end.points.size(); ++point) {
    if (rows_.size() == rows_.capacity()) return;
    Row row = rowOf(at_end, point);
    row.arm_a -= wayOf(row.a);
    if (row.b != Row::kFixed) row.arm_b -= wayOf(row.b);
    row.approach = row.normal.dot(relativeVelocity(row, nodes_));
    row.gap = end.points[point].gap - period_s * row.approach;
    rows_.push_back(row);
  }
}

// Without contact the path of a fall is a parabola: half of what gravity adds to the velocity has not acted on the way.
void BodyStepper::planMotion(double period_s, double margin) {
  std::vector<bool>::size_type bodies = world_->bodies.size();
  for (std::size_t i = 0; i < bodies; ++i) {
    ways_[i] = period_s * nodes_[i].velocity - period_s * period_s / 2 * world_->gravity_m_s2;
    turns_[i] = nodes_[i].spin;
  }
  for (const Row& row : rows_) {
    if (!(row.pressed > 0)) continue;
    for (const int number : {row.a, row.b}) {
      if (number == Row::kFixed || static_cast<std::size_t>(number) >= bodies) continue;
      const auto i = static_cast<std::size_t>(number);
      ways_[i] = period_s * nodes_[i].velocity;
    }
  }
  pushApart(period_s);
  for (std::size_t i = 0; i < bodies; ++i) {
    const double way = ways_[i].norm() + period_s * turns_[i].norm() * world_->bodies[i].shape.reach;
    if (way <= margin / 2) continue;
    ways_[i] *= margin / 2 / way;
    turns_[i] *= margin / 2 / way;
  }
}

// Overlaps are removed by velocities of their own, which act for this step alone and leave no kinetic energy.
void BodyStepper::pushApart(double period_s) {
  overlaps_.clear();
  for (const Row& row : rows_) {
    if (row.gap >= -kTouching_m) continue;
    overlaps_.push_back(row);
    overlaps_.back().pressed = overlaps_.back().friction = 0;
    overlaps_.back().dragged.setZero();
    overlaps_.back().least_velocity = -kPushedApart * row.gap / period_s;
  }
  if (overlaps_.empty()) return;
  apart_ = nodes_;
  for (Node& node : apart_) node.velocity = node.spin = Vec3::Zero();
  solveRows(overlaps_, apart_, period_s, limitsFor(rows_.size()));
  for (std::size_t i = 0; i < world_->bodies.size(); ++i) {
    ways_[i] += period_s * apart_[i].velocity;
    turns_[i] += apart_[i].spin;
  }
}

void BodyStepper::bounce(double period_s) {
  bool any = false;
  for (Row& row : rows_) {
    if (!(row.pressed > 0) || row.restitution == 0 || row.approach > -kBounces_m_s) continue;
    row.least_velocity = -row.restitution * row.approach;
    any = true;
  }
  if (any) solveRows(rows_, nodes_, period_s, limitsFor(rows_.size()));
}

void BodyStepper::tellHands(std::span<GivenImpulses> given) const {
  const std::size_t bodies = world_->bodies.size();
  for (const Row& row : rows_) {
    if (static_cast<std::size_t>(row.a) < bodies) continue;
    const Vec3 impulse = -(row.pressed * row.normal + row.dragged);
    const bool fixed = row.b == Row::kFixed;
    const Vec3 point = fixed ? row.arm_b : Vec3(row.arm_b + nodes_[static_cast<std::size_t>(row.b)].centre);
    given[static_cast<std::size_t>(row.a) - bodies].push(
        {fixed ? 0 : world_->bodies[static_cast<std::size_t>(row.b)].key, point, impulse});
  }
}

void BodyStepper::book(WorldState& state, std::span<const GivenImpulses> given, double period_s) const {
  EnergyBook& energy = state.energy;
  const std::size_t bodies = world_->bodies.size();
  for (const Row& row : rows_) {
    if (static_cast<std::size_t>(row.a) >= bodies) continue;
    const Vec3 mean = (relativeVelocity(row, before_) + relativeVelocity(row, nodes_)) / 2;
    energy.contact_J -= row.pressed * row.normal.dot(mean);
    energy.friction_J -= row.dragged.dot(mean);
  }
  for (const GivenImpulses& hand : given) {
    for (const BodyImpulse& one : hand) {
      const int number = numberOf(one.key);
      if (number == Row::kFixed) continue;
      const Node &now = nodes_[static_cast<std::size_t>(number)], &was = before_[static_cast<std::size_t>(number)];
      const Vec3 arm = one.point - now.centre;
      energy.by_hand_J += one.impulse_N_s.dot(now.velocityAt(arm) + was.velocityAt(arm)) / 2;
    }
  }
  for (std::size_t i = 0; i < bodies; ++i) {
    const Vec3 mean_way = period_s / 2 * (before_[i].velocity + nodes_[i].velocity);
    energy.solver_J += world_->bodies[i].mass.mass_kg * world_->gravity_m_s2.dot(mean_way - ways_[i]);
  }
}

// The angular momentum after the impulses stays; the turn is that of the spin before bounces.
void BodyStepper::move(WorldState& state, double period_s) const {
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const Body& body = world_->bodies[i];
    BodyState& one = state.bodies[i];
    const Vec3 momentum = inertiaOf(body, one) * nodes_[i].spin;
    one.velocity = nodes_[i].velocity;
    one.spin = turns_[i];
    moveFreely(body, one, ways_[i], period_s);
    one.spin = inverseInertia(body, one) * momentum;
    state.energy.solver_J += momentum.dot(one.spin - nodes_[i].spin) / 2;
  }
}

void BodyStepper::remember(WorldState& state) const {
  state.memory.clear();
  for (const Row& row : rows_)
    state.memory.add({row.pair, placeOf(row), row.pressed, row.dragged, row.slipping, false});
  state.memory.sort();
  ++state.steps;
}

BodyStepReport BodyStepper::step(WorldState& state, double period_s, std::span<const HandNode> hands,
                                 std::span<GivenImpulses> given) {
  BodyStepReport report;
  begin(state, period_s, hands, given);
  placed_.place(*world_, state);
  const double margin = marginOf(period_s);
  meetings_.find(*world_, state, placed_, margin);
  rows_.clear();
  for (std::size_t hand = 0; hand < hands.size(); ++hand) addHandRows(hands[hand], hand, state.memory);
  addBearing(state.memory);
  for (Row& row : rows_) prepareRow(row, nodes_);
  report.sweeps = solveRows(rows_, nodes_, period_s, limitsFor(rows_.size()));
  for (int round = 0; round < kRounds && addPassed(state, period_s); ++round)
    report.sweeps = std::max(report.sweeps, solveRows(rows_, nodes_, period_s, limitsFor(rows_.size())));
  planMotion(period_s, margin);
  bounce(period_s);
  tellHands(given);
  book(state, given, period_s);
  move(state, period_s);
  remember(state);
  report.rows = static_cast<int>(rows_.size());
  report.dropped = meetings_.dropped();
  for (const Row& row : rows_) report.deepest = std::max(report.deepest, -row.gap);
  return report;
}

}  // namespace hl

#include "bodies/contact_rows.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bodies/pair_at_end.h"
#include "bodies/row_solver.h"

namespace hl {

namespace {

// Of the size of a body, and rad: contacts as near as that are one.
constexpr double kTwin = 1e-3;
// Of the size of a body: a contact as near as that to one of the last step goes on from its impulse.
constexpr double kSamePlace = 0.05;

// Contacts: three around one.
constexpr std::size_t kSurrounded = 4;

// m/s: what slides no faster sticks.
constexpr double kSlips_m_s = 1e-6;

double meanOf(double x, double y) { return std::sqrt(x * y); }

BodySurface between(const BodySurface& x, const BodySurface& y) {
  return {meanOf(x.static_friction, y.static_friction), meanOf(x.dynamic_friction, y.dynamic_friction),
          meanOf(x.restitution, y.restitution)};
}

bool isOf(const Row& row, const Meeting& meeting) { return row.a == meeting.a && row.b == meeting.b; }

}  // namespace

ContactRows::ContactRows(BodyProblem& problem) : problem_(problem), ends_(*problem.world) {
  plan_.ways.resize(problem.bodies());
  plan_.turns.resize(problem.bodies());
  plan_.parts.assign(problem.bodies(), 1);
  touching_.reserve(std::max(problem.rows.capacity(), problem.meetings.room()));
  flat_.reserve(touching_.capacity());
}

Row ContactRows::rowOf(const Meeting& meeting, std::size_t number) const {
  const Body& body = problem_.world->bodies[static_cast<std::size_t>(meeting.a)];
  const bool fixed = meeting.b == Row::kFixed;
  const BodySurface surface =
      between(body.surface, fixed ? problem_.world->surfaceOfFixed(meeting.primitive.instance, body.surface)
                                  : problem_.world->bodies[static_cast<std::size_t>(meeting.b)].surface);
  const ManifoldPoint& point = meeting.manifold.points[number];
  Row row;
  row.pair = {body.key, fixed ? 0 : problem_.world->bodies[static_cast<std::size_t>(meeting.b)].key};
  row.a = meeting.a;
  row.b = meeting.b;
  row.normal = meeting.manifold.normal;
  row.arm_a = point.point - problem_.nodes[static_cast<std::size_t>(row.a)].centre;
  if (!fixed) row.arm_b = point.point - problem_.nodes[static_cast<std::size_t>(row.b)].centre;
  if (fixed) row.carried = problem_.sceneryVelocityAt(meeting.primitive, point.point);
  row.gap = point.gap;
  row.restitution = surface.restitution;
  row.static_friction = surface.static_friction;
  row.dynamic_friction = surface.dynamic_friction;
  row.friction = row.static_friction;
  return row;
}

bool ContactRows::addRow(ContactMemory& memory, Meeting& meeting, std::size_t number) {
  if (!problem_.hasRoom()) return false;
  meeting.used |= 1u << number;
  Row row = rowOf(meeting, number);
  recall(row, memory);
  row.approach = row.normal.dot(relativeVelocity(row, problem_.nodes));
  problem_.rows.push_back(row);
  return true;
}

Vec3 ContactRows::placeOf(const Row& row) const {
  const auto a = static_cast<std::size_t>(row.a);
  return a < problem_.turned.size() ? Vec3(problem_.turned[a].transpose() * row.arm_a) : row.normal;
}

// Of a hand, whose contacts all are at its proxy, the normal takes the place of the place.
void ContactRows::recall(Row& row, ContactMemory& memory) const {
  const auto a = static_cast<std::size_t>(row.a);
  const double near = a < problem_.turned.size() ? kSamePlace * problem_.world->bodies[a].shape.reach : kSamePlace;
  RememberedContact* const last = memory.find(row.pair, placeOf(row), near);
  if (last == nullptr) return;
  last->taken = true;
  row.pressed = last->pressed;
  row.dragged = last->dragged;
  row.slipping = last->slipped;
  row.friction = row.slipping ? row.dynamic_friction : row.static_friction;
}

void ContactRows::findTouching() {
  std::vector<Meeting>& meetings = problem_.meetings.all();
  touching_.clear();
  for (std::uint32_t i = 0; i < meetings.size(); ++i) {
    meetings[i].inner = 0;
    const auto& points = meetings[i].manifold.points;
    for (std::uint32_t point = 0; point < points.size() && touching_.size() < touching_.capacity(); ++point) {
      if (points[point].gap <= kHeld_m) touching_.push_back({i, point, points[point].gap});
    }
  }
  std::sort(touching_.begin(), touching_.end(), [&](const Touching& x, const Touching& y) {
    const Meeting &of_x = meetings[x.meeting], &of_y = meetings[y.meeting];
    return std::tie(of_x.a, of_x.b, x.gap, x.meeting, x.point) < std::tie(of_y.a, of_y.b, y.gap, y.meeting, y.point);
  });
}

bool ContactRows::isOfPlane(const Touching& one, const Touching& other) const {
  const Meeting &x = problem_.meetings.all()[one.meeting], &y = problem_.meetings.all()[other.meeting];
  return x.primitive.instance == y.primitive.instance &&
         (x.manifold.normal - y.manifold.normal).squaredNorm() < kTwin * kTwin;
}

// Of the contacts of a pair, from `first` on, those in the plane of the first.
void ContactRows::markInnerOfPlane(std::size_t first, std::size_t end) {
  std::vector<Meeting>& meetings = problem_.meetings.all();
  const Meeting& meeting = meetings[touching_[first].meeting];
  const Vec3 along = meeting.manifold.normal.unitOrthogonal(), across = meeting.manifold.normal.cross(along);
  const Vec3& centre = problem_.nodes[static_cast<std::size_t>(meeting.a)].centre;
  const auto flat = [&](const Touching& one) {
    const Vec3 arm = meetings[one.meeting].manifold.points[one.point].point - centre;
    return FlatContact{{along.dot(arm), across.dot(arm)}, one.gap};
  };
  flat_.clear();
  for (std::size_t i = first; i < end; ++i) {
    if (isOfPlane(touching_[first], touching_[i])) flat_.push_back(flat(touching_[i]));
  }
  const ContactHull hull(flat_);
  if (hull.corners() == flat_.size()) return;
  for (std::size_t i = first; i < end; ++i) {
    const Touching& one = touching_[i];
    if (isOfPlane(touching_[first], one) && hull.keeps(flat(one), kTouching_m))
      meetings[one.meeting].inner |= 1u << one.point;
  }
}

void ContactRows::markInner() {
  const auto meeting_of = [&](std::size_t i) -> const Meeting& {
    return problem_.meetings.all()[touching_[i].meeting];
  };
  for (std::size_t first = 0, end = 0; first < touching_.size(); first = end) {
    while (end < touching_.size() && meeting_of(end).a == meeting_of(first).a &&
           meeting_of(end).b == meeting_of(first).b)
      ++end;
    if (end - first < kSurrounded) continue;
    for (std::size_t i = first; i < end; ++i) {
      const bool is_new = std::none_of(touching_.begin() + static_cast<std::ptrdiff_t>(first),
                                       touching_.begin() + static_cast<std::ptrdiff_t>(i),
                                       [&](const Touching& other) { return isOfPlane(other, touching_[i]); });
      if (is_new) markInnerOfPlane(i, end);
    }
  }
}

// What bore load in the last step, and has not come off since. Of the contacts near the place where one bore, the
// nearest goes on with it.
void ContactRows::addBearing(ContactMemory& memory) {
  std::vector<Meeting>& meetings = problem_.meetings.all();
  findTouching();
  markInner();
  std::size_t first = problem_.rows.size();  // of the rows of the pair
  for (const Touching& one : touching_) {
    const Meeting& meeting = meetings[one.meeting];
    if (first < problem_.rows.size() && !isOf(problem_.rows[first], meeting)) first = problem_.rows.size();
    if (meeting.isInner(one.point) || hasTwin(meeting, one.point, first)) continue;
    if (!addRow(memory, meetings[one.meeting], one.point) || problem_.rows.back().pressed > 0) continue;
    problem_.rows.pop_back();
    meetings[one.meeting].used &= ~(1u << one.point);
  }
}

// A row that bears at the same place in the same direction: the triangle on the other side of an edge.
bool ContactRows::hasTwin(const Meeting& meeting, std::size_t number, std::size_t first) const {
  const ManifoldPoint& point = meeting.manifold.points[number];
  const Vec3 arm = point.point - problem_.nodes[static_cast<std::size_t>(meeting.a)].centre;
  const double near = kTwin * problem_.world->bodies[static_cast<std::size_t>(meeting.a)].shape.reach;
  const auto begin = problem_.rows.begin() + static_cast<std::ptrdiff_t>(first);
  return std::any_of(begin, problem_.rows.end(), [&](const Row& row) {
    return isOf(row, meeting) && (row.arm_a - arm).squaredNorm() < near * near &&
           (row.normal - meeting.manifold.normal).squaredNorm() < kTwin * kTwin;
  });
}

bool ContactRows::goesThrough(const Meeting& meeting, std::size_t number) const {
  if (meeting.uses(number) || meeting.isInner(number)) return false;
  const ManifoldPoint& point = meeting.manifold.points[number];
  const Node& a = problem_.nodes[static_cast<std::size_t>(meeting.a)];
  Vec3 velocity = a.velocityAt(point.point - a.centre);
  if (meeting.b != Row::kFixed) {
    const Node& b = problem_.nodes[static_cast<std::size_t>(meeting.b)];
    velocity -= b.velocityAt(point.point - b.centre);
  } else {
    velocity -= problem_.sceneryVelocityAt(meeting.primitive, point.point);
  }
  return point.gap + problem_.period_s * meeting.manifold.normal.dot(velocity) < -kTouching_m;
}

// What turns or is fast is looked at where it would end: its rows, if it has any, were made for the begin.
void ContactRows::addOfMeeting(WorldState& state, Meeting& meeting, Accuracy accuracy) {
  bool predicted = false;
  for (std::size_t point = 0; point < meeting.manifold.points.size(); ++point) predicted |= goesThrough(meeting, point);
  const bool rough = accuracy == Accuracy::kRough;
  const Pace pace = rough ? Pace{} : paceOf(problem_, meeting);
  if (!predicted && !pace.fast && !pace.turns) return;
  const PairAtEnd pair(problem_, state, meeting, plan_, ends_);
  if (isKeptApart(problem_, meeting, pair)) return;
  Manifold end;
  const double overlap = overlapOf(pair, end);
  // What was beside the triangle comes over it within the step.
  const bool over = meeting.beside && overlap > kHeld_m && isByFace(pair.b, end.normal);
  const bool by_begin = !over && predicted && (pace.fast || overlap > kTouching_m);
  for (std::size_t point = 0; by_begin && point < meeting.manifold.points.size(); ++point) {
    if (goesThrough(meeting, point) && !hasTwin(meeting, point, 0)) addRow(state.memory, meeting, point);
  }
  const bool by_end = !by_begin && (pace.fast || pace.turns) && overlap > kHeld_m;
  if (over || by_end) addRowsOfEnd(meeting, end);
}

bool ContactRows::hasRow(const Meeting& meeting, std::size_t first, std::size_t end) const {
  return std::any_of(problem_.rows.begin() + static_cast<std::ptrdiff_t>(first),
                     problem_.rows.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](const Row& row) { return isOf(row, meeting); });
}

// The triangles beside a body come last, and wait if another one has just got a row: what rolls over a seam is borne by
// that one, and would hop over the edge of the next.
bool ContactRows::addPassed(WorldState& state, Accuracy accuracy) {
  const std::size_t before = problem_.rows.size();
  for (const std::size_t i : problem_.awake) {
    plan_.ways[i] = problem_.period_s * problem_.nodes[i].velocity;
    plan_.turns[i] = problem_.nodes[i].spin;
  }
  for (Meeting& meeting : problem_.meetings.all()) {
    if (!meeting.beside) addOfMeeting(state, meeting, accuracy);
  }
  const std::size_t beside = problem_.rows.size();
  for (Meeting& meeting : problem_.meetings.all()) {
    if (meeting.beside && !hasRow(meeting, before, beside)) addOfMeeting(state, meeting, accuracy);
  }
  for (std::size_t i = before; i < problem_.rows.size(); ++i) prepareRow(problem_.rows[i], problem_.nodes);
  return problem_.rows.size() > before;
}

// The same contact, as it would be at the end: its gap there is what the motion found makes of the row's gap.
void ContactRows::addRowsOfEnd(const Meeting& meeting, const Manifold& end) {
  Meeting at_end = meeting;
  at_end.manifold = end;
  const auto way_of = [&](int number) {
    return number == Row::kFixed ? Vec3(Vec3::Zero())
                                 : Vec3(problem_.period_s * problem_.nodes[static_cast<std::size_t>(number)].velocity);
  };
  for (std::size_t point = 0; point < end.points.size(); ++point) {
    if (!problem_.hasRoom()) continue;
    Row row = rowOf(at_end, point);
    row.arm_a -= way_of(row.a);
    if (row.b != Row::kFixed) row.arm_b -= way_of(row.b);
    row.approach = row.normal.dot(relativeVelocity(row, problem_.nodes));
    row.gap = end.points[point].gap - problem_.period_s * row.approach;
    problem_.rows.push_back(row);
  }
}

// Of a body that sticks at several points some may be at their limit: they slip when the body slides.
void ContactRows::remember(ContactMemory& memory) const {
  memory.clear();
  for (const Row& row : problem_.rows) {
    const Vec3 velocity = relativeVelocity(row, problem_.nodes);
    const bool slides = (velocity - row.normal.dot(velocity) * row.normal).norm() > kSlips_m_s;
    memory.add({row.pair, placeOf(row), row.pressed, row.dragged, row.slipping && slides, false});
  }
  memory.sort();
}

}  // namespace hl

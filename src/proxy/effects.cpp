#include "proxy/effects.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "proxy/mixing.h"

namespace hl {

namespace {

// Neighbours whose shaded normals differ by more meet in a crease: the file means the edge to be seen, and felt.
constexpr double kCrease_rad = 0.01;

constexpr int kInnerPasses = 12;

// The way over the edge of a textured triangle that makes its neighbour the one in contact, in proxy radii: the closest
// point of the one left behind is then farther by 1/2 (1e-4)^2 = 5e-9 radii, 50 times the skin.
constexpr double kOverEdge = 1e-4;

constexpr double kSamplesPerTexel = 2;
constexpr int kMostSamples = 4096;

}  // namespace

// Whether friction or viscosity act on this contact.
bool Effects::resists(const Contact& contact) const {
  if (reader_.dragTextured(contact.primitive)) return true;
  const auto acts = [&](Quantity quantity) { return reader_.read(quantity, contact.primitive).low > 0; };
  return acts(Quantity::kStaticFriction) || acts(Quantity::kDynamicFriction) || acts(Quantity::kViscosity);
}

bool Effects::any(const ContactSet& set) const {
  return std::any_of(set.contacts.begin(), set.contacts.end(),
                     [&](const Contact& contact) { return reader_.mayBend(contact.primitive) || resists(contact); });
}

// Whether a primitive that shares the edge or vertex under the contact has another normal there.
bool Effects::creased(const ContactSet& set, const Contact& contact, const Vec3& normal) const {
  return std::any_of(set.twins.begin(), set.twins.end(), [&](const Contact& twin) {
    return samePlane(twin, contact) && reader_.bend(placeOf(twin)).normal.cross(normal).norm() > kCrease_rad;
  });
}

Effects::TouchedSet Effects::touchedNow(const ContactSet& set) const {
  TouchedSet touched;
  for (const Contact& contact : set.contacts) {
    Touched now{placeOf(contact), {}, reader_.mayBend(contact.primitive)};
    if (now.bends) now.bent = reader_.bend(now.place);
    if (now.bent.bent() && creased(set, contact, now.bent.normal)) now.bends = false;
    if (!now.bends) now.bent = {contact.plane.normal, 0, 0};
    touched.push(now);
  }
  return touched;
}

// The places touched and their bent normals when the passes have moved the proxy to `centre`.
void Effects::moveOn(const ContactSet& set, const Vec3& centre, TouchedSet& touched) const {
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const ClosestPoint nearest = scene_.closest(set.contacts[i].primitive, centre);
    touched[i].place.weights = nearest.weights;
    touched[i].place.normal = nearest.normal;
    if (touched[i].bends) touched[i].bent = reader_.bend(touched[i].place);
  }
}

// Pass 1: the point nearest the finger above the planes as they feel, each bent about where it holds the proxy now.
Vec3 Effects::firstPass(const ContactSet& set, const TouchedSet& touched, const Vec3& gap, const Vec3& offset,
                        SubGoal& sub_goal) const {
  FixedVector<Plane, kMaxContacts> planes;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const double height = set.planes[i].normal.dot(offset) - set.planes[i].offset;
    planes.push({touched[i].bent.normal, touched[i].bent.normal.dot(offset) - height});
    sub_goal.bent |= touched[i].bent.bent();
  }
  const SolverResult solution = nearestAbove({planes.begin(), planes.size()}, gap, tolerance_.feasible);
  sub_goal.holding.clear();
  sub_goal.shading = sub_goal.bump = 0;
  for (std::size_t i = 0; i < solution.active_count; ++i) {
    const std::size_t contact = solution.active[i];
    const BentNormal& bent = touched[contact].bent;
    sub_goal.holding.push({contact, touched[contact].place, bent.normal, solution.multiplier[i]});
    sub_goal.shading = std::max(sub_goal.shading, bent.shading);
    sub_goal.bump = std::max(sub_goal.bump, bent.bump);
  }
  return solution.violation > tolerance_.feasible ? offset : solution.point;
}

// Pass 2: back above the true planes; a goal above all of them comes down to the nearest.
Vec3 Effects::secondPass(const ContactSet& set, const Vec3& goal) const {
  double lowest = std::numeric_limits<double>::infinity();
  Vec3 down = Vec3::Zero();
  for (const Plane& plane : set.planes) {
    const double height = plane.normal.dot(goal) - plane.offset;
    if (height < lowest) {
      lowest = height;
      down = height * plane.normal;
    }
  }
  const Vec3 lowered = lowest > 0 ? Vec3(goal - down) : goal;
  const SolverResult result = nearestAbove({set.planes.begin(), set.planes.size()}, lowered, tolerance_.feasible);
  return result.violation <= tolerance_.feasible ? result.point : Vec3(Vec3::Zero());
}

// The slip along the way, after `before`.
Vec3 Effects::slip(Resistance& resistance, const Drag& drag, const Vec3& way, const Slip& before,
                   SubGoal& sub_goal) const {
  const double pull = way.norm();
  if (!(pull > 0)) return Vec3::Zero();
  if (resistance.textured()) resistance.setWay(way);
  if (resistance.texels() == 0) {
    sub_goal.viscous = drag.viscous;
    return (slipLength(drag, pull, before) / pull) * way;
  }
  const double wanted = std::ceil(kSamplesPerTexel * resistance.texels());
  const int samples = static_cast<int>(std::clamp(wanted, 1.0, double{kMostSamples}));
  const auto drag_at = [&](double distance) { return resistance.at(distance / pull); };
  const double length = slipLengthAlong(drag, drag_at, pull, before, samples, sub_goal.viscous);
  return std::min(length / pull, resistance.within() + kOverEdge * tolerance_.reach / pull) * way;
}

// What friction lets the proxy go of the way, after `slipped_now` more than slip_ says.
//
// A stuck proxy with pre-sliding springs creeps to where they balance the pull that is left,
//   |way - D| = creep |creep_m + D|,
// and back when the pull falls: the elastic state z of Dahl's and Hayward and Armstrong's models, without their drift.
Vec3 Effects::resistedStep(const Vec3& way, double slipped_now, SubGoal& sub_goal) const {
  sub_goal.viscous = sub_goal.creep = 0;
  sub_goal.creeps = false;
  Resistance resistance(reader_, settings_);
  for (const Holding& holding : sub_goal.holding) resistance.add(holding.place, holding.multiplier_m);
  const Drag drag = resistance.at();
  sub_goal.resisted = resistance.textured() || drag.viscous > 0 || drag.holding() > 0;
  if (!sub_goal.resisted) return way;
  sub_goal.creep = drag.creep;
  const Slip before{slip_.length + slipped_now, slip_.viscous_m + drag.viscous * slipped_now};
  const bool stuck = !slipping_ && slipped_now == 0;
  Vec3 creep = drag.creep > 0 ? Vec3((way - drag.creep * creep_m_) / (1 + drag.creep)) : Vec3(Vec3::Zero());
  if (stuck && (way - creep).norm() <= drag.holding() + before.viscous_m) {
    sub_goal.creeps = drag.creep > 0;
    return creep;
  }
  return slip(resistance, drag, way, before, sub_goal);
}

// The passes are repeated here with the contacts in hand, which costs no search. Mixing takes out the main part of what
// each would leave, a factor of sin^2(beta) + depth / radius.
SubGoal Effects::subGoal(const ContactSet& set, const Vec3& position, const Vec3& gap) const {
  const bool few = set.contacts.size() <= kFewContacts;
  const bool resisting =
      std::any_of(set.contacts.begin(), set.contacts.end(), [&](const Contact& contact) { return resists(contact); });
  const double enough = kRestPerGap * gap.norm() + tolerance_.rest;
  SubGoal sub_goal;
  TouchedSet touched = touchedNow(set);
  Vec3 offset = Vec3::Zero();
  Mixing mixing;
  for (int pass = 1;; ++pass) {
    const Vec3 way = firstPass(set, touched, gap, offset, sub_goal) - offset;
    const Vec3 resisted = resisting ? resistedStep(way, offset.norm(), sub_goal) : way;
    sub_goal.held = way - resisted;
    const Vec3 goal = offset + resisted;
    const Vec3 next = sub_goal.bent ? secondPass(set, goal) : goal;
    const Vec3 change = next - offset;
    sub_goal.step = next;
    if (!few || !sub_goal.bent || settings_.shading == ShadingPasses::kOnce) return sub_goal;
    sub_goal.settles = change.norm() <= enough;
    if (sub_goal.settles || pass == kInnerPasses) return sub_goal;
    offset = mixing.guess(next, change);
    moveOn(set, position + offset, touched);
  }
}

void Effects::moved(const SubGoal& sub_goal, const Vec3& step) {
  const double length = step.norm();
  if (!(length > 0)) return;
  if (sub_goal.creeps) {
    creep_m_ += step;
    return;
  }
  slip_.length += length;
  slip_.viscous_m += sub_goal.viscous * length;
  slipping_ = true;
  // The springs slide along, stretched by the friction that they carry.
  creep_m_ = sub_goal.creep > 0 ? Vec3(sub_goal.held / sub_goal.creep) : Vec3(Vec3::Zero());
}

ProxyContact Effects::describe(const ContactSet& set, const Holding& holding) const {
  return {set.contacts[holding.contact].point,
          holding.normal,
          holding.multiplier_m,
          holding.place.primitive,
          std::clamp(reader_.value(Quantity::kStiffness, holding.place), 0.0, 1.0),
          std::max(0.0, reader_.value(Quantity::kStaticFriction, holding.place)),
          resists(set.contacts[holding.contact])};
}

}  // namespace hl

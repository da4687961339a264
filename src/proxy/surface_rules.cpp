#include "proxy/surface_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "proxy/anderson_mixing.h"

namespace hl {

bool SurfaceRules::any(const ContactSet& set) const {
  return std::any_of(set.contacts.begin(), set.contacts.end(), [&](const Contact& contact) {
    if (plain(contact.primitive)) return false;
    const Surface surface = surfaceOf(contact.primitive);
    return surface.smooth() || surface.textured(Quantity::kHeight) || Roughness::of(surface).acts();
  });
}

// Whether a primitive that shares the edge or vertex under the contact has another normal there.
bool SurfaceRules::creased(const ContactSet& set, const Contact& contact, const Vec3& normal) const {
  return std::any_of(set.twins.begin(), set.twins.end(), [&](const Contact& twin) {
    if (!samePlane(twin, contact)) return false;
    return patchAt(placeOf(twin)).bend().normal.cross(normal).norm() > accuracy::kCrease_rad;
  });
}

SurfaceRules::TouchedSet SurfaceRules::touchedNow(const ContactSet& set) const {
  TouchedSet touched;
  for (const Contact& contact : set.contacts) {
    const Surface surface = surfaceOf(contact.primitive);
    Touched now{
        Patch(scene_, surface, placeOf(contact)), Vec3::Zero(), Vec2::Zero(), {}, false, Roughness::of(surface)};
    now.bends = now.patch.bends();
    if (now.bends) now.bent = now.patch.bend();
    if (now.bent.bent() && creased(set, contact, now.bent.normal)) now.bends = false;
    if (!now.bends) now.bent = {contact.plane.normal, 0, 0};
    touched.push(now);
  }
  return touched;
}

// The places touched and their bent normals when the passes have moved the proxy on, from `position` by `offset`.
void SurfaceRules::moveOn(const ContactSet& set, const Vec3& position, const Vec3& offset, TouchedSet& touched) const {
  for (std::size_t i = 0; i < touched.size(); ++i) {
    Touched& now = touched[i];
    now.moved = now.patch.weightsOver(offset - now.patch_offset);
    if (!now.patch.holds(now.moved)) {
      const PrimitiveId primitive = set.contacts[i].primitive;
      const ClosestPoint nearest = scene_.closest(primitive, position + offset);
      now.patch = patchAt({primitive, nearest.normal, nearest.weights});
      now.patch_offset = offset;
      now.moved = Vec2::Zero();
    }
    if (now.bends) now.bent = now.patch.bend(now.moved);
  }
}

// Pass 1: the point nearest the finger above the planes as they feel, each bent about where it holds the proxy now.
SolverResult SurfaceRules::firstPass(const ContactSet& set, const TouchedSet& touched, const Vec3& gap,
                                     const Vec3& offset) const {
  FixedVector<Plane, kMaxContacts> planes;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const double height = set.planes[i].normal.dot(offset) - set.planes[i].offset;
    planes.push({touched[i].bent.normal, touched[i].bent.normal.dot(offset) - height});
  }
  SolverResult held = nearestAbove({planes.begin(), planes.size()}, gap, tolerance_.feasible);
  if (held.violation > tolerance_.feasible) held.point = offset;
  return held;
}

// The point nearest the goal above the true planes; where the proxy is when rounding leaves none.
Vec3 SurfaceRules::aboveTruePlanes(const ContactSet& set, const Vec3& goal) const {
  const SolverResult result = nearestAbove({set.planes.begin(), set.planes.size()}, goal, tolerance_.feasible);
  return result.violation <= tolerance_.feasible ? result.point : Vec3(Vec3::Zero());
}

// Pass 2: back above the true planes; a goal above all of them comes down to the nearest.
Vec3 SurfaceRules::secondPass(const ContactSet& set, const Vec3& goal) const {
  if (set.planes.size() == 1)  // as most: from either side onto the plane
    return goal - (set.planes[0].normal.dot(goal) - set.planes[0].offset) * set.planes[0].normal;
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
  return aboveTruePlanes(set, lowered);
}

// The slip along the way, after `before`.
Vec3 SurfaceRules::slip(Resistance& resistance, const Drag& drag, const Vec3& way, const Slip& before,
                        Proposal& proposal) const {
  const double pull = way.norm();
  if (!(pull > 0)) return Vec3::Zero();
  if (resistance.slipTextured()) resistance.setWay(way);
  if (resistance.texels() == 0) {
    proposal.viscous = drag.viscous;
    return (slipLength(drag, pull, before) / pull) * way;
  }
  const int samples =
      1 + static_cast<int>(std::min(accuracy::kSamplesPerTexel * resistance.texels(), accuracy::kMostSamples - 1));
  const auto drag_at = [&](double distance) { return resistance.at(distance / pull); };
  const double length = slipLengthAlong(drag_at, pull, before, samples, proposal.viscous);
  return std::min(length / pull, resistance.within() + accuracy::kOverEdge * tolerance_.reach / pull) * way;
}

// What friction lets the proxy go of the way, after `slipped_now` more than slip_ says.
//
// A stuck proxy with pre-sliding springs creeps to where they balance the pull that is left,
//   |way - D| = creep |creep_m + D|,
// and back when the pull falls: the elastic state z of Dahl's and Hayward and Armstrong's models, without their drift.
// D comes from where the proxy got stuck: on a surface that turns, the springs may pull into what it touches now.
Vec3 SurfaceRules::resistedStep(Resistance resistance, const Vec3& way, double slipped_now, Proposal& proposal) const {
  proposal.viscous = proposal.creep = 0;
  proposal.creeps = false;
  const Drag drag = resistance.here();
  proposal.resisted = resistance.slipTextured() || drag.viscous > 0 || drag.holding() > 0;
  if (!proposal.resisted) return way;
  proposal.creep = drag.creep;
  const Slip before{slip_.length + slipped_now, slip_.viscous_m + drag.viscous * slipped_now};
  const bool stuck = !slipping_ && slipped_now == 0;
  Vec3 creep = drag.creep > 0 ? Vec3((way - drag.creep * creep_m_) / (1 + drag.creep)) : Vec3(Vec3::Zero());
  if (stuck && (way - creep).norm() <= drag.holding() + before.viscous_m) {
    proposal.creeps = drag.creep > 0;
    return creep;
  }
  return slip(resistance, drag, way, before, proposal);
}

Resistance SurfaceRules::resistanceOf(const TouchedSet& touched, const SolverResult& held) const {
  Resistance resistance(settings_);
  for (std::size_t i = 0; i < held.active_count; ++i) {
    const Touched& by = touched[held.active[i]];
    resistance.add(by.roughness, by.patch, by.moved, held.multiplier[i]);
  }
  return resistance;
}

void SurfaceRules::tellHolding(const TouchedSet& touched, const SolverResult& held, Proposal& proposal) const {
  for (std::size_t i = 0; i < held.active_count; ++i) {
    const Touched& by = touched[held.active[i]];
    proposal.holding.push({held.active[i], by.patch.place(by.moved), by.bent.normal, held.multiplier[i]});
    proposal.shading = std::max(proposal.shading, by.bent.shading);
    proposal.bump = std::max(proposal.bump, by.bent.bump);
  }
}

// On planes that bend nowhere, a slip whose resistance is the same all along ends where the next would not move it.
bool SurfaceRules::slipsAtOnce(const TouchedSet& touched, const Proposal& proposal) const {
  const auto changes = [](const Touched& now) { return now.bends || now.roughness.slipTextured(); };
  return proposal.resisted && !proposal.creeps && touched.size() <= convergence::kFewContacts &&
         std::none_of(touched.begin(), touched.end(), changes);
}

// Whether the planes, all of faces, are still those of the contacts after `step`.
bool SurfaceRules::staysOnFaces(const ContactSet& set, const TouchedSet& touched, const Vec3& step) const {
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const Patch& patch = touched[i].patch;
    if (set.contacts[i].feature != Feature::kFace) return false;
    if (!patch.covers(patch.weightsOver(step - touched[i].patch_offset))) return false;
  }
  return true;
}

// The passes are repeated here with the contacts in hand, which costs no search. AndersonMixing takes out the main part
// of what each would leave, a factor of sin^2(beta) + depth / radius.
void SurfaceRules::settle(const ContactSet& set, const Vec3& position, const Vec3& gap, Proposal& proposal) const {
  using Rest = Proposal::Rest;
  const bool few = set.contacts.size() <= convergence::kFewContacts;
  const double enough = accuracy::kRestPerGap * gap.norm() + tolerance_.rest;
  TouchedSet touched = touchedNow(set);
  const auto any = [&](auto says) { return std::any_of(touched.begin(), touched.end(), says); };
  const bool resisting = any([](const Touched& now) { return now.roughness.acts(); });
  proposal = {};
  proposal.rule = Proposal::Rule::kFelt;
  Vec3 offset = Vec3::Zero();
  AndersonMixing mixing;
  for (int pass = 1;; ++pass) {
    const SolverResult held = firstPass(set, touched, gap, offset);
    proposal.bent = proposal.bent || any([](const Touched& now) { return now.bent.bent(); });
    const Vec3 way = held.point - offset;
    const Vec3 resisted = resisting ? resistedStep(resistanceOf(touched, held), way, offset.norm(), proposal) : way;
    const Vec3 goal = offset + resisted;
    proposal.held = way - resisted;
    proposal.step = proposal.bent ? secondPass(set, goal) : proposal.creeps ? aboveTruePlanes(set, goal) : goal;
    const Vec3 change = proposal.step - offset;
    const bool repeats = few && proposal.bent && settings_.shading != ShadingPasses::kOnce;
    const bool settles = repeats ? change.norm() <= enough : slipsAtOnce(touched, proposal);
    if (!repeats || settles || pass == convergence::kInnerPasses) {
      tellHolding(touched, held, proposal);
      if (settles) proposal.rest = staysOnFaces(set, touched, proposal.step) ? Rest::kStays : Rest::kSettles;
      return;
    }
    offset = mixing.guess(proposal.step, change);
    moveOn(set, position, offset, touched);
  }
}

void SurfaceRules::propose(const ContactSet& set, const Vec3& position, const Vec3& gap, Proposal& proposal) {
  ++proposals_;
  settle(set, position, gap, proposal);
  if (postpones()) proposal.step = Vec3::Zero();
}

void SurfaceRules::moved(const Proposal& proposal, const Vec3& step) {
  const double length = step.norm();
  if (!(length > 0)) return;
  if (proposal.creeps) {
    creep_m_ += step;
    return;
  }
  slip_.length += length;
  slip_.viscous_m += proposal.viscous * length;
  slipping_ = true;
  // The springs slide along, stretched by the friction that they carry.
  creep_m_ = proposal.creep > 0 ? Vec3(proposal.held / proposal.creep) : Vec3(Vec3::Zero());
}

double SurfaceRules::stiffnessAt(const SurfacePlace& place) const {
  if (plain(place.primitive)) return 1;
  const Surface surface = surfaceOf(place.primitive);
  const SurfaceValue stiffness = surface.read(Quantity::kStiffness);
  const Vec2 texcoord = stiffness.texture ? surface.texcoord(place.weights) : Vec2(Vec2::Zero());
  return std::clamp(stiffness.at(texcoord), 0.0, 1.0);
}

ProxyContact SurfaceRules::describe(const ContactSet& set, const Holding& holding) const {
  const Vec3& point = set.contacts[holding.contact].point;
  if (plain(holding.place.primitive))
    return {point, holding.normal, holding.multiplier_m, holding.place.primitive, 1, 0, false};
  const Surface surface = surfaceOf(holding.place.primitive);
  const SurfaceValue stiffness = surface.read(Quantity::kStiffness);
  const Roughness roughness = Roughness::of(surface);
  const bool textured = stiffness.texture || roughness.fixed.texture;
  const Vec2 texcoord = textured ? surface.texcoord(holding.place.weights) : Vec2(Vec2::Zero());
  return {point,
          holding.normal,
          holding.multiplier_m,
          holding.place.primitive,
          std::clamp(stiffness.at(texcoord), 0.0, 1.0),
          std::max(0.0, roughness.fixed.at(texcoord)),
          roughness.acts()};
}

}  // namespace hl

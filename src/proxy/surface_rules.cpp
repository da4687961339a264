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
    return surface.smooth() || surface.textured(Quantity::kHeight) || SurfaceFriction::of(surface).acts();
  });
}

// Whether a primitive that shares the contact's edge or vertex has a different shading normal there (a crease).
bool SurfaceRules::creased(const ContactSet& set, const Contact& contact, const Vec3& normal) const {
  return std::any_of(set.twins.begin(), set.twins.end(), [&](const Contact& twin) {
    if (!samePlane(twin, contact)) return false;
    return patchAt(placeOf(twin)).shadingNormal().normal.cross(normal).norm() > accuracy::kCrease_rad;
  });
}

SurfaceRules::TouchedSet SurfaceRules::touchedNow(const ContactSet& set) const {
  TouchedSet touched;
  for (const Contact& contact : set.contacts) {
    const Surface surface = surfaceOf(contact.primitive);
    Touched now{
        Patch(scene_, surface, placeOf(contact)), Vec3::Zero(), Vec2::Zero(), {}, false, SurfaceFriction::of(surface)};
    now.shaded = now.patch.shaded();
    if (now.shaded) now.shading_normal = now.patch.shadingNormal();
    if (now.shading_normal.differs() && creased(set, contact, now.shading_normal.normal)) now.shaded = false;
    if (!now.shaded) now.shading_normal = {contact.plane.normal, 0, 0};
    touched.push(now);
  }
  return touched;
}

// Updates the contact points and shading normals for a proxy moved from `position` by `offset`. Far from a small
// triangle, the direction from its nearest point to the proxy is no normal of the surface: the true normal stays that
// of the plane.
void SurfaceRules::moveOn(const ContactSet& set, const Vec3& position, const Vec3& offset, TouchedSet& touched) const {
  for (std::size_t i = 0; i < touched.size(); ++i) {
    Touched& now = touched[i];
    now.moved = now.patch.weightsOver(offset - now.patch_offset);
    if (!now.patch.holds(now.moved)) {
      const PrimitiveId primitive = set.contacts[i].primitive;
      const ClosestPoint nearest = scene_.closest(primitive, position + offset);
      now.patch = patchAt({primitive, set.planes[i].normal, nearest.weights});
      now.patch_offset = offset;
      now.moved = Vec2::Zero();
    }
    if (now.shaded) now.shading_normal = now.patch.shadingNormal(now.moved);
  }
}

// Pass 1: the point nearest the finger above the planes with shading normals. Each turned plane keeps its distance from
// the current offset.
SolverResult SurfaceRules::firstPass(const ContactSet& set, const TouchedSet& touched, const Vec3& gap,
                                     const Vec3& offset) const {
  FixedVector<Plane, kMaxContacts> planes;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const double height = set.planes[i].normal.dot(offset) - set.planes[i].offset;
    planes.push({touched[i].shading_normal.normal, touched[i].shading_normal.normal.dot(offset) - height});
  }
  SolverResult held = nearestAbove({planes.begin(), planes.size()}, gap, tolerance_.feasible);
  if (held.violation > tolerance_.feasible) held.point = offset;
  return held;
}

// The point nearest the goal above the true planes; the proxy's position if rounding makes the planes infeasible.
Vec3 SurfaceRules::aboveTruePlanes(const ContactSet& set, const Vec3& goal) const {
  const SolverResult result = nearestAbove({set.planes.begin(), set.planes.size()}, goal, tolerance_.feasible);
  return result.violation <= tolerance_.feasible ? result.point : Vec3(Vec3::Zero());
}

// Pass 2: projects the goal onto the feasible region of the true planes. A goal above all planes is first lowered onto
// the nearest plane.
Vec3 SurfaceRules::secondPass(const ContactSet& set, const Vec3& goal) const {
  if (set.planes.size() == 1)  // the usual case: project onto the plane, from either side
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

// The slip along `way`, after the slip `before` of this tick.
Vec3 SurfaceRules::slip(FrictionOnWay& resistance, const SlipResistance& drag, const Vec3& way, const Slip& before,
                        Proposal& proposal) const {
  const double pull = way.norm();
  if (!(pull > 0)) return Vec3::Zero();
  if (resistance.slipTextured()) resistance.setWay(way);
  if (resistance.texels() == 0) {
    proposal.viscous = drag.viscous;
    return (slipLength(drag, pull, before) / pull) * way;
  }
  const int samples =
      1 + static_cast<int>(std::min(accuracy::kSamplesPerTexel * resistance.texels(), accuracy::kMaxSamples - 1));
  const auto drag_at = [&](double distance) { return resistance.at(distance / pull); };
  const double length = slipLengthAlong(drag_at, pull, before, samples, proposal.viscous);
  return std::min(length / pull, resistance.within() + accuracy::kOverEdge * tolerance_.reach / pull) * way;
}

// The part of `way` that friction allows, after a slip of slip_.length in this tick and the `offset` of earlier passes.
//
// With pre-sliding springs the proxy moves by D to where they balance the remaining pull,
//   |way - D| = presliding_ratio |stretch + D|,
// as long as friction carries that: static friction of a proxy that is stuck, else that of the speed at which it would
// slip. The balance is a mean of the pull and of the springs' pull before the step, so that what is not carried slips.
// The springs are attached where the proxy stuck. So on a curved surface D may point into the surface that the
// proxy now touches.
Vec3 SurfaceRules::resistedStep(FrictionOnWay resistance, const Vec3& way, const Vec3& offset,
                                Proposal& proposal) const {
  using Resistance = Proposal::Resistance;
  const bool holds = proposal.preslides() || offset.isZero(0);  // so far
  proposal.viscous = 0;
  proposal.springs = {};
  const SlipResistance drag = resistance.here();
  const bool acts = resistance.slipTextured() || drag.viscous > 0 || drag.staticPull() > 0;
  proposal.resistance = acts ? Resistance::kActs : Resistance::kNone;
  if (!acts) return way;
  const double ratio = drag.presliding_ratio;
  proposal.springs = springs_.on(ratio * felt_N_m_);
  const double slipped = slip_.length + (holds ? 0 : offset.norm());
  const Slip before{slipped, slip_.viscous_m + drag.viscous * (slipped - slip_.length)};
  const bool stuck = holds && !slipping_;
  if (!stuck && !(holds && ratio > 0)) return slip(resistance, drag, way, before, proposal);
  const Vec3 slid = stuck ? Vec3(Vec3::Zero()) : slip(resistance, drag, way, before, proposal);
  const double carried = stuck ? drag.staticPull() : drag.coulombPull(slipped + slid.norm());
  Vec3 crept = Vec3::Zero();
  if (ratio > 0) {
    const Vec3 stretch = limited(proposal.springs.stretch_m + offset, carried / ratio);  // of a lesser normal force
    proposal.springs.stretch_m = stretch - offset;
    crept = (way - ratio * stretch) / (1 + ratio);
  }
  if ((way - crept).norm() > carried + before.viscous_m)
    return stuck ? slip(resistance, drag, way, before, proposal) : slid;
  if (ratio > 0) proposal.resistance = Resistance::kPreslides;
  return crept;
}

// That of the contact whose normal is nearest; 0 for a surface without adhesion.
double SurfaceRules::adhesionLoad_m(const Contact& contact) const {
  if (!loads_ || loads_->empty() || !(surfaceOf(contact.primitive).plain(Quantity::kAdhesion) > 0)) return 0;
  const auto along = [&](const AdhesionLoad& load) { return load.normal.dot(contact.plane.normal); };
  const auto nearer = [&](const AdhesionLoad& a, const AdhesionLoad& b) { return along(a) < along(b); };
  return std::max_element(loads_->begin(), loads_->end(), nearer)->load_m;
}

// Of what is no body that moves: 0.
double SurfaceRules::mobilityOf_m_Ns(const Contact& contact) const {
  const Instance& instance = scene_.instance(contact.primitive);
  if (!instance.movesAsBody()) return 0;
  const double mobility_kg = instance.body->poses->mobilityAcross(contact.point, contact.plane.normal);
  return settings_.period_s * mobility_kg / settings_.world_per_device;
}

FrictionOnWay SurfaceRules::frictionOf(const ContactSet& set, const TouchedSet& touched,
                                       const SolverResult& held) const {
  FrictionOnWay resistance(settings_, felt_N_m_);
  for (std::size_t i = 0; i < held.active_count; ++i) {
    const Touched& by = touched[held.active[i]];
    const double normal_m = held.multiplier[i] + adhesionLoad_m(set.contacts[held.active[i]]);
    resistance.add(by.friction, by.patch, by.moved, normal_m, mobilityOf_m_Ns(set.contacts[held.active[i]]));
  }
  return resistance;
}

void SurfaceRules::listActive(const TouchedSet& touched, const SolverResult& held, Proposal& proposal) const {
  for (std::size_t i = 0; i < held.active_count; ++i) {
    const Touched& by = touched[held.active[i]];
    proposal.active.push({held.active[i], by.patch.place(by.moved), by.shading_normal.normal, held.multiplier[i]});
    proposal.shading = std::max(proposal.shading, by.shading_normal.shading);
    proposal.bump = std::max(proposal.bump, by.shading_normal.bump);
  }
}

// Whether one pass gives the final slip: planes without shading, and a resistance that is constant along the slip. A
// further pass would not move the proxy.
bool SurfaceRules::slipsAtOnce(const TouchedSet& touched, const Proposal& proposal) const {
  const auto changes = [](const Touched& now) { return now.shaded || now.friction.slipTextured(); };
  return proposal.resistance == Proposal::Resistance::kActs && touched.size() <= convergence::kFewContacts &&
         std::none_of(touched.begin(), touched.end(), changes);
}

// Whether all contacts are faces and still hold on the same faces after `step`.
bool SurfaceRules::staysOnFaces(const ContactSet& set, const TouchedSet& touched, const Vec3& step) const {
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const Patch& patch = touched[i].patch;
    if (set.contacts[i].feature != Feature::kFace) return false;
    if (!patch.covers(patch.weightsOver(step - touched[i].patch_offset))) return false;
  }
  return true;
}

// The step to where pass 1 leads. A finger that is above the turned planes leaves the surface: its place is not lowered
// onto the true ones.
Vec3 SurfaceRules::toStep(const ContactSet& set, const Vec3& goal, const SolverResult& held,
                          const Proposal& proposal) const {
  if (proposal.may_raise_energy && held.active_count > 0) return secondPass(set, goal);
  return proposal.descends() && !proposal.preslides() ? goal : aboveTruePlanes(set, goal);
}

// The passes are repeated here with the same contacts, which needs no search. Each pass leaves a fraction sin^2(beta) +
// depth / radius of the error; AndersonMixing removes most of that.
void SurfaceRules::settle(const ContactSet& set, const Vec3& position, const Vec3& gap, Proposal& proposal) const {
  using Rest = Proposal::Rest;
  const bool few = set.contacts.size() <= convergence::kFewContacts;
  const double enough = accuracy::kRestPerGap * gap.norm() + tolerance_.rest;
  TouchedSet touched = touchedNow(set);
  const auto any = [&](auto says) { return std::any_of(touched.begin(), touched.end(), says); };
  const bool resisting = any([](const Touched& now) { return now.friction.acts(); });
  proposal = {};
  proposal.rule = Proposal::Rule::kFelt;
  Vec3 offset = Vec3::Zero();
  AndersonMixing mixing;
  for (int pass = 1;; ++pass) {
    const SolverResult held = firstPass(set, touched, gap, offset);
    proposal.may_raise_energy =
        proposal.may_raise_energy || any([](const Touched& now) { return now.shading_normal.differs(); });
    const Vec3 way = held.point - offset;
    const Vec3 resisted = resisting ? resistedStep(frictionOf(set, touched, held), way, offset, proposal) : way;
    const Vec3 goal = offset + resisted;
    proposal.held = way - resisted;
    proposal.step = toStep(set, goal, held, proposal);
    const Vec3 change = proposal.step - offset;
    const bool repeats = few && proposal.may_raise_energy && settings_.shading != ShadingPasses::kOnce;
    const bool settles = repeats ? change.norm() <= enough : slipsAtOnce(touched, proposal);
    if (!repeats || settles || pass == convergence::kInnerPasses) {
      listActive(touched, held, proposal);
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
  if (proposal.preslides()) {
    springs_ = proposal.springs.crept(step);
    return;
  }
  slip_.length += length;
  slip_.viscous_m += proposal.viscous * length;
  slipping_ = true;
  springs_ = {};
  if (!(proposal.springs.stiffness_N_m > 0)) return;
  const double carried_m = std::max(0.0, proposal.held.norm() - slip_.viscous_m);  // by friction alone
  const double ratio = proposal.springs.stiffness_N_m / felt_N_m_;
  springs_ = proposal.springs.slipped(step, limited(proposal.held, carried_m) / ratio);
}

double SurfaceRules::released_J(const Proposal& proposal) const {
  if (!proposal.preslides()) return 0;
  const double scale = settings_.world_per_device;
  return std::max(0.0, springs_.energy_J(scale) - proposal.springs.crept(proposal.step).energy_J(scale));
}

double SurfaceRules::stiffnessAt(const SurfacePoint& place) const {
  if (plain(place.primitive)) return 1;
  return surfaceOf(place.primitive).stiffness(place.weights);
}

ProxyContact SurfaceRules::describe(const ContactSet& set, const ActiveContact& active) const {
  const Vec3& point = set.contacts[active.contact].point;
  if (plain(active.place.primitive))
    return {point, active.normal, active.multiplier_m, active.place.primitive, 1, 0, false, active.place.weights};
  const Surface surface = surfaceOf(active.place.primitive);
  const SurfaceValue stiffness = surface.read(Quantity::kStiffness);
  const SurfaceFriction friction = SurfaceFriction::of(surface);
  const bool textured = stiffness.texture || friction.fixed.texture;
  const Vec2 texcoord = textured ? surface.texcoord(active.place.weights) : Vec2(Vec2::Zero());
  return {point,
          active.normal,
          active.multiplier_m,
          active.place.primitive,
          std::clamp(stiffness.at(texcoord), 0.0, 1.0),
          std::max(0.0, friction.fixed.at(texcoord)),
          friction.acts(),
          active.place.weights};
}

}  // namespace hl

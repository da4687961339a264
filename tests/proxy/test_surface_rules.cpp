// One proposal under the rules of the surfaces: its step keeps to the true planes and to what friction lets go, and
// what it says about the end of the passes is so.
#include "proxy/surface_rules.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "effect_scenes.h"
#include "geometry/scenes.h"
#include "judge.h"

namespace hl::test_surface_rules {
namespace {

constexpr double kRadius = 1e-3;
constexpr double kK = 1000;

ProxySettings settingsOf() {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.spring_N_m = kK;
  return settings;
}

// A proxy somewhere in a scene, and what touches it there.
struct At {
  At(const Snapshot& snapshot, const ProxySettings& with, const Vec3& place)
      : scene(snapshot), settings(with), tolerance(Tolerances::of(with.radius, snapshot.extent)) {
    goTo(place);
  }
  void goTo(const Vec3& place) {
    position = place;
    gatherContacts(scene, place, tolerance.touching, tolerance.reach, set);
  }
  SurfaceRules rules(bool slipping = false) const {
    return {scene, settings, tolerance, FrictionStart{slipping, {}, kK}};
  }
  Proposal propose(SurfaceRules& by, const Vec3& finger) const {
    Proposal proposal;
    by.propose(set, position, finger - position, proposal);
    return proposal;
  }
  // Without the surfaces' rules.
  Vec3 freeWay(const Vec3& finger) const {
    return nearestAbove({set.planes.begin(), set.planes.size()}, finger - position, tolerance.feasible).point;
  }
  bool isFree(const Vec3& step) const {
    SceneImpact impact;
    return !scene.firstImpact(position, step, tolerance.swept, tolerance.touching, impact);
  }
  double depthBelowPlanes(const Vec3& step) const {
    double deepest = 0;
    for (const Plane& plane : set.planes) deepest = std::max(deepest, plane.offset - plane.normal.dot(step));
    return deepest;
  }

  const SceneAt scene;
  const ProxySettings settings;
  const Tolerances tolerance;
  Vec3 position;
  ContactSet set;
};

// On a floor at y = 0, held down by `depth` and pulled along x by `pull`.
struct OnFloor : At {
  explicit OnFloor(const ProxySettings& with) : OnFloor(with, test::snapshotOf(test::floorModel())) {}
  OnFloor(const ProxySettings& with, std::shared_ptr<const Snapshot> floor)
      : At(*floor, with, Vec3(0.001, Tolerances::of(kRadius, floor->extent).reach, 0.002)),
        snapshot(std::move(floor)) {}
  Vec3 finger(double pull, double depth) const { return position + Vec3(pull, -depth, 0); }

  std::shared_ptr<const Snapshot> snapshot;
};

TEST(SurfaceRules, OnlyASurfaceThatDoesMoreThanHoldOffHasRules) {
  ProxySettings settings = settingsOf();
  EXPECT_FALSE(OnFloor(settings).rules().any(OnFloor(settings).set));
  settings.surfaces.smooth = true;
  EXPECT_TRUE(OnFloor(settings).rules().any(OnFloor(settings).set));
  settings.surfaces = {};
  settings.surfaces.viscosity_Ns_m = 1;
  EXPECT_TRUE(OnFloor(settings).rules().any(OnFloor(settings).set));
}

// |slip| = pull - mu_d depth - (b / K T) |slip|, once the pull is more than mu_s depth.
TEST(SurfaceRules, AFloorLetsTheProxySlipByTheFormula) {
  ProxySettings settings = settingsOf();
  settings.surfaces.static_friction = 0.5;
  settings.surfaces.dynamic_friction = 0.3;
  settings.surfaces.viscosity_Ns_m = 2;
  const OnFloor at(settings);
  const double depth = 0.002;
  for (const double pull : {0.0, 0.0005, 0.00099, 0.00101, 0.003}) {
    SurfaceRules stuck = at.rules(), slipping = at.rules(true);
    const Proposal proposal = at.propose(stuck, at.finger(pull, depth));
    const double slip = std::max(0.0, pull - 0.3 * depth) / (1 + 2 / (kK * settings.period_s));
    EXPECT_NEAR((proposal.step - Vec3(pull > 0.5 * depth ? slip : 0, 0, 0)).norm(), 0, 1e-12) << pull;
    EXPECT_NEAR((at.propose(slipping, at.finger(pull, depth)).step - Vec3(slip, 0, 0)).norm(), 0, 1e-12) << pull;
    EXPECT_EQ(proposal.resistance, Proposal::Resistance::kActs);
    ASSERT_EQ(proposal.active.size(), 1u);
    EXPECT_NEAR(proposal.active[0].multiplier_m, depth, 1e-9);
  }
}

TEST(SurfaceRules, AfterManyProposalsTheRestIsForTheNextTick) {
  ProxySettings settings = settingsOf();
  settings.surfaces.viscosity_Ns_m = 2;
  const OnFloor at(settings);
  SurfaceRules rules = at.rules();
  for (int i = 0; i < convergence::kMaxProposals; ++i) {
    EXPECT_GT(at.propose(rules, at.finger(0.001, 0.001)).step.norm(), 0);
    EXPECT_FALSE(rules.postpones());
  }
  EXPECT_EQ(at.propose(rules, at.finger(0.001, 0.001)).step, Vec3(Vec3::Zero()));
  EXPECT_TRUE(rules.postpones());
}

// What a slip uses up is not there for the next in the same tick: two halves are one.
TEST(SurfaceRules, ASlipInTwoPartsIsAsLongAsOne) {
  ProxySettings settings = settingsOf();
  settings.surfaces.static_friction = settings.surfaces.dynamic_friction = 0.3;
  settings.surfaces.viscosity_Ns_m = 2;
  OnFloor at(settings);
  const Vec3 finger = at.finger(0.003, 0.002), start = at.position;
  SurfaceRules rules = at.rules();
  const Proposal whole = at.propose(rules, finger);
  rules.moved(whole, 0.4 * whole.step);
  at.goTo(at.position + 0.4 * whole.step);
  EXPECT_NEAR((at.position + at.propose(rules, finger).step - start - whole.step).norm(), 0, 1e-12);
}

// A stuck proxy creeps to where its springs balance the pull, |pull - D| = (sigma / K) D, and stays stuck.
TEST(SurfaceRules, AStuckProxyCreepsOnItsSprings) {
  Model floor = test::floorModel();
  floor.materials.resize(1);
  floor.materials[0].static_friction = floor.materials[0].dynamic_friction = 0.5;
  floor.materials[0].presliding_N_m = 3 * kK;
  OnFloor at(settingsOf(), test::snapshotOf(floor));
  SurfaceRules rules = at.rules();
  const Vec3 finger = at.finger(0.0004, 0.002);
  const Proposal first = at.propose(rules, finger);
  EXPECT_TRUE(first.preslides());
  EXPECT_NEAR(first.step.x(), 0.0001, 1e-12);
  rules.moved(first, first.step);
  at.goTo(at.position + first.step);
  EXPECT_EQ(rules.springs().stretch_m, first.step);
  EXPECT_EQ(rules.springs().stiffness_N_m, 3 * kK);
  EXPECT_FALSE(rules.hasSlipped());
  EXPECT_LE(at.propose(rules, finger).step.norm(), 1e-12) << "balanced";
}

// A shallow pit or a hill of triangles, with normals that turn from vertex to vertex.
Model bumpy(test::Random& random) {
  const double k = random.uniform(100, 400), height = random.uniform(-1, 1) * 2e-3, lean = random.uniform(0, 0.4);
  Model model = judge::grid(12, 12, [&](double u, double v) {
    const double x = 0.02 * (u - 0.5), z = 0.02 * (0.5 - v);
    return Vec3(x, height * std::cos(k * x) * std::cos(k * z), z);
  });
  for (std::size_t i = 0; i < model.positions.size(); ++i)
    model.normals.push_back((Vec3::UnitY() + lean * random.inCube(1)).normalized());
  return model;
}

// A proxy that rests on it, where the finger has pressed it without any rules.
struct OnBumps {
  explicit OnBumps(std::uint64_t seed) : random(seed), snapshot(test::snapshotOf(bumpy(random))) {
    const Vec3 above(random.uniform(-0.007, 0.007), 0.02, random.uniform(-0.007, 0.007));
    ProxyState state = startProxy(*snapshot, settingsOf(), above);
    press = Vec3(above.x(), 0, above.z()) + random.inCube(0.003) - Vec3(0, 0.002, 0);
    tick(state, *snapshot, settingsOf(), press);
    position = state.position;
  }
  Vec3 finger() { return press + random.inCube(0.002); }

  test::Random random;
  std::shared_ptr<const Snapshot> snapshot;
  Vec3 press, position;
};

RC_GTEST_PROP(SurfaceRules, UnderFrictionAStepIsAPartOfTheFreeWay, (std::uint64_t seed)) {
  OnBumps bumps(seed);
  ProxySettings settings = settingsOf();
  settings.surfaces.static_friction = bumps.random.uniform(0, 1);
  settings.surfaces.dynamic_friction = bumps.random.uniform(0, 1) * *settings.surfaces.static_friction;
  settings.surfaces.viscosity_Ns_m = bumps.random.uniform(0, 3);
  const At at(*bumps.snapshot, settings, bumps.position);
  const Vec3 finger = bumps.finger(), way = at.freeWay(finger);
  SurfaceRules rules = at.rules(bumps.random.below(2) == 0);
  const Proposal proposal = at.propose(rules, finger);
  RC_ASSERT(!proposal.may_raise_energy);
  RC_ASSERT(proposal.step.norm() <= way.norm() * (1 + 1e-12));
  RC_ASSERT(proposal.step.cross(way).norm() <= 1e-12 * way.squaredNorm());
  RC_ASSERT(proposal.step.dot(way) >= 0);
  RC_ASSERT((proposal.step + proposal.held - way).norm() <= 1e-12 * way.norm());
}

RC_GTEST_PROP(SurfaceRules, AShadedStepStaysAboveTheTruePlanes, (std::uint64_t seed)) {
  OnBumps bumps(seed);
  ProxySettings settings = settingsOf();
  settings.surfaces.smooth = true;
  if (bumps.random.below(3) == 0) settings.shading = ShadingPasses::kOnce;
  if (bumps.random.below(3) == 0) settings.surfaces.static_friction = settings.surfaces.dynamic_friction = 0.3;
  const At at(*bumps.snapshot, settings, bumps.position);
  SurfaceRules rules = at.rules();
  for (int i = 0; i < 8; ++i) {
    const Proposal proposal = at.propose(rules, bumps.finger());
    RC_ASSERT(at.depthBelowPlanes(proposal.step) <= at.tolerance.feasible);
    for (const ActiveContact& active : proposal.active) {
      RC_ASSERT(std::abs(active.normal.norm() - 1) <= 1e-12);
      RC_ASSERT(std::acos(std::min(1.0, active.normal.dot(active.place.normal))) <= accuracy::kShadingLimit_rad + 1e-7);
    }
  }
}

// Whether each contact of one place is over the same face at another; those that it has moved away from too.
bool overTheSameFaces(const At& at, const ContactSet& before) {
  return std::all_of(before.contacts.begin(), before.contacts.end(), [&](const Contact& contact) {
    return contact.feature == Feature::kFace &&
           at.scene.closest(contact.primitive, at.position).feature == Feature::kFace;
  });
}

// Whether nothing touches that did not before.
bool nothingNew(const At& at, const ContactSet& before) {
  return std::all_of(at.set.contacts.begin(), at.set.contacts.end(), [&](const Contact& contact) {
    const auto same = [&](const Contact& other) { return other.primitive == contact.primitive; };
    return std::any_of(before.contacts.begin(), before.contacts.end(), same);
  });
}

struct Seen {
  int settles = 0, stays = 0, goes_on = 0;
};

// Goes along one proposal, where its way is free, and looks again: what it said of its end must be so.
void goAlong(OnBumps& bumps, const ProxySettings& settings, Seen& seen) {
  At at(*bumps.snapshot, settings, bumps.position);
  const Vec3 finger = bumps.finger();
  SurfaceRules rules = at.rules();
  const Proposal proposal = at.propose(rules, finger);
  const ContactSet before = at.set;
  if (proposal.rest == Proposal::Rest::kGoesOn) ++seen.goes_on;
  if (proposal.rest == Proposal::Rest::kGoesOn || !at.isFree(proposal.step)) return;
  rules.moved(proposal, proposal.step);
  at.goTo(at.position + proposal.step);
  const bool stays = proposal.rest == Proposal::Rest::kStays, same = overTheSameFaces(at, before);
  EXPECT_TRUE(same || !stays) << "every contact is on the same face";
  if (!same) return;
  EXPECT_TRUE(nothingNew(at, before));
  ++(stays ? seen.stays : seen.settles);
  const double enough = accuracy::kRestPerGap * (finger - at.position).norm() + at.tolerance.rest;
  EXPECT_LE(at.propose(rules, finger).step.norm(), 4 * enough) << "another look finds what the last pass found";
}

TEST(SurfaceRules, WhatSettlesUnderShadingOrFrictionMovesNoMore) {
  Seen shaded, rubbed;
  ProxySettings smooth = settingsOf(), rough = settingsOf();
  smooth.surfaces.smooth = true;
  rough.surfaces.static_friction = rough.surfaces.dynamic_friction = 0.4;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    OnBumps bumps(seed);
    goAlong(bumps, smooth, shaded);
    goAlong(bumps, rough, rubbed);
  }
  EXPECT_GT(shaded.stays, 100);
  EXPECT_GT(rubbed.stays, 1000);
  EXPECT_GT(shaded.goes_on, 10) << "nor does it always settle";
}

TEST(SurfaceRules, AContactIsReportedWithItsStiffnessAndFriction) {
  ProxySettings settings = settingsOf();
  settings.surfaces.static_friction = 0.4;
  settings.surfaces.stiffness = 1.7;
  const OnFloor at(settings);
  SurfaceRules rules = at.rules();
  const Proposal proposal = at.propose(rules, at.finger(0.001, 0.002));
  ASSERT_EQ(proposal.active.size(), 1u);
  const ProxyContact contact = rules.describe(at.set, proposal.active[0]);
  EXPECT_EQ(contact.stiffness, 1) << "within 0..1";
  EXPECT_EQ(contact.static_friction, 0.4);
  EXPECT_TRUE(contact.holds_tangentially);
  EXPECT_EQ(contact.normal, Vec3(Vec3::UnitY()));
  EXPECT_EQ(rules.stiffnessAt(proposal.active[0].place), 1);
}

}  // namespace
}  // namespace hl::test_surface_rules

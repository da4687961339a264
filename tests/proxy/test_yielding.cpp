// Surfaces that yield, touched in several places: an object yields as a whole, and the force that its mesh was computed
// for counts once. Closed forms of docs/tissue.md, with meshes at rest.
#include "proxy/yielding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "effect_scenes.h"
#include "guard/realtime_guard.h"
#include "proxy/proxy.h"

namespace hl::test_yielding {
namespace {

constexpr double kK = 1000, kRadius = 0.001, kC = 0.002;
const double kDiagonal = std::sqrt(0.5);

// One shape of an object that its client says to yield.
struct Part {
  Model model;
  std::uint32_t object = 1;
  Compliance compliance{kC, 0, Vec3::Zero()};
};

std::shared_ptr<const Snapshot> sceneOf(std::vector<Part> parts) {
  std::vector<Instance> instances;
  for (Part& part : parts) {
    Instance instance;
    instance.shape = makeShape(std::move(part.model), HierarchyKind::kNone);
    instance.surfaces = surfacesOf(instance.shape);
    instance.key = instances.size() + 1;
    instance.session = 1;
    instance.object = part.object;
    instance.compliance = std::make_shared<const ComplianceMotion>(part.compliance);
    instances.push_back(std::move(instance));
  }
  return makeSnapshot(std::move(instances));
}

// A plane through the x axis, whose normal is turned from y by `degrees` about it.
Vec3 normalOf(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {0, std::cos(angle), std::sin(angle)};
}
void addPlane(double degrees, Model& model) {
  const Vec3 normal = normalOf(degrees), across = Vec3::UnitX().cross(normal);
  test::addRectangle(model, Vec3(-0.1, 0, 0) - 0.1 * across, {0.2, 0, 0}, 0.2 * across, normal);
  for (Material& material : model.materials) material.smooth = false;
}
Model planes(const std::vector<double>& degrees) {
  Model model;
  for (const double one : degrees) addPlane(one, model);
  return model;
}

// A mesh that slopes by `slope` toward its middle: a pit of as many faces; of two a valley along x, of one a floor.
Model pit(std::uint32_t faces, double slope) {
  const double degrees = std::atan(slope) * 180 / std::numbers::pi;
  if (faces == 1) return planes({0});
  if (faces == 2) return planes({-degrees, degrees});
  Model model;
  model.positions.push_back(Vec3::Zero());
  for (std::uint32_t i = 0; i < faces; ++i) {
    const double angle = 2 * std::numbers::pi * i / faces;
    model.positions.push_back(0.04 * Vec3(std::cos(angle), slope, std::sin(angle)));
    model.triangles.push_back({0, 1 + (i + 1) % faces, 1 + i});
  }
  return model;
}

/// A finger, moved by 1/5 of the radius a tick at most.
class Touch {
 public:
  explicit Touch(std::shared_ptr<const Snapshot> scene, MaterialOverride surfaces = {}) : scene_(std::move(scene)) {
    settings_.radius = kRadius;
    settings_.spring_N_m = kK;
    settings_.surfaces = surfaces;
    state_ = startProxy(SceneAt(*scene_, 0), settings_, finger_);
    report_.target = finger_;
  }

  void goTo(const Vec3& finger) {
    const Vec3 from = finger_;
    const int steps = std::max(1, static_cast<int>(std::ceil((finger - from).norm() / (0.2 * kRadius))));
    for (int i = 1; i <= steps; ++i) step(from + static_cast<double>(i) / steps * (finger - from));
  }
  void stay(int ticks = 60) {
    for (int i = 0; i < ticks; ++i) step(finger_);
  }
  void step(const Vec3& finger) {
    now_ns_ += 1'000'000;
    const Vec3 way = finger - finger_;
    got_J_ += (force_N() - 0.5 * kK * state_.stiffness * way).dot(way);  // the spring, while nothing else moves
    finger_ = finger;
    report_ = tick(state_, SceneAt(*scene_, now_ns_), settings_, finger);
  }
  void show(std::shared_ptr<const Snapshot> scene) { scene_ = std::move(scene); }

  Vec3 force_N() const { return kK * (report_.target - finger_); }
  Vec3 e() const { return state_.position - finger_; }
  std::size_t contacts() const { return report_.contacts.size(); }
  const TickReport& report() const { return report_; }
  const ProxyState& state() const { return state_; }
  std::int64_t now_ns() const { return now_ns_; }
  /// What the hand has got since the last call.
  double takeGot_J() { return std::exchange(got_J_, 0); }

 private:
  std::shared_ptr<const Snapshot> scene_;
  ProxySettings settings_;
  Vec3 finger_ = Vec3(0, 0.02, 0);
  std::int64_t now_ns_ = 0;
  double got_J_ = 0;
  ProxyState state_;
  TickReport report_;
};

Touch pressed(std::shared_ptr<const Snapshot> scene, const Vec3& finger, const MaterialOverride& surfaces = {}) {
  Touch touch(std::move(scene), surfaces);
  touch.goTo({finger.x(), 0.01, finger.z()});
  touch.goTo(finger);
  touch.stay();
  return touch;
}

// F = (e + C F_k) / (1/K + C)
Vec3 seriesOf(const Vec3& e, double compliance_m_N, const Vec3& force_N) {
  return (e + compliance_m_N * force_N) / (1 / kK + compliance_m_N);
}

// However many faces the proxy rests on, and with friction too.
TEST(Yielding, TheForceOfAMeshCountsOnceHoweverManyOfItsFacesAreTouched) {
  const Vec3 force_N(0, 0.3, 0);
  for (const auto& [faces, contacts] : {std::pair(1u, 1u), {2u, 2u}, {3u, 3u}, {4u, 3u}, {6u, 3u}}) {
    for (const double friction : {0., 0.5}) {
      MaterialOverride surfaces;
      surfaces.static_friction = surfaces.dynamic_friction = friction;
      const auto scene = sceneOf({{pit(faces, 0.03), 1, {kC, 0, force_N}}});
      const Touch touch = pressed(scene, {0, -0.001, 0}, surfaces);
      EXPECT_GE(touch.contacts(), std::min(contacts, 2u)) << faces;
      EXPECT_NEAR((touch.force_N() - seriesOf(touch.e(), kC, force_N)).norm(), 0, 1e-6)
          << faces << " faces, " << touch.contacts() << " contacts, friction " << friction;
    }
  }
}

// Two items of an object, as those that differ in material, are one object.
TEST(Yielding, TheForceOfAnObjectCountsOnceHoweverManyOfItsPartsAreTouched) {
  const Compliance compliance{kC, kC, Vec3(0.05, 0.3, 0.1)};
  const Touch touch = pressed(sceneOf({{planes({-30}), 1, compliance}, {planes({30}), 1, compliance}}), {0, -0.001, 0});
  ASSERT_EQ(touch.contacts(), 2u);
  EXPECT_NEAR((touch.force_N() - seriesOf(touch.e(), kC, compliance.computed_for_N)).norm(), 0, 1e-9);
}

// One contact, two, and one again: no step of the force is more than that of the finger makes.
TEST(Yielding, TheForceDoesNotJumpWhereTheNumberOfContactsChanges) {
  Touch touch = pressed(sceneOf({{pit(2, 0.03), 1, {kC, 0, Vec3(0, 0.3, 0)}}}), {0, -0.001, -0.002});
  std::size_t fewest = 9, most = 0;
  constexpr double kStep = 1e-6;
  for (double z = -0.002; z < 0.002; z += kStep) {
    const Vec3 before_N = touch.force_N();
    touch.step({0, -0.001, z});
    ASSERT_LE((touch.force_N() - before_N).norm(), 2 * kK * kStep) << z;
    fewest = std::min(fewest, touch.contacts());
    most = std::max(most, touch.contacts());
  }
  EXPECT_EQ(fewest, 1u);
  EXPECT_EQ(most, 2u);
}

// Faces at angles: without friction an object yields by its normal compliance, as a floor does, however it is given.
TEST(Yielding, WhatFacesPressTogetherYieldsAsOneFaceDoes) {
  for (const double degrees : {0., 1., 22.5, 45., 70.}) {
    const std::vector<double> both{-degrees, degrees};
    MaterialOverride by_material;
    by_material.compliance_m_N = kC;
    const Vec3 finger(0, -0.001, 0);
    const std::array touches{
        pressed(sceneOf({{planes(both), 1, {kC, 0, Vec3::Zero()}}}), finger),
        pressed(sceneOf({{planes(both), 1, {kC, kC, Vec3::Zero()}}}), finger),
        pressed(sceneOf({{planes(both), 1, {0, 0, Vec3::Zero()}}}), finger, by_material),
        pressed(sceneOf({{planes({-degrees}), 1}, {planes({degrees}), 2}}), finger),
    };
    for (const Touch& touch : touches) {
      EXPECT_EQ(touch.contacts(), degrees == 0 ? 1u : 2u);
      EXPECT_NEAR((touch.force_N() - seriesOf(touch.e(), kC, Vec3::Zero())).norm(), 0, 1e-9) << degrees;
    }
  }
}

// Along the faces it yields by the tangential compliance: c^2 C_n + (1 - c^2) C_t, c the cosine of the pull.
TEST(Yielding, AlongFacesItYieldsByTheTangentialCompliance) {
  MaterialOverride sticky;
  sticky.static_friction = sticky.dynamic_friction = 5;
  constexpr double kTangential = 0.0005;
  for (const double degrees : {0., 22.5, 45.}) {
    Touch touch =
        pressed(sceneOf({{planes({-degrees, degrees}), 1, {kC, kTangential, Vec3::Zero()}}}), {0, -0.001, 0}, sticky);
    touch.goTo({0.001, -0.001, 0});
    touch.stay();
    const Vec3 e = touch.e();
    EXPECT_NEAR(e.x(), -0.001, 1e-9) << degrees;
    const double cosine2 = e.y() * e.y() / e.squaredNorm();
    const double compliance_m_N = cosine2 * kC + (1 - cosine2) * kTangential;
    EXPECT_NEAR((touch.force_N() - seriesOf(e, compliance_m_N, Vec3::Zero())).norm(), 0, 1e-6) << degrees;
  }
}

// The contacts that are reported have the force that is felt: s is their mean by shares.
TEST(Yielding, TheStiffnessIsTheMeanOfTheContactsByTheirShares) {
  const auto scene =
      sceneOf({{planes({-60}), 1, {0.001, 0, Vec3::Zero()}}, {planes({20}), 2, {0.004, 0, Vec3(0, 0.1, 0)}}});
  const Touch touch = pressed(scene, {0, -0.001, 0});
  ASSERT_EQ(touch.contacts(), 2u);
  double shares = 0, mean = 0;
  Vec3 rest = Vec3::Zero();
  for (const ProxyContact& contact : touch.report().contacts) {
    const double s = 1 / (1 + kK * (contact.primitive.instance == 0 ? 0.001 : 0.004));
    shares += contact.multiplier_m;
    mean += contact.multiplier_m * s;
    rest += contact.multiplier_m * contact.normal;
  }
  EXPECT_NEAR((touch.force_N() - kK * mean / shares * rest).norm(), 0, 1e-9);
}

// Of two objects each force counts: where both meshes are at rest, the force is that of the meshes alone, K e.
TEST(Yielding, OfTwoObjectsEachForceCountsOnce) {
  for (const double degrees : {20., 45., 70.}) {
    const double each_N = 0.4;
    const Vec3 left_N = each_N * normalOf(-degrees), right_N = each_N * normalOf(degrees), both_N = left_N + right_N;
    const auto scene = sceneOf({{planes({-degrees}), 1, {kC, kC, left_N}}, {planes({degrees}), 2, {kC, kC, right_N}}});
    const double rest_m = kRadius / std::cos(degrees * std::numbers::pi / 180);
    const Touch at_rest = pressed(scene, {0, rest_m - both_N.y() / kK, 0});
    ASSERT_EQ(at_rest.contacts(), 2u);
    EXPECT_NEAR((at_rest.force_N() - both_N).norm(), 0, 1e-9) << degrees;
    const Touch deeper = pressed(scene, {0, rest_m - 0.002, 0});
    EXPECT_NEAR((deeper.force_N() - seriesOf(deeper.e(), kC, both_N)).norm(), 0, 1e-9) << degrees;
  }
}

// v = left * normal(-degrees) + right * normal(degrees), in the plane of both.
std::pair<double, double> alongBoth(double degrees, const Vec3& v) {
  const Vec3 n = normalOf(degrees);
  const double sum = v.y() / n.y(), difference = v.z() / n.z();
  return {(sum - difference) / 2, (sum + difference) / 2};
}

// Objects that yield differently share the pull: F = K sum s_i (e_i + C_i F_ki).
TEST(Yielding, ObjectsThatYieldDifferentlyAddTheirPulls) {
  struct Case {
    double left_m_N, right_m_N, left_N, right_N;
  };
  for (const double degrees : {30., 45., 60.}) {
    const Vec3 left = normalOf(-degrees), right = normalOf(degrees);
    for (const Case& given : {Case{0.001, 0.004, 0.3, 0.2}, Case{0.001, 0.004, 0.3, 0}, Case{0, 0.004, 0, 0.4}}) {
      const Vec3 left_N = given.left_N * left, right_N = given.right_N * right;
      const auto scene = sceneOf({{planes({-degrees}), 1, {given.left_m_N, given.left_m_N, left_N}},
                                  {planes({degrees}), 2, {given.right_m_N, given.right_m_N, right_N}}});
      const Touch touch = pressed(scene, {0, -0.001, 0});
      ASSERT_EQ(touch.contacts(), 2u);
      const auto [e_left, e_right] = alongBoth(degrees, touch.e());
      const Vec3 expected_N = (e_left * left + given.left_m_N * left_N) / (1 / kK + given.left_m_N) +
                              (e_right * right + given.right_m_N * right_N) / (1 / kK + given.right_m_N);
      EXPECT_NEAR((touch.force_N() - expected_N).norm(), 0, 1e-6) << degrees;
      EXPECT_GE(touch.state().ledger.tank_J, 0);
    }
  }
}

// A client that moves a soft wall beside a hard one by the force that it feels. Both settle as on their own where they
// are at right angles, from the first frame on if C is exact: f = K e / (1 + K C_t). So no frame makes the hard one
// push, and nothing flutters.
TEST(Yielding, AWallThatAClientPressesSettlesBesideAHardOne) {
  constexpr double kTrue = 0.01;
  constexpr std::int64_t kFrame_ns = 33'000'000;
  const Vec3 soft = normalOf(45), finger(0, -0.001, 0);
  const double depth_m = (kRadius + 0.001 * kDiagonal);
  for (const double given : {0.75, 1., 2.}) {
    std::vector<Part> parts{{planes({-45}), 1, {0, 0, Vec3::Zero()}},
                            {planes({45}), 2, {given * kTrue, given * kTrue, Vec3::Zero()}}};
    const auto first = sceneOf(parts);
    std::vector<Instance> instances(first->instances.begin(), first->instances.end());
    Touch touch(first);
    touch.goTo({0, 0.01, 0});
    touch.goTo(finger);
    for (std::uint64_t frame = 2; frame < 60; ++frame) {
      const auto [by_hard, by_soft] = alongBoth(45, touch.force_N());
      Instance& moved = instances[1];
      const std::int64_t begin_ns = touch.now_ns() + 1, end_ns = begin_ns + kFrame_ns / 2;
      moved.motion = moved.motion.then({Mat3::Identity(), -kTrue * by_soft * soft}, begin_ns, end_ns);
      moved.compliance = std::make_shared<const ComplianceMotion>(
          moved.compliance->then({given * kTrue, given * kTrue, by_soft * soft}, begin_ns, end_ns));
      touch.show(makeSnapshot(instances, "frame", frame, 0));
      touch.stay(kFrame_ns / 1'000'000);
    }
    const auto [by_hard, by_soft] = alongBoth(45, touch.force_N());
    EXPECT_NEAR(by_hard, kK * depth_m, 1e-3) << given;
    EXPECT_NEAR(by_soft, kK * depth_m / (1 + kK * kTrue), 1e-3) << given;
  }
}

// A slot of a hard and a soft wall, whether its mesh was computed for a force or not, with a finger that goes round in
// it without ceasing: what the hand gets is what the tank held, however long it goes on.
TEST(Yielding, AFingerThatGoesRoundBetweenAHardAndASoftWallGetsNothing) {
  for (const double degrees : {30., 60., 75.}) {
    for (const double sense : {1., -1.}) {
      for (const double force_N : {0., 0.3}) {
        const auto scene = sceneOf({{planes({-degrees}), 1, {0, 0, Vec3::Zero()}},
                                    {planes({degrees}), 2, {kC, kC, force_N * normalOf(degrees)}}});
        const double rest_m = kRadius / std::cos(degrees * std::numbers::pi / 180);
        const auto finger = [&](int i) {
          const double angle = sense * 2 * std::numbers::pi * i / 100;
          return Vec3(0, rest_m - 0.004 + 0.001 * std::sin(angle), 0.001 * std::cos(angle));
        };
        Touch touch = pressed(scene, finger(0));
        const auto got_J = [&](int rounds) {
          touch.takeGot_J();
          for (int i = 1; i <= 100 * rounds; ++i) touch.step(finger(i));
          return touch.takeGot_J();
        };
        EXPECT_LE(got_J(500), kTankFull_J) << degrees << " " << sense << " " << force_N;
        EXPECT_LE(got_J(100), 1e-6) << degrees << " " << sense << " " << force_N;
      }
    }
  }
}

TEST(Yielding, TicksAllocateNothing) {
  Touch touch = pressed(sceneOf({{pit(3, 0.03), 1, {kC, 0, Vec3(0, 0.3, 0)}}, {planes({45}), 2}}), {0, -0.001, 0});
  const RealtimeGuard guard;
  touch.goTo({0.001, -0.002, 0.001});
}

}  // namespace
}  // namespace hl::test_yielding

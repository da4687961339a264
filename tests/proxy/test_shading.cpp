// Force shading: the paper's section 4 and Figure 6, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "effect_scenes.h"
#include "proxy/patch.h"
#include "proxy/proxy.h"

namespace hl::test_shading {
namespace {

using test::prism;

constexpr double kDegree = M_PI / 180;
constexpr double kAlpha = M_PI / 10;  // half the angle of a face of the 10-gon
const double kInner = std::cos(kAlpha);

ProxySettings settingsOf(double radius, bool smooth, ShadingPasses passes = ShadingPasses::kConverged) {
  ProxySettings settings;
  settings.radius = radius;
  settings.surfaces.smooth = smooth;
  settings.shading = passes;
  settings.ledger = LedgerMode::kReport;
  return settings;
}

Vec3 at(double rho, double theta) { return {rho * std::cos(theta), rho * std::sin(theta), 0.1}; }

// From outside, straight in to the middle of face 0.
ProxyState pressed(const Snapshot& scene, const ProxySettings& settings, double rho) {
  ProxyState state = startProxy(scene, settings, at(1.5, 0));
  tick(state, scene, settings, at(rho, 0));
  return state;
}

double angleOf(const Vec3& d) { return std::atan2(d.y(), d.x()); }

double wrapped(double angle) { return std::remainder(angle, 2 * M_PI); }

// C23, Figure 6a: |d| = r_i + r_p - rho cos(delta) along the face normal until delta* = asin(R sin(alpha) / rho), where
// the direction jumps by 2 alpha.
TEST(Shading, FlatTenGonJumpsThirtySixDegreesWhereTheFormulaSays) {
  const auto scene = prism();
  const double rho = 0.9, radius = 0.05, step = 0.05 * kDegree;
  const ProxySettings settings = settingsOf(radius, false);
  const double jump_at = std::asin(std::sin(kAlpha) / rho);
  ProxyState state = pressed(*scene, settings, rho);
  int jumps = 0;
  double before = 0;
  for (int i = 1; i * step < 2 * kAlpha; ++i) {
    const Vec3 finger = at(rho, i * step);
    tick(state, *scene, settings, finger);
    const Vec3 d = state.position - finger;
    const double face = i * step <= jump_at ? 0 : 2 * kAlpha;
    EXPECT_NEAR(wrapped(angleOf(d) - face), 0, 1e-6);
    EXPECT_NEAR(d.norm(), kInner + radius - rho * std::cos(i * step - face), 1e-6);
    if (std::abs(angleOf(d) - before) > 0.1) {
      ++jumps;
      EXPECT_NEAR(angleOf(d) - before, 36 * kDegree, 1e-6);
    }
    before = angleOf(d);
  }
  EXPECT_EQ(jumps, 1);
}

// C24, Figure 6b: the fixed point of the two passes. Away from the corners the contact lies at
// t = rho r_i sin(delta) / (rho cos(delta) - r_p) along the face, and the force is radial there.
TEST(Shading, ConvergedTenGonIsTheClosedForm) {
  const auto scene = prism();
  const double rho = 0.9, radius = 0.05, step = 0.127 * kDegree;
  const ProxySettings settings = settingsOf(radius, true);
  ProxyState state = pressed(*scene, settings, rho);
  double worst_direction = 0, worst_distance = 0, worst_proxy_step = 0;
  Vec3 last = state.position;
  for (int i = 1; i * step < 2 * M_PI; ++i) {
    const double theta = i * step;
    const Vec3 finger = at(rho, theta);
    tick(state, *scene, settings, finger);
    worst_proxy_step = std::max(worst_proxy_step, (state.position - last).norm() / (rho * step));
    last = state.position;
    const Vec3 d = state.position - finger;
    const double delta = std::remainder(theta, 2 * kAlpha);
    const double to_corner = kAlpha - std::asin(radius * std::sin(kAlpha) / rho);
    if (std::abs(delta) > to_corner) continue;
    const double t = rho * kInner * std::sin(delta) / (rho * std::cos(delta) - radius);
    const double direction = theta - delta + std::atan(t / kInner);
    const double distance = std::hypot(kInner + radius - rho * std::cos(delta), t - rho * std::sin(delta));
    worst_direction = std::max(worst_direction, std::abs(wrapped(angleOf(d) - direction)));
    worst_distance = std::max(worst_distance, std::abs(d.norm() - distance));
  }
  EXPECT_LE(worst_direction, 1e-6);
  EXPECT_LE(worst_distance, 1e-6);
  EXPECT_LE(worst_proxy_step, 1.3);
}

// On the arc about a corner the shaded normal is the corner's: the force keeps its direction.
TEST(Shading, ConvergedCornerKeepsTheCornersNormal) {
  const auto scene = prism();
  const double rho = 0.9, radius = 0.05;
  const ProxySettings settings = settingsOf(radius, true);
  ProxyState state = pressed(*scene, settings, rho);
  const double half = std::asin(radius * std::sin(kAlpha) / rho);
  for (double theta = 0; theta < kAlpha + half; theta += 0.02 * kDegree) {
    const Vec3 finger = at(rho, theta);
    tick(state, *scene, settings, finger);
    if (std::abs(theta - kAlpha) > half) continue;
    const double psi = std::asin(rho * std::sin(theta - kAlpha) / radius);
    const Vec3 corner = at(1, kAlpha);
    const Vec3 expected = corner + radius * Vec3(std::cos(kAlpha + psi), std::sin(kAlpha + psi), 0);
    EXPECT_NEAR((state.position - expected).norm(), 0, 1e-6) << theta;
    EXPECT_NEAR(angleOf(state.position - finger), kAlpha, 1e-6);
  }
}

// Wherever the finger goes, a hundredth of a radian a tick: the contacts reported hold the proxy, proxy - finger = sum
// lambda n, and looking again moves nothing.
TEST(Shading, TheContactsReportedHoldTheProxyAndAnotherTickMovesNothing) {
  const auto scene = prism(24);
  const ProxySettings settings = settingsOf(0.02, true);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(0, 1);
  double theta = 0;
  ProxyState state = pressed(*scene, settings, 0.9);
  for (int i = 0; i < 5000; ++i) {
    theta += 0.02 * (u(random) - 0.5);
    const Vec3 finger = at(0.85 + 0.1 * u(random), theta);
    const TickReport report = tick(state, *scene, settings, finger);
    Vec3 held = state.position - finger;
    const double gap = held.norm();
    for (const ProxyContact& contact : report.contacts) held -= contact.multiplier_m * contact.normal;
    EXPECT_LE(held.norm(), 1e-6 * gap) << i;
    const Vec3 before = state.position;
    tick(state, *scene, settings, finger);
    EXPECT_LE((state.position - before).norm(), 1e-7 * gap) << i;
  }
}

// One two-pass a tick, as the paper does it, at 0.1 m/s, 1 kHz and R = 50 mm: 0.127 degrees a tick.
TEST(Shading, OncePerTickStaysWithinAThirdOfADegree) {
  const auto scene = prism();
  const double rho = 0.9, radius = 0.05, step = 0.127 * kDegree;
  const ProxySettings once = settingsOf(radius, true, ShadingPasses::kOnce);
  const ProxySettings converged = settingsOf(radius, true);
  ProxyState a = pressed(*scene, once, rho), b = pressed(*scene, converged, rho);
  double worst = 0, off_surface = 0;
  for (int i = 1; i * step < 2 * M_PI; ++i) {
    const Vec3 finger = at(rho, i * step);
    tick(a, *scene, once, finger);
    tick(b, *scene, converged, finger);
    if (i > 30) worst = std::max(worst, std::abs(wrapped(angleOf(a.position - finger) - angleOf(b.position - finger))));
    double nearest = 1e9;
    for (const Primitive& primitive : scene->shape().primitives)
      nearest = std::min(nearest, closestPoint(primitive, a.position).distance);
    off_surface = std::max(off_surface, std::abs(nearest - radius));
  }
  EXPECT_LE(worst, 0.3 * kDegree);
  EXPECT_LE(off_surface, 1e-9);
}

// C21: on a plane whose normals lean by beta the proxy runs D tan(beta) ahead, and one pass leaves sin^2(beta) of the
// error.
TEST(Shading, LeaningNormalsOnAPlane) {
  const double beta = 20 * kDegree, depth = 0.002;
  const auto scene = test::snapshotOf(test::floorModel({std::sin(beta), std::cos(beta), 0}));
  const Vec3 finger(0, 0.001 - depth, 0.01);
  ProxySettings settings = settingsOf(0.001, true);
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0.01});
  const TickReport report = tick(state, *scene, settings, finger);
  EXPECT_NEAR(state.position.x(), depth * std::tan(beta), 1e-9);
  EXPECT_NEAR(state.position.y(), 0.001, 1e-9);
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_NEAR(report.contacts[0].multiplier_m, depth / std::cos(beta), 1e-9);

  settings.shading = ShadingPasses::kOnce;
  state = startProxy(*scene, settings, {0, 0.01, 0.01});
  double error = depth * std::tan(beta);
  for (int i = 0; i < 6; ++i) {
    tick(state, *scene, settings, finger);
    const double left = depth * std::tan(beta) - state.position.x();
    EXPECT_NEAR(left / error, std::sin(beta) * std::sin(beta), 1e-3) << i;
    error = left;
  }
}

// A finger that goes straight up from a shaded surface takes the proxy along, whether the normals lean by a rounding or
// by degrees, and however slowly it goes.
TEST(Shading, AFingerThatLiftsOffIsFollowed) {
  for (const double lean : {0.0, 1e-16, 1e-9, 1e-3, 20 * kDegree}) {
    const auto scene = test::snapshotOf(test::floorModel({std::sin(lean), std::cos(lean) * (1 - 1e-16), 0}));
    for (const double step : {1e-6, 4e-5, 3e-3}) {
      const ProxySettings settings = settingsOf(0.001, true);
      ProxyState state = startProxy(*scene, settings, {0, 0.01, 0.01});
      for (int i = 0; i < 20; ++i) tick(state, *scene, settings, {0, 0.0005, 0.01});
      Vec3 finger(state.position.x(), state.position.y() - 2 * step, 0.01);
      for (int i = 0; i < 10; ++i) {
        finger.y() += step;
        tick(state, *scene, settings, finger);
      }
      EXPECT_EQ(state.position, finger) << lean << ' ' << step;
    }
  }
}

TEST(Shading, UnusableNormalsGiveTheTruePlane) {
  for (const Vec3& normal : {Vec3(0, -1, 0), Vec3(0, 0, 0), Vec3(NAN, 0, 0), Vec3(0.9, -0.1, 0)}) {
    Model model = test::floorModel();
    std::fill(model.normals.begin(), model.normals.end(), normal);
    const auto scene = test::snapshotOf(std::move(model));
    const ProxySettings settings = settingsOf(0.001, true);
    ProxyState state = startProxy(*scene, settings, {0, 0.01, 0.01});
    tick(state, *scene, settings, {0, -0.001, 0.01});
    EXPECT_NEAR((state.position - Vec3(0, 0.001, 0.01)).norm(), 0, 1e-9) << normal.transpose();
  }
}

TEST(Shading, TheAngleToTheTrueNormalIsLimited) {
  const double beta = 70 * kDegree;
  const auto scene = test::snapshotOf(test::floorModel({std::sin(beta), std::cos(beta), 0}));
  const ProxySettings settings = settingsOf(0.001, true);
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0.01});
  tick(state, *scene, settings, {0, -0.001, 0.01});
  EXPECT_NEAR(state.position.x(), 0.002 * std::tan(accuracy::kShadingLimit_rad), 1e-9);
}

// C22: two shaded cylinders side by side: the proxy rests in the cusp, r from both, pushed by both shaded normals.
TEST(Shading, TwoShadedCylindersHoldTheProxyInTheCusp) {
  Model model;
  for (const double x : {-1.0, 1.0}) {
    const auto part = prism(40);
    const auto base = static_cast<std::uint32_t>(model.positions.size());
    for (const Vec3& p : part->shape().model.positions) model.positions.push_back(p + x * Vec3::UnitX());
    model.normals.insert(model.normals.end(), part->shape().model.normals.begin(), part->shape().model.normals.end());
    for (const auto& t : part->shape().model.triangles)
      model.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  const auto scene = test::snapshotOf(std::move(model));
  ProxySettings settings = settingsOf(0.1, true);
  settings.work_cap = kNoWorkCap;  // the scene has no hierarchy
  ProxyState state = startProxy(*scene, settings, {0, 1.5, 0.1});
  const Vec3 finger(0.01, 0.1, 0.1);
  const TickReport report = tick(state, *scene, settings, finger);
  EXPECT_FALSE(report.capped());
  ASSERT_EQ(report.contacts.size(), 2u);
  EXPECT_LT(std::abs(state.position.x()), 1e-3);
  Vec3 sum = Vec3::Zero();
  for (const ProxyContact& contact : report.contacts) {
    EXPECT_NEAR((state.position - contact.point).norm(), 0.1, 1e-9);
    EXPECT_GT(contact.multiplier_m, 0);
    sum += contact.multiplier_m * contact.normal;
  }
  EXPECT_NEAR((sum - (state.position - finger)).norm(), 0, 1e-6);
}

// A crease (the file gives each face its own normals) stays a crease: like the flat object.
TEST(Shading, SplitNormalsAreACrease) {
  Model model;
  test::addRectangle(model, {-0.1, 0, 0.1}, {0.1, 0, 0}, {0, 0, -0.2}, Vec3::UnitY());
  test::addRectangle(model, {0, 0, 0.1}, {0, -0.1, 0}, {0, 0, -0.2}, Vec3::UnitX());
  const auto scene = test::snapshotOf(std::move(model));
  const ProxySettings smooth = settingsOf(0.001, true), flat = settingsOf(0.001, false);
  ProxyState a = startProxy(*scene, smooth, {-0.01, 0.01, 0}), b = a;
  for (int i = 0; i <= 200; ++i) {
    const double angle = M_PI / 2 * (1 - i / 200.0);
    const Vec3 finger = 0.0005 * Vec3(std::cos(angle), std::sin(angle), 0);
    tick(a, *scene, smooth, finger);
    tick(b, *scene, flat, finger);
    EXPECT_NEAR((a.position - b.position).norm(), 0, 1e-9) << i;
  }
}

}  // namespace
}  // namespace hl::test_shading

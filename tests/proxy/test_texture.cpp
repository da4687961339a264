// Textures: images over a surface, felt along the whole way of the proxy, and bump maps (science 1.4 and 3c).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "effect_scenes.h"
#include "proxy/proxy.h"
#include "scene/bump_gain.h"

namespace hl::test_texture {
namespace {

constexpr double kK = 1000;
constexpr double kRadius = 0.001;
constexpr double kSide = 0.2;  // of the floor, over which u and v go from 0 to 1

ProxySettings settingsOf() {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.spring_N_m = kK;
  settings.ledger = LedgerMode::kReport;
  return settings;
}

// A floor whose material has one texture.
std::shared_ptr<const Snapshot> floorWith(Texture texture, Quantity quantity, double low, double high) {
  Model model = test::floorModel();
  checkTexture(texture);
  model.textures.push_back(std::move(texture));
  model.materials[0].textureOf(quantity) = {0, low, high};
  return test::snapshotOf(std::move(model));
}

Texture image(std::size_t width, std::size_t height, std::vector<float> texels, Filter filter) {
  Texture texture;
  texture.name = "test";
  texture.width = width;
  texture.height = height;
  texture.texels = std::move(texels);
  texture.filter = filter;
  return texture;
}

TEST(Texture, SamplesAsTheFormulasSay) {
  const Texture nearest = image(2, 2, {0, 1, 0.5f, 0.25f}, Filter::kNearest);
  EXPECT_EQ(nearest.sample({0.1, 0.1}), 0);
  EXPECT_EQ(nearest.sample({0.9, 0.1}), 1);
  EXPECT_EQ(nearest.sample({0.1, 0.9}), 0.5);
  EXPECT_EQ(nearest.sample({-0.1, 0.1}), 1) << "repeats";
  EXPECT_EQ(nearest.sample({1e300, NAN}), 0) << "any number is safe";
  Texture bilinear = image(2, 2, {0, 1, 0.5f, 0.25f}, Filter::kBilinear);
  EXPECT_NEAR(bilinear.sample({0.5, 0.5}), 0.4375, 1e-12);
  EXPECT_NEAR(bilinear.sample({0.25, 0.25}), 0, 1e-12);
  EXPECT_NEAR(bilinear.sample({0.375, 0.25}), 0.25, 1e-12);
  bilinear.wrap = Wrap::kClamp;
  EXPECT_NEAR(bilinear.sample({-3, 0.25}), 0, 1e-12);
  EXPECT_NEAR(bilinear.sample({7, 0.25}), 1, 1e-12);
}

TEST(Texture, GradientIsThatOfASine) {
  const Texture sine = makeTexture("sine", 256);
  for (double u = 0; u < 1; u += 0.013) {
    const Vec2 g = sine.gradient({u, 0.3});
    EXPECT_NEAR(g.x(), M_PI * std::cos(2 * M_PI * u), 2e-3);
    EXPECT_NEAR(g.y(), 0, 1e-12);
  }
}

// C40: a checkerboard of friction: the drag on each field is its own mu times the normal force.
TEST(Texture, CheckerOfFrictionDragsByTheFieldUnderTheProxy) {
  const auto scene = floorWith(makeTexture("checker", 2), Quantity::kDynamicFriction, 0.1, 0.5);
  const ProxySettings settings = settingsOf();
  const double depth = 0.001, z = 0.05;
  ProxyState state = startProxy(*scene, settings, {-0.08, 0.01, z});
  int judged = 0;
  for (double x = -0.08; x < 0.08; x += 1e-4) {
    const Vec3 finger(x, kRadius - depth, z);
    const TickReport report = tick(state, *scene, settings, finger);
    const double from_edge = std::abs(state.position.x());
    if (x < -0.07 || from_edge < 2e-3) continue;
    const double mu = state.position.x() < 0 ? 0.5 : 0.1;  // v = 0.25: the lower row, whose left field is 1
    EXPECT_NEAR(finger.x() - report.target.x(), mu * depth, 1e-9) << x;
    ++judged;
  }
  EXPECT_GT(judged, 1000);
}

// C40 for viscosity: two halves of an image, each with its own drag b u.
TEST(Texture, ImageOfViscosityDragsByTheHalfUnderTheProxy) {
  const auto scene = floorWith(image(2, 1, {0, 1}, Filter::kNearest), Quantity::kViscosity, 1, 5);
  const ProxySettings settings = settingsOf();
  const double speed = 0.1;
  ProxyState state = startProxy(*scene, settings, {-0.08, 0.01, 0.03});
  int judged = 0;
  for (double x = -0.08; x < 0.08; x += speed * settings.period_s) {
    const Vec3 finger(x, 0, 0.03);
    const TickReport report = tick(state, *scene, settings, finger);
    const bool steady = state.position.x() > 0.01 || (x > -0.07 && state.position.x() < -1e-3);
    if (!steady) continue;
    const double b = state.position.x() < 0 ? 1 : 5;
    EXPECT_NEAR(kK * (finger.x() - report.target.x()), b * speed, 1e-6) << x;
    ++judged;
  }
  EXPECT_GT(judged, 1000);
}

// C41: lines 0.1 mm wide, 5 mm apart, are felt each, however fast the finger: the pull rises as it crosses.
TEST(Texture, NoLineOfATenthOfAMillimetreIsMissedAtAnySpeed) {
  Texture lines = makeTexture("lines", 2000, 0.02);  // 2000 texels of 0.1 mm over the floor after repeating
  lines.texels.clear();
  for (int row = 0; row < 2000; ++row) {
    for (int i = 0; i < 2000; ++i) lines.texels.push_back(i % 50 == 0 ? 1.0f : 0.0f);
  }
  const auto scene = floorWith(lines, Quantity::kDynamicFriction, 0, 1);
  const ProxySettings settings = settingsOf();
  const double depth = 0.002;  // a line holds 2 mm of pull
  for (const double speed : {0.001, 0.01, 0.1, 0.5, 1.0}) {
    const double start = -0.05 + 0.0013;
    ProxyState state = startProxy(*scene, settings, {start, 0.01, 0.01});
    tick(state, *scene, settings, {start, kRadius - depth, 0.01});
    const double far = speed < 0.01 ? 0.012 : 0.08;
    int held = 0;
    double last_line = -1;
    for (double x = start; x < start + far; x += speed * settings.period_s) {
      tick(state, *scene, settings, {x, kRadius - depth, 0.01});
      const double at = state.position.x() + 0.1;
      const double line = std::floor(at / 0.005);
      const bool on_line = at - line * 0.005 < 1.001e-4;
      if (on_line && line != last_line && x - state.position.x() > 1e-6) {
        ++held;
        last_line = line;
      }
    }
    const int crossed =
        static_cast<int>(std::floor((state.position.x() + 0.1) / 0.005) - std::floor((start + 0.1) / 0.005));
    EXPECT_EQ(held, crossed) << speed << " m/s";
    EXPECT_GE(crossed, speed < 0.01 ? 1 : 13);
  }
}

TEST(Texture, StiffnessFollowsTheImage) {
  Texture ramp = image(64, 1, {}, Filter::kBilinear);
  for (int i = 0; i < 64; ++i) ramp.texels.push_back((static_cast<float>(i) + 0.5f) / 64);
  const auto scene = floorWith(ramp, Quantity::kStiffness, 0.2, 0.8);
  const ProxySettings settings = settingsOf();
  ProxyState state = startProxy(*scene, settings, {-0.08, 0.01, 0});
  for (double x = -0.08; x < 0.08; x += 1e-4) {
    const TickReport report = tick(state, *scene, settings, {x, 0, 0});
    const double u = (x + 0.1) / kSide;
    EXPECT_NEAR(report.target.y() / kRadius, 0.2 + 0.6 * u, 1e-6);
  }
}

// C42: a bump map of sines: where the proxy rests, the force is along N - grad h within 0.1 degree.
TEST(Texture, BumpMapBendsTheForceToTheSlopeOfTheHeight) {
  const double amplitude = 20e-6, wavelength = 0.004;
  Texture sine = makeTexture("sine", 64);
  Model model = test::floorModel();
  for (Vec2& uv : model.texcoords) uv *= kSide / wavelength;
  model.textures.push_back(sine);
  model.materials[0].textureOf(Quantity::kHeight) = {0, 0, amplitude};
  const auto scene = test::snapshotOf(std::move(model));
  const ProxySettings settings = settingsOf();
  ProxyState state = startProxy(*scene, settings, {-0.05, 0.01, 0.01});
  for (double x = -0.05; x < 0.05; x += 5e-5) {
    const Vec3 finger(x, kRadius - 0.001, 0.01);
    const TickReport report = tick(state, *scene, settings, finger);
    const double k = 2 * M_PI / wavelength;
    const double slope = 0.5 * amplitude * k * std::cos(k * (state.position.x() + 0.1));
    const Vec3 force = report.target - finger;
    EXPECT_NEAR(std::atan2(-force.x(), force.y()), std::atan(slope), 0.1 * M_PI / 180) << x;
    EXPECT_NEAR(state.position.y(), kRadius, 1e-9);
  }
}

// h = A sin(k x): the largest curvature is A k^2, here with A half the range.
TEST(Texture, BumpMapReportsItsGain) {
  Model model = test::floorModel();
  for (Vec2& uv : model.texcoords) uv *= kSide / 0.004;
  model.textures.push_back(makeTexture("sine", 256));
  model.materials[0].textureOf(Quantity::kHeight) = {0, 0, 1e-4};
  const double k = 2 * M_PI / 0.004;
  const double curvature = bumpCurvature_per_m(*test::snapshotOf(std::move(model)), 0);
  EXPECT_NEAR(curvature, 0.5e-4 * k * k, 1e-3 * curvature);
  EXPECT_NEAR(passiveForce_N(curvature, 0.5, 1e-3), 1000 / curvature, 1e-9);
}

TEST(Texture, SwitchedOffTheMaterialIsPlain) {
  const auto scene = floorWith(makeTexture("checker", 2), Quantity::kDynamicFriction, 0.1, 0.5);
  ProxySettings settings = settingsOf();
  settings.surfaces.textures = false;
  ProxyState state = startProxy(*scene, settings, {-0.08, 0.01, 0.05});
  for (double x = -0.08; x < 0.08; x += 1e-3) {
    tick(state, *scene, settings, {x, 0, 0.05});
    EXPECT_NEAR(state.position.x(), x, 1e-12);
  }
}

}  // namespace
}  // namespace hl::test_texture

// The paper's section 3 claim by claim, on scenes small enough to know the answer in closed form.
#include "proxy/proxy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/finger_reach.h"
#include "geometry/scenes.h"
#include "guard/realtime_guard.h"
#include "proxy/judge.h"

namespace hl::test_proxy {
namespace {

using judge::grid;
using judge::scene;
using judge::triangles;

constexpr double kRadius = 1e-3;
constexpr double kExact = 1e-9 * kRadius;  // far above the skin of 3e-10 radii, far below anything felt
const ProxySettings kSettings{kRadius, 1000, kNoWorkCap};
#ifdef HL_SANITIZED
constexpr int kManyTicks = 5'000;
#else
constexpr int kManyTicks = 100'000;
#endif

Model plate(double half) {
  return grid(1, 1, [=](double u, double v) { return Vec3((2 * u - 1) * half, (2 * v - 1) * half, 0); });
}

Model box(const Vec3& low, const Vec3& high) {
  const auto corner = [&](int i) {
    return Vec3((i & 1) ? high.x() : low.x(), (i & 2) ? high.y() : low.y(), (i & 4) ? high.z() : low.z());
  };
  Model model;
  for (int i = 0; i < 8; ++i) model.positions.push_back(corner(i));
  model.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 7, 5}, {4, 6, 7}, {0, 5, 1}, {0, 4, 5},
                     {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return model;
}

void append(Model& model, const Model& other) {
  const auto base = static_cast<std::uint32_t>(model.positions.size());
  model.positions.insert(model.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& t : other.triangles) model.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

// Moves the finger from `from` to `to` in steps and returns the proxy at the end.
Vec3 push(const Snapshot& snapshot, const Vec3& from, const Vec3& to, int steps = 10) {
  ProxyState state = startProxy(snapshot, kSettings, from);
  for (int i = 1; i <= steps; ++i) tick(state, snapshot, kSettings, from + (to - from) * i / steps);
  return state.position;
}

TEST(C01Proxy, ATriangleHoldsItFromBothSides) {
  const auto snapshot = scene(triangles({{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}}));
  EXPECT_NEAR(push(*snapshot, Vec3(0, 0, 0.01), Vec3(0, 0, -0.02)).z(), kRadius, kExact);
  EXPECT_NEAR(push(*snapshot, Vec3(0, 0, -0.01), Vec3(0, 0, 0.02)).z(), -kRadius, kExact);
}

TEST(C01Proxy, ASegmentAndAPointHoldIt) {
  Model model;
  model.positions = {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0.5, 0, 0)};
  model.segments = {{0, 1}};
  model.points = {2};
  const auto snapshot = scene(model);
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(0, 0.1, 0.01));
  const TickReport report = tick(state, *snapshot, kSettings, Vec3(0, 0.1, -0.0005));
  EXPECT_NEAR(state.position.z(), kRadius, kExact);
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_NEAR((report.contacts[0].normal - Vec3::UnitZ()).norm(), 0, 1e-9);
  EXPECT_NEAR((push(*snapshot, Vec3(0.5, 0, 0.01), Vec3(0.5, 0, -0.0005)) - Vec3(0.5, 0, 0)).norm(), kRadius, kExact);
}

TEST(C03Proxy, ASlotLetsItThroughExactlyWhenItIsNarrowerThanTheSlot) {
  for (const double width : {1.98e-3, 1.999e-3, 2.001e-3, 2.02e-3}) {
    Model model = grid(1, 1, [=](double u, double v) { return Vec3(width / 2 + u, 2 * v - 1, 0); });
    append(model, grid(1, 1, [=](double u, double v) { return Vec3(-width / 2 - u, 2 * v - 1, 0); }));
    const double z = push(*scene(model), Vec3(0, 0, 0.01), Vec3(0, 0, -0.05)).z();
    if (width > 2 * kRadius) {
      EXPECT_NEAR(z, -0.05, kExact) << width;
    } else {
      EXPECT_GT(z, 0) << width;
    }
  }
}

// Far from the origin, where planes of the two sides cross where rounding says: no step may lead away from the finger
// by more than that explains, or the proxy goes to and fro until the cap.
TEST(C03Proxy, InASlotOfItsOwnWidthNoTickIsCapped) {
  test::Random random(17);
  const Vec3 far(-21, -8.5, -9.7);
  int touching = 0;
  for (int slot = 0; slot < 100; ++slot) {
    const Eigen::Quaterniond turned(Eigen::Vector4d::NullaryExpr([&] { return random.uniform(-1, 1); }).normalized());
    const double half = kRadius * (1 + std::pow(10.0, random.uniform(-10, -8)));
    const auto side = [&](double z) {
      return grid(3, 3, [&](double u, double v) {
        return Vec3(far + turned * Vec3(8 * kRadius * (2 * u - 1), 8 * kRadius * (2 * v - 1), z));
      });
    };
    Model model = side(half);
    append(model, side(-half));
    const auto snapshot = scene(model);
    ProxyState state{far, true};
    for (int i = 0; i < 100; ++i) {
      const TickReport report = tick(state, *snapshot, kSettings, far + random.inCube(20 * kRadius));
      ASSERT_FALSE(report.capped()) << slot << ' ' << i;
      EXPECT_GE(judge::clearance(*snapshot, state.position, 2 * kRadius), kRadius) << slot << ' ' << i;
      touching += state.touching;
    }
  }
  EXPECT_GT(touching, 1000);
}

TEST(C04Proxy, StaysInTheLocalMinimumOfATrap) {
  // A cup, open upward, between the proxy and a finger far below: the bottom of the cup is the local minimum.
  Model model = grid(1, 1, [](double u, double v) { return Vec3(0.02 * u - 0.01, 0.02 * v - 0.01, 0); });
  for (const double side : {-1.0, 1.0}) {
    append(model, grid(1, 1, [=](double u, double v) { return Vec3(side * 0.01, 0.02 * u - 0.01, 0.03 * v); }));
    append(model, grid(1, 1, [=](double u, double v) { return Vec3(0.02 * u - 0.01, side * 0.01, 0.03 * v); }));
  }
  const auto snapshot = scene(model);
  const Vec3 p = push(*snapshot, Vec3(0, 0, 0.01), Vec3(0.05, 0, -0.02), 30);
  EXPECT_NEAR((p - Vec3(0.009, 0, 0.001)).norm(), 0, 3 * kExact);
  EXPECT_LT(judge::kktResidual(*snapshot, p, Vec3(0.05, 0, -0.02), kRadius), 1e-9);
}

TEST(C05Proxy, AThinPlatePushedHalfAMetreNeverFlipsTheForce) {
  Model model = box(Vec3(-1, -1, -1e-6), Vec3(1, 1, 0));
  const auto snapshot = scene(model);
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(0.1, 0.2, 0.01));
  for (int i = 0; i <= 500; ++i) {
    const Vec3 finger(0.1, 0.2, 0.01 - 1e-3 * i);
    tick(state, *snapshot, kSettings, finger);
    ASSERT_GE((state.position - finger).z(), -kExact);
    ASSERT_GE(state.position.z(), kRadius * (1 - 1e-6) - (finger.z() > 0 ? 1 : 0));
  }
}

TEST(C05Proxy, TwoTouchingBoxesFeelLikeTheirUnion) {
  Model two = box(Vec3(-0.05, -0.05, -0.1), Vec3(0, 0.05, 0));
  append(two, box(Vec3(0, -0.05, -0.1), Vec3(0.05, 0.05, 0)));
  const auto halves = scene(two);
  const auto whole = scene(box(Vec3(-0.05, -0.05, -0.1), Vec3(0.05, 0.05, 0)));
  ProxyState a = startProxy(*halves, kSettings, Vec3(-0.02, 0.01, 0.01));
  ProxyState b = startProxy(*whole, kSettings, Vec3(-0.02, 0.01, 0.01));
  for (int i = 0; i <= 400; ++i) {
    const Vec3 finger(-0.02 + 1e-4 * i, 0.01, 0.005 * std::cos(0.05 * i) - 0.004);
    tick(a, *halves, kSettings, finger);
    tick(b, *whole, kSettings, finger);
    ASSERT_NEAR((a.position - b.position).norm(), 0, kExact);
  }
}

TEST(C07Proxy, TheNormalTurnsContinuouslyOverAnEdge) {
  // On the rounded edge the proxy sits on the circle around it, straight toward the finger.
  const auto snapshot = scene(box(Vec3(-0.1, -0.1, -0.1), Vec3(0, 0.1, 0)));
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(-0.01, 0, 0.01));
  const double depth = 2e-4;
  tick(state, *snapshot, kSettings, Vec3(-0.01, 0, kRadius - depth));
  Vec3 last = Vec3::UnitZ();
  for (int i = -50; i <= 140; ++i) {
    const double angle = std::max(0, i) * (M_PI / 2 / 90);
    const Vec3 around = Vec3(std::sin(angle), 0, std::cos(angle)) * (kRadius - depth);
    const Vec3 finger = i <= 0 ? Vec3(1e-5 * i, 0, kRadius - depth) : around;
    tick(state, *snapshot, kSettings, finger);
    const Vec3 direction = (state.position - finger).normalized();
    ASSERT_GE(direction.dot(last), std::cos(0.05)) << i;
    if (i > 0 && i < 90) {
      ASSERT_NEAR((state.position - around.normalized() * kRadius).norm(), 0, 1e-6 * kRadius) << i;
    }
    last = direction;
  }
}

TEST(C10C12Proxy, NoTickTakesItFartherFromTheFinger) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<std::array<Vec3, 3>> soup;
  const auto point = [&](double size) { return Vec3(Vec3(uniform(random), uniform(random), uniform(random)) * size); };
  for (int i = 0; i < 300; ++i) {
    const Vec3 centre = point(0.03);
    soup.push_back({centre + point(0.01), centre + point(0.01), centre + point(0.01)});
  }
  const auto snapshot = scene(triangles(soup));
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(0.1, 0.1, 0.1));
  Vec3 finger(0.1, 0.1, 0.1);
  int capped = 0;
  for (int i = 0; i < kManyTicks; ++i) {
    finger = 0.99 * finger + point(2e-3);
    const double before = (state.position - finger).norm();
    capped += tick(state, *snapshot, kSettings, finger).capped();
    ASSERT_LE((state.position - finger).norm(), before + 1e-12) << i;
    ASSERT_GE(judge::clearance(*snapshot, state.position, kRadius), kRadius * (1 - 1e-6)) << i;
    ASSERT_LE(judge::kktResidual(*snapshot, state.position, finger, kRadius), 1e-6) << i;
  }
  EXPECT_EQ(capped, 0);
}

TEST(C11Proxy, CornersAndRoundedEdgesTakeFewIterations) {
  const auto snapshot = scene(box(Vec3(-0.1, -0.1, -0.1), Vec3(0, 0, 0)));
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(0.01, 0.003, 0.004));
  TickReport report = tick(state, *snapshot, kSettings, Vec3(-2e-4, 3e-4, 2e-4));
  EXPECT_LE(report.iterations, 20);  // past the corner's sphere, then around the edge
  const Vec3 edge = Vec3(-2e-4, 0, 0) + Vec3(0, 3, 2).normalized() * kRadius;
  EXPECT_LT((state.position - edge).norm(), 1e-6 * kRadius);
  report = tick(state, *snapshot, kSettings, Vec3(-3e-4, 1e-4, 2e-4));
  EXPECT_LE(report.iterations, 6);  // around the edge alone
  // A corner of three walls from inside.
  Model walls = grid(1, 1, [](double u, double v) { return Vec3(0.1 * u, 0.1 * v, 0); });
  append(walls, grid(1, 1, [](double u, double v) { return Vec3(0.1 * u, 0, 0.1 * v); }));
  append(walls, grid(1, 1, [](double u, double v) { return Vec3(0, 0.1 * u, 0.1 * v); }));
  const auto corner = scene(walls);
  state = startProxy(*corner, kSettings, Vec3(0.01, 0.02, 0.03));
  report = tick(state, *corner, kSettings, Vec3(-0.01, -0.02, -0.005));
  EXPECT_LE(report.iterations, 6);  // two legs, and three walls
  EXPECT_NEAR((state.position - Vec3::Constant(kRadius)).norm(), 0, 2 * kExact);
  EXPECT_EQ(report.contacts.size(), 3u);
}

TEST(C11Proxy, TheCapLeavesAValidPosition) {
  const auto snapshot = scene(box(Vec3(-0.1, -0.1, -0.1), Vec3(0, 0, 0)));
  for (int cap = 0; cap < 4; ++cap) {
    const ProxySettings settings{kRadius, cap};
    ProxyState state = startProxy(*snapshot, settings, Vec3(0.01, -0.003, -0.004));
    const TickReport report = tick(state, *snapshot, settings, Vec3(-0.01, 0.2, 0.1));
    EXPECT_LE(report.iterations, cap);
    EXPECT_GE(judge::clearance(*snapshot, state.position, kRadius), kRadius * (1 - 1e-6));
  }
}

TEST(Proxy, InTheOpenItIsTheFinger) {
  const auto snapshot = scene(plate(0.1));
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(0, 0, 0.05));
  tick(state, *snapshot, kSettings, Vec3(0.013, 0.027, 0.031));
  EXPECT_EQ(state.position, Vec3(0.013, 0.027, 0.031));
}

TEST(Proxy, AnEmptySceneLetsItFollow) {
  const auto snapshot = scene(Model{});
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(0, 0, 0));
  tick(state, *snapshot, kSettings, Vec3(3, 4, 5));
  EXPECT_EQ(state.position, Vec3(3, 4, 5));
}

TEST(Proxy, AFingerThatIsNotFiniteMovesNothing) {
  const auto snapshot = scene(plate(0.1));
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(0, 0, 0.05));
  const TickReport report = tick(state, *snapshot, kSettings, Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0));
  EXPECT_FALSE(report.valid());
  EXPECT_EQ(state.position, Vec3(0, 0, 0.05));
}

// As far as its distance can be squared it is followed, or at least answered with numbers; beyond it moves nothing.
TEST(Proxy, AFingerOfAnyNumberGivesNumbers) {
  const auto snapshot = scene(box(Vec3(-0.01, -0.01, -0.01), Vec3(0.01, 0.01, 0.01)));
  for (double size = 1; size < 1e308; size *= 10) {
    for (const Vec3& way : {Vec3(1, 0, 0), Vec3(-0.6, 0.5, 0.7), Vec3(0, 0, -1)}) {
      ProxyState state = startProxy(*snapshot, kSettings, Vec3(0.001, 0.002, 0.05));
      const TickReport report = tick(state, *snapshot, kSettings, size * way);
      EXPECT_EQ(report.valid(), canBeFinger(size * way));
      EXPECT_EQ(report.valid(), size <= 1e15);
      EXPECT_TRUE(state.position.allFinite() && report.target.allFinite()) << size;
      EXPECT_TRUE(std::isfinite(report.injected_J) && std::isfinite(state.ledger.dissipated_J)) << size;
    }
  }
}

TEST(Proxy, StartsClearOfTheSceneWhereverTheFingerIs) {
  const auto snapshot = scene(box(Vec3(-0.01, -0.01, -0.01), Vec3(0.01, 0.01, 0.01)));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.012, 0.012);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 finger(uniform(random), uniform(random), i % 3 == 0 ? 0.01 : uniform(random));
    const ProxyState state = startProxy(*snapshot, kSettings, finger);
    ASSERT_TRUE(state.free) << finger.transpose();
    ASSERT_GE(judge::clearance(*snapshot, state.position, kRadius), kRadius * (1 - 1e-6)) << finger.transpose();
    ASSERT_LE((state.position - finger).norm(), 3 * kRadius) << finger.transpose();
  }
}

// Between plates that lean by a billionth, the nearest place above both planes is a thousand kilometres away; beyond
// either plate there is one at once.
TEST(Proxy, BetweenPlatesItStartsOutside) {
  for (const double half : {0.02, 10.0}) {
    Model plates = plate(half);
    append(plates, grid(1, 1, [=](double u, double v) {
             const double x = (2 * u - 1) * half;
             return Vec3(x, (2 * v - 1) * half, 0.2 * kRadius + 1e-9 * x);
           }));
    const auto snapshot = scene(plates);
    const Vec3 finger(0, 0, 0.1 * kRadius);
    const ProxyState state = startProxy(*snapshot, kSettings, finger);
    EXPECT_TRUE(state.free);
    EXPECT_LE((state.position - finger).norm(), 2 * kRadius);
  }
}

// A box of any thickness with a finger anywhere inside, thin walls within each other, a narrow wedge, a cage of bars.
TEST(Proxy, StartsNearAFingerInsideAnything) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto starts = [&](const Model& model, const Vec3& half) {
    const auto snapshot = scene(model);
    for (int i = 0; i < 50; ++i) {
      const Vec3 finger(half.x() * u(random), half.y() * u(random), half.z() * u(random));
      const ProxyState state = startProxy(*snapshot, kSettings, finger);
      ASSERT_TRUE(state.free) << finger.transpose();
      ASSERT_LE((state.position - finger).norm(), 12 * kRadius) << finger.transpose();
      ASSERT_GE(judge::clearance(*snapshot, state.position, kRadius), kRadius * (1 - 1e-6)) << finger.transpose();
      ProxyState live;
      int ticks = 1;
      while (!tick(live, *snapshot, kSettings, finger).placed()) ++ticks;
      ASSERT_LE(ticks, StartSearch::kPlaces);
      ASSERT_GE(judge::clearance(*snapshot, live.position, kRadius), kRadius * (1 - 1e-6));
    }
  };
  for (const double thickness : {1e-6, 1e-4, 0.5e-3, 1e-3, 1.5e-3, 2e-3, 3e-3}) {
    const Vec3 half(0.02, 0.015, thickness / 2);
    starts(box(-half, half), half);
  }
  Model shells;
  for (int i = 1; i <= 5; ++i) append(shells, box(Vec3::Constant(-0.8e-3 * i), Vec3::Constant(0.8e-3 * i)));
  starts(shells, Vec3::Constant(4e-3));
  Model wedge = grid(1, 1, [](double a, double b) { return Vec3(0.02 * a, 0.04 * b - 0.02, 0.002 * a); });
  append(wedge, grid(1, 1, [](double a, double b) { return Vec3(0.02 * a, 0.04 * b - 0.02, -0.002 * a); }));
  starts(wedge, Vec3(0.015, 0.01, 0.0005));
  Model bars;
  for (int i = -4; i <= 4; ++i) {
    for (int k = -4; k <= 4; ++k)
      append(bars, box(1e-3 * Vec3(1.5 * i - 0.1, -4, 1.5 * k - 0.1), 1e-3 * Vec3(1.5 * i + 0.1, 4, 1.5 * k + 0.1)));
  }
  starts(bars, Vec3::Constant(4e-3));
}

// Where plates without end lie closer than the proxy is wide there is no place: each tick says so, and what the session
// has booked stays. When the finger has come out, the proxy begins.
TEST(Proxy, WithoutAClearPlaceItSaysSoAndKeepsTheLedger) {
  Model plates;
  for (int i = 0; i <= 200; ++i)
    append(plates, grid(1, 1, [=](double a, double b) { return Vec3(a - 0.5, b - 0.5, 1.5e-3 * (i - 100)); }));
  const auto snapshot = scene(plates);
  EXPECT_FALSE(startProxy(*snapshot, kSettings, Vec3(0.01, 0.02, 0.0003)).free);
  ProxyState state;
  state.ledger.injected_J = 0.25;
  state.ledger.tank_J = 0.001;
  const Vec3 inside(0.01, 0.02, 0.0003);
  for (int i = 0; i < 1000; ++i) {
    const TickReport report = tick(state, *snapshot, kSettings, inside);
    ASSERT_FALSE(report.placed());
    ASSERT_FALSE(state.free);
    ASSERT_EQ(report.target, inside);
    ASSERT_EQ(report.contacts.size(), 0u);
  }
  EXPECT_EQ(state.ledger.injected_J, 0.25);
  EXPECT_EQ(state.ledger.tank_J, 0.001);
  EXPECT_TRUE(tick(state, *snapshot, kSettings, Vec3(0.01, 0.02, 0.2)).placed());
  EXPECT_EQ(state.position, Vec3(0.01, 0.02, 0.2));
  EXPECT_EQ(state.ledger.tank_J, 0.001);
}

TEST(Proxy, WorksAtAnyScale) {
  for (const double size : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    const ProxySettings settings{0.01 * size, 1000};
    Model model = box(Vec3::Constant(-size), Vec3::Constant(size));
    const auto snapshot = scene(model);
    ProxyState state = startProxy(*snapshot, settings, Vec3(0.2, 0.3, 1.5) * size);
    tick(state, *snapshot, settings, Vec3(0.2, 0.3, -0.5) * size);
    EXPECT_NEAR(state.position.z() / size, 1.01, 1e-9) << size;
  }
}

TEST(Proxy, AFingerVeryFarAwayDoesNotTearItThrough) {
  const auto snapshot = scene(plate(0.1));
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(0, 0, 0.05));
  tick(state, *snapshot, kSettings, Vec3(0.01, 0.02, -1e9));
  EXPECT_GE(state.position.z(), kRadius * (1 - 1e-6));
}

// Into the corner of a box that leans, from inside: however far away the finger is, the proxy comes to the same place,
// as for a finger of no end of distance; and back in the open it is the finger.
TEST(Proxy, TheDirectionOfAFarFingerDecides) {
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    const Vec3 toward = Vec3(normal(random), normal(random), normal(random)).normalized();
    Model cup;
    const auto point = [](double a, double b) {
      const double polar = M_PI * b;
      return Vec3(0.05 * std::sin(polar) * std::cos(2 * M_PI * a), 0.05 * std::sin(polar) * std::sin(2 * M_PI * a),
                  0.05 * std::cos(polar));
    };
    append(cup, grid(17, 9, point));
    const auto snapshot = scene(cup);
    Vec3 at_unit;
    for (double extents = 1e3; extents < 3e12; extents *= 10) {
      ProxyState state = startProxy(*snapshot, kSettings, Vec3::Zero());
      for (const double part : {0.5, 1.0, 1.0, 1.0}) {
        const TickReport report = tick(state, *snapshot, kSettings, part * 0.05 * extents * toward);
        ASSERT_FALSE(report.capped()) << extents;
        ASSERT_LE(report.injected_J, 0) << extents;
      }
      ASSERT_LE(judge::kktResidual(*snapshot, state.position, 0.05 * extents * toward, kRadius), 1e-8) << extents;
      ASSERT_GE(judge::clearance(*snapshot, state.position, kRadius), kRadius * (1 - 1e-6)) << extents;
      ASSERT_TRUE(extents < 3e6 || (state.position - at_unit).norm() <= 1e-9) << extents;
      at_unit = state.position;
    }
  }
}

TEST(Proxy, AFarFingerInTheOpenIsReachedPastTheScene) {
  const auto snapshot = scene(box(Vec3(-0.01, -0.01, -0.01), Vec3(0.01, 0.01, 0.01)));
  for (double away = 1; away <= 1e15; away *= 10) {
    ProxyState state = startProxy(*snapshot, kSettings, Vec3(0, 0, 0.05));
    const TickReport report = tick(state, *snapshot, kSettings, away * Vec3(0.05, 0.02, 1));
    ASSERT_EQ(state.position, away * Vec3(0.05, 0.02, 1));
    ASSERT_LE(report.iterations, 8);
    tick(state, *snapshot, kSettings, Vec3(0, 0, -0.05));
    ASSERT_TRUE(away > 1e11 || std::abs(state.position.z() - 0.011) <= 1e-9) << away;  // onto the box, from beyond
    const Vec3 aside = away * Vec3(-0.6, 0.8, 0.1);
    ASSERT_LE(tick(state, *snapshot, kSettings, aside).iterations, 20) << away;
    ASSERT_EQ(state.position, aside) << away;
  }
}

TEST(Proxy, PinchedBetweenPlatesItStaysPut) {
  Model model = plate(0.1);
  append(model, grid(1, 1, [](double u, double v) { return Vec3(u - 0.5, v - 0.5, 2 * kRadius * (1 + 2e-10)); }));
  const auto snapshot = scene(model);
  ProxyState state{Vec3(0, 0, kRadius * (1 + 2e-10)), true};
  for (int i = 0; i < 100; ++i) {
    tick(state, *snapshot, kSettings, Vec3(1e-4 * i, 0, i % 2 == 0 ? 0.1 : -0.1));
    ASSERT_NEAR(state.position.z(), kRadius, 1e-9);
  }
}

// Same triangles in another order, same bits; and the same bits with and without the hierarchy.
TEST(Proxy, TheOrderOfPrimitivesAndTheHierarchyDoNotChangeABit) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&](double size) { return Vec3(Vec3(uniform(random), uniform(random), uniform(random)) * size); };
  std::vector<std::array<Vec3, 3>> soup;
  for (int i = 0; i < 500; ++i) {
    const Vec3 c = point(0.03);
    soup.push_back({c + point(0.006), c + point(0.006), c + point(0.006)});
    if (i % 5 == 0) soup.push_back(soup.back());
  }
  const auto a = scene(triangles(soup));
  std::shuffle(soup.begin(), soup.end(), random);
  const auto b = scene(triangles(soup));
  const auto c = scene(triangles(soup), HierarchyKind::kNone);
  ProxyState pa = startProxy(*a, kSettings, Vec3::Zero());
  ProxyState pb = startProxy(*b, kSettings, Vec3::Zero());
  ProxyState pc = startProxy(*c, kSettings, Vec3::Zero());
  Vec3 finger = Vec3::Zero();
  for (int i = 0; i < kManyTicks / 5; ++i) {
    finger = 0.995 * finger + point(1e-3);
    tick(pa, *a, kSettings, finger);
    tick(pb, *b, kSettings, finger);
    tick(pc, *c, kSettings, finger);
    ASSERT_EQ(pa.position, pb.position) << i;
    ASSERT_EQ(pa.position, pc.position) << i;
  }
}

TEST(Proxy, ATickNeverTouchesTheHeap) {
  const std::uint64_t before = RealtimeGuard::heapCalls();
  const auto snapshot = scene(box(Vec3::Constant(-0.01), Vec3::Constant(0.01)));
  ASSERT_GT(RealtimeGuard::heapCalls(), before) << "the guard is not linked";
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(0, 0, 0.05));
  const RealtimeGuard guard;
  for (int i = 0; i < 10'000; ++i) {
    tick(state, *snapshot, kSettings,
         Vec3(0.02 * std::sin(0.01 * i), 0.02 * std::cos(0.017 * i), 0.02 * std::sin(0.003 * i)));
  }
}

}  // namespace
}  // namespace hl::test_proxy

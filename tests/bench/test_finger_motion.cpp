// The motions of hl bench are what their names say, on every scene that it measures.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "builtin.h"
#include "tick/feel.h"
#include "tick/finger_motion.h"

namespace hl::bench::test_finger_motion {
namespace {

constexpr std::size_t kTicks = 3000;
constexpr double kRadius_m = 1e-3;

struct Walk {
  std::shared_ptr<const Snapshot> snapshot;
  ProxySettings settings;
  Path path;
};

Walk walk(const std::string& scene, FingerMotion motion) {
  Walk result;
  result.snapshot = makeSnapshotOf(makeShape(makeBuiltinScene(scene)), Feel::kPlain);
  result.settings.radius = kRadius_m;
  result.path = planPath(*result.snapshot, motion, result.settings, kTicks);
  return result;
}

// Calls visit(place in the path, state, report) after each tick of the path that counts.
template <typename Visit>
void replay(const Walk& walk, Visit visit) {
  ProxyState state = startProxy(*walk.snapshot, walk.settings, walk.path.fingers[0]);
  for (std::size_t i = 1; i < walk.path.fingers.size(); ++i) {
    const TickReport report = tick(state, *walk.snapshot, walk.settings, walk.path.fingers[i]);
    if (i >= walk.path.approach) visit(i, state, report);
  }
}

TEST(FingerMotion, TheFingerAlwaysMovesAtItsSpeed) {
  for (const char* scene : {"terrain:10000", "sphere:10000", "soup:10000", "pits:10000", "teapot"}) {
    for (const FingerMotion motion : kFingerMotions) {
      const Path path = walk(scene, motion).path;
      ASSERT_EQ(path.fingers.size(), path.approach + kTicks);
      ASSERT_EQ(path.proxies.size(), path.fingers.size());
      for (std::size_t i = 1; i < path.fingers.size(); ++i) {
        ASSERT_NEAR((path.fingers[i] - path.fingers[i - 1]).norm(), 0.15e-3, 1e-12) << scene << " " << nameOf(motion);
      }
    }
  }
}

TEST(FingerMotion, MagnifiedItDoesTheSameInAMagnifiedWorld) {
  const double world_per_hand = 0.25;  // a power of two, so that nothing is rounded otherwise
  for (const FingerMotion motion : kFingerMotions) {
    const Walk large = walk("terrain:10000", motion);
    Model model = makeBuiltinScene("terrain:10000");
    for (Vec3& position : model.positions) position *= world_per_hand;
    const auto snapshot = makeSnapshotOf(makeShape(std::move(model)), Feel::kPlain);
    ProxySettings settings;
    settings.radius = world_per_hand * kRadius_m;
    const Path path = planPath(*snapshot, motion, settings, kTicks, world_per_hand);
    ASSERT_EQ(path.approach, large.path.approach) << nameOf(motion);
    for (std::size_t i = 0; i < path.fingers.size(); ++i) {
      ASSERT_EQ(path.fingers[i], world_per_hand * large.path.fingers[i]) << nameOf(motion) << ' ' << i;
      ASSERT_EQ(path.proxies[i], world_per_hand * large.path.proxies[i]) << nameOf(motion) << ' ' << i;
    }
  }
}

TEST(FingerMotion, AReplayMeetsTheProxyWhereThePlanDid) {
  const Walk slide = walk("terrain:10000", FingerMotion::kSliding);
  replay(slide, [&](std::size_t i, const ProxyState& state, const TickReport&) {
    ASSERT_EQ(state.position, slide.path.proxies[i]);
  });
}

TEST(FingerMotion, SlidingStaysInContactAFewMillimetresDeep) {
  for (const char* scene : {"terrain:10000", "sphere:10000"}) {
    std::size_t touching = 0;
    double depth = 0;
    const Walk slide = walk(scene, FingerMotion::kSliding);
    replay(slide, [&](std::size_t i, const ProxyState& state, const TickReport&) {
      touching += state.touching ? 1 : 0;
      depth += (state.position - slide.path.fingers[i]).norm() / kTicks;
    });
    EXPECT_EQ(touching, kTicks) << scene;
    EXPECT_NEAR(depth, 0.004, 0.0015) << scene;
  }
}

TEST(FingerMotion, FreeStaysNearTheSurfaceAndNeverTouchesIt) {
  for (const char* scene : {"terrain:10000", "sphere:10000", "soup:10000", "pits:10000", "teapot"}) {
    std::size_t near = 0;
    const Walk free = walk(scene, FingerMotion::kFree);
    replay(free, [&](std::size_t, const ProxyState& state, const TickReport& report) {
      ASSERT_FALSE(state.touching) << scene;
      ASSERT_TRUE(report.contacts.empty()) << scene;
      bool found = false;
      SceneAt(*free.snapshot).primitivesWithin(state.position, 0.005, [&](PrimitiveId, const ClosestPoint&) {
        found = true;
      });
      near += found ? 1 : 0;
    });
    EXPECT_GT(near, kTicks * 9 / 10) << scene;
  }
}

TEST(FingerMotion, TappingTouchesAndLeavesSeveralTimesASecond) {
  for (const char* scene : {"terrain:10000", "sphere:10000", "pits:10000"}) {
    std::size_t touching = 0, taps = 0;
    bool before = true;
    replay(walk(scene, FingerMotion::kTapping), [&](std::size_t, const ProxyState& state, const TickReport&) {
      touching += state.touching ? 1 : 0;
      taps += state.touching && !before ? 1 : 0;
      before = state.touching;
    });
    const double a_second = static_cast<double>(taps) / (kTicks * kPeriod_s);
    EXPECT_GT(a_second, 3) << scene;
    EXPECT_LT(a_second, 15) << scene;
    EXPECT_GT(touching, kTicks / 5) << scene;
    EXPECT_LT(touching, kTicks * 4 / 5) << scene;
  }
}

TEST(FingerMotion, CornersRestOnTwoAndThreePlanes) {
  std::size_t two = 0, three = 0;
  replay(walk("pits:10000", FingerMotion::kCorners), [&](std::size_t, const ProxyState&, const TickReport& report) {
    two += report.contacts.size() >= 2 ? 1 : 0;
    three += report.contacts.size() == 3 ? 1 : 0;
  });
  EXPECT_GT(two, kTicks / 2);
  EXPECT_GT(three, kTicks / 50);
}

}  // namespace
}  // namespace hl::bench::test_finger_motion

// How deep the stack of the servo's thread goes: it is painted, and then looked for the deepest place that was written.
#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "base/realtime.h"
#include "builtin.h"
#include "device/device_models.h"
#include "proxy/effect_scenes.h"
#include "touch/touch_step.h"

namespace hl::test_stack_use {
namespace {

constexpr std::size_t kStack_bytes = std::size_t{4} << 20;
constexpr unsigned char kPaint = 0xa5;
constexpr std::int64_t kMs = 1'000'000;

void* call(void* work) {
  (*static_cast<std::function<void()>*>(work))();
  return nullptr;
}

// Bytes that `work` takes of the stack of a thread that does nothing else.
std::size_t stackOf(std::function<void()> work) {
  void* const stack =
      mmap(nullptr, kStack_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
  std::memset(stack, kPaint, kStack_bytes);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstack(&attributes, stack, kStack_bytes);
  pthread_t thread{};
  EXPECT_EQ(pthread_create(&thread, &attributes, call, &work), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  const auto* const bytes = static_cast<const unsigned char*>(stack);
  const auto* const deepest = std::find_if(bytes, bytes + kStack_bytes, [](unsigned char b) { return b != kPaint; });
  const auto used = static_cast<std::size_t>(bytes + kStack_bytes - deepest);
  munmap(stack, kStack_bytes);
  return used;
}

// A finger that jumps about in `scene`, deep inside of it too, so that a tick has all the contacts it can have; every
// effect that the surfaces may have; and the proxy placed anew now and then.
std::size_t stackOfTicks(std::shared_ptr<const Snapshot> scene, double radius_m) {
  SnapshotSlot slot(scene);
  ProxyLoop loop(slot, {});
  TouchStep step;
  ServoSettings settings = ServoSettings::of(premium15().info);
  ProxyCommands commands;
  commands.radius_W = radius_m;
  commands.surfaces.smooth = true;
  commands.surfaces.static_friction = 0.5;
  commands.surfaces.dynamic_friction = 0.4;
  commands.surfaces.viscosity_Ns_m = 1;
  arm(step.servo());
  return stackOf([&] {
    constexpr int kSteps = 3000;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(-0.6, 0.6);
    for (int i = 1; i <= kSteps; ++i) {
      if (i % 100 == 0) ++commands.restarts;
      DeviceSample sample;
      sample.time_ns = i * kMs;
      sample.status = DeviceStatus::kOk;
      const Vec3 from_centre = scene->bounds.size().cwiseProduct(Vec3(part(random), part(random), part(random)));
      sample.position = 0.5 * (scene->bounds.min + scene->bounds.max) + from_centre;
      if (i % 3 != 0) sample.position = loop.state().position + 0.02 * from_centre;  // and then it slides
      step.onTime(loop, commands, settings, sample);
    }
  });
}

TEST(StackUse, ATickAndAServoStepTakeAtMostHalfOfWhatIsReady) {
  std::size_t deepest = stackOfTicks(makeSnapshot(makeBuiltinScene("soup:5000"), HierarchyKind::kBvh), 0.01);
  deepest = std::max(deepest, stackOfTicks(makeSnapshot(makeBuiltinScene("teapot"), HierarchyKind::kBvh), 0.05));
  deepest = std::max(deepest, stackOfTicks(test::snapshotOf(test::floorModel(Vec3(0.2, 1, 0))), 0.002));
  deepest = std::max(deepest, stackOfTicks(test::groove(1.0), 0.002));
  RecordProperty("deepest_bytes", static_cast<int>(deepest));
  EXPECT_LE(2 * deepest, kTouchedStack_bytes) << deepest << " bytes";
  EXPECT_GT(deepest, 10'000U) << "the ticks had contacts";
}

}  // namespace
}  // namespace hl::test_stack_use

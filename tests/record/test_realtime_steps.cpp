// What the servo does between two waits: no heap, no lock, no exception, no system call, no page fault. Each proof runs
// in a process of its own, as the kernel's filter cannot be taken away again.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <new>
#include <span>
#include <utility>

#include "builtin.h"
#include "device/simulated_device.h"
#include "guard/realtime_guard.h"
#include "guard/system_call_trap.h"
#include "record/recorder.h"
#include "touch/touch_session.h"
#include "touch/touch_step.h"

namespace hl::test_realtime_steps {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr int kSteps = 1'000'000;
constexpr int kWarmUp = 2'000;
constexpr int kRealSteps = 2'500;  // the loop asks for the kernel's counts once a second
constexpr int kNotPermitted = 92, kNoForce = 93;

class RealtimeStepsDeathTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!RealtimeGuard::kWhole) GTEST_SKIP() << "the sanitizers allocate and call the kernel themselves";
    if (!trapsArePermitted()) GTEST_SKIP() << "the kernel or a container does not permit seccomp";
  }
};

long pageFaults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

// What TouchSession's servo thread does in a step, on a virtual clock: device, tick, servo, device, records.
class VirtualServo {
 public:
  VirtualServo() : scenes_(makeSnapshot(makeBuiltinScene("teapot"), HierarchyKind::kBvh)), loop_(scenes_, {}) {
    settings_.period_s = 1e-3;
    commands_.workspace = Workspace::fit(scenes_.newest()->bounds, 0.12);
    commands_.radius_W = 0.002 * commands_.workspace.world_per_device;
    arm(step_.servo());
  }

  // The hand strokes over the teapot and presses into it.
  void step() {
    const std::int64_t now_ns = ++steps_ * kMs;
    const double t_s = 1e-3 * static_cast<double>(steps_);
    device_.setHandGoal(Vec3(0.03 * std::sin(0.9 * t_s), 0.02 * std::cos(0.5 * t_s), 0.03 * std::cos(1.3 * t_s)));
    const DeviceSample sample = device_.read(now_ns);
    const ServoState before = step_.servo();
    const ServoOutput out = step_.onTime(loop_, commands_, settings_, sample);
    device_.write(out.force_N);
    recorder_.tick({sample.time_ns, sample.position, commands_, springOf(settings_, before)}, *step_.tick(), loop_, 0);
    recorder_.step({before, ServoCommand::kNone, settings_, step_.target(), sample, out, 0});
    force_N_ = std::max(force_N_, out.force_N.norm());
  }
  double strongest_N() const { return force_N_; }

 private:
  static RecorderSettings recorderSettings() {
    RecorderSettings settings;
    settings.black_box_folder = "unused";  // nothing is written without start()
    return settings;
  }

  // Coarser than the default: what it calculates is not what is tested.
  static SimulatedDeviceSettings quickSettings() {
    SimulatedDeviceSettings settings;
    settings.step_s = 100e-6;
    return settings;
  }

  SnapshotSlot scenes_;
  ProxyLoop loop_;
  SimulatedDevice device_{quickSettings()};
  ServoSettings settings_ = ServoSettings::of(device_.info());
  ProxyCommands commands_;
  TouchStep step_;
  Recorder recorder_{recorderSettings(), {device_.info(), 1000, 1000, {}}};
  std::int64_t steps_ = 0;
  double force_N_ = 0;
};

// The steps in which a page was missed, for the parent to read.
struct MissedPages {
  static constexpr std::size_t kMax = 1024;
  std::array<int, kMax> steps{};
  std::size_t count = 0;

  void add(int step) {
    if (count < kMax) steps[count++] = step;
  }
};

// getrusage passes, as it is this proof's own.
[[noreturn]] void makeAMillionSteps(MissedPages& missed) {
  touchPrograms();
  const auto servo = std::make_unique<VirtualServo>();
  for (int i = 0; i < kWarmUp; ++i) servo->step();
  constexpr std::array<int, 1> kOwn{SYS_getrusage};
  if (!trapSystemCalls(kOwn)) _exit(kNotPermitted);
  long before = pageFaults();
  {
    const RealtimeGuard guard;
    for (int i = 0; i < kSteps; ++i) {
      servo->step();
      const long after = pageFaults();
      if (after != before) missed.add(i);
      before = after;
    }
  }
  _exit(servo->strongest_N() > 0.2 ? 0 : kNoForce);
}

MissedPages pagesMissedInAMillionSteps() {
  void* const shared = mmap(nullptr, sizeof(MissedPages), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto* const missed = new (shared) MissedPages;
  EXPECT_EXIT(makeAMillionSteps(*missed), testing::ExitedWithCode(0), "");
  const MissedPages result = *missed;
  munmap(shared, sizeof(MissedPages));
  return result;
}

// The steps are the same in every process, and so is the one that is the first to touch a page. The kernel takes pages
// away too, where memory is short or to join them to a huge page, but at no fixed step.
TEST_F(RealtimeStepsDeathTest, AMillionServoStepsCallNothingAndMissNoPage) {
  const MissedPages first = pagesMissedInAMillionSteps();
  if (first.count == 0) return;
  const MissedPages again = pagesMissedInAMillionSteps();
  for (const int step : std::span(first.steps).first(first.count)) {
    EXPECT_EQ(std::count(again.steps.begin(), again.steps.begin() + again.count, step), 0)
        << "step " << step << " misses a page in every process";
  }
}

// A simulated device that puts its servo thread under guard and trap with its first reading there.
class GuardingDevice final : public Device {
 public:
  void open() override { own_->open(); }
  void close() override { own_->close(); }
  const DeviceInfo& info() const override { return own_->info(); }
  SimulatedHand* hand() override { return own_->hand(); }
  void write(const Vec3& force_N) override {
    strongest_N_ = std::max(strongest_N_, force_N.norm());
    own_->write(force_N);
  }
  DeviceSample read(std::int64_t now_ns) override {
    if (guarding_.load()) {
      if (++steps_ == 1) guardThisThread();
      if (steps_ > kRealSteps) _exit(strongest_N_ > 0.05 ? 0 : kNoForce);
    }
    return own_->read(now_ns);
  }
  void guardFromNowOn() { guarding_ = true; }

 private:
  static void guardThisThread() {
    // The wait for the next step; the counts that the loop asks for once a second.
    constexpr std::array<int, 2> kOfTheLoop{SYS_clock_nanosleep, SYS_getrusage};
    if (!trapSystemCalls(kOfTheLoop)) _exit(kNotPermitted);
    new RealtimeGuard;  // to the end of the process
  }

  std::unique_ptr<Device> own_ = openDevice("sim");
  std::atomic<bool> guarding_{false};
  int steps_ = 0;
  double strongest_N_ = 0;
};

[[noreturn]] void runASession() {
  auto device = std::make_unique<GuardingDevice>();
  GuardingDevice* const guarding = device.get();
  TouchSession session(makeSnapshot(makeBuiltinScene("teapot"), HierarchyKind::kBvh), {}, std::move(device));
  guarding->guardFromNowOn();
  session.start();
  while (true) pause();
}

// The thread itself, with its waits, its views for pages and clients, and the thread of the hand beside it.
TEST_F(RealtimeStepsDeathTest, TheServoThreadOfASessionCallsOnlyItsWait) {
  EXPECT_EXIT(runASession(), testing::ExitedWithCode(0), "");
}

// Red, were it made on the way: the trap and the guard are alive in such a process.
TEST_F(RealtimeStepsDeathTest, OneSystemCallInAStepIsFound) {
  const auto work = [] {
    VirtualServo servo;
    if (!trapSystemCalls()) _exit(kNotPermitted);
    servo.step();
    syscall(SYS_gettid);
    _exit(0);
  };
  EXPECT_EXIT(work(), testing::ExitedWithCode(kTrappedExit), "a system call where none may be");
}

}  // namespace
}  // namespace hl::test_realtime_steps

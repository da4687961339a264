#include "tools/self_test_run.h"

#include <atomic>
#include <chrono>
#include <thread>

#include "base/clock.h"
#include "base/duration.h"
#include "base/guarded_thread.h"
#include "base/periodic.h"
#include "device/simulated_hand.h"
#include "touch/servo_watch.h"

namespace hl {

namespace {

constexpr double kMissedMax = 0.01;  // of the steps
constexpr auto kLook = std::chrono::milliseconds(10);

// The thread that tests, and what it shares with the one that waits.
class SelfTestThread {
 public:
  explicit SelfTestThread(Device& device)
      : device_(device), test_(device.info(), 1 / device.info().servo_rate_Hz), watch_(device, counters_, [] {}) {}

  void run(SelfTestRun& result) {
    result.grant = requestRealtime(kServoPriority, spareCore(0));
    ready_ = true;
    const double period_s = 1 / device_.info().servo_rate_Hz;
    runPeriodic(durationOf(period_s).count(), running_, counters_, [&](std::int64_t) {
      if (!guarded([&] { step(result.calls); })) test_.end(FaultReason::kDeviceLost);
      part_ = test_.part();
      if (part_ == SelfTestPart::kDone) running_ = false;
    });
    guarded([&] { device_.write(Vec3::Zero()); });
    result.report = test_.report();
    result.steps = counters_.steps;
    result.deadlines_missed = counters_.deadlines_missed;
  }

  void watch(bool fifo) { watch_.start(ServoWatch::looks(fifo, device_.info().servo_rate_Hz)); }
  void endWatch() { watch_.stop(); }
  bool ready() const { return ready_; }
  SelfTestPart part() const { return part_; }

 private:
  void step(Histogram& calls) {
    const std::int64_t begin_ns = monotonicNow_ns();
    const DeviceSample sample = device_.read(begin_ns);
    std::int64_t in_driver_ns = monotonicNow_ns() - begin_ns;
    if (watch_.takeStall()) test_.end(FaultReason::kStalled);
    const Vec3 force_N = test_.step(sample);
    if (SimulatedHand* hand = device_.hand()) hand->setHandGoal(test_.handGoal_D());
    const std::int64_t write_ns = monotonicNow_ns();
    device_.write(force_N);
    in_driver_ns += monotonicNow_ns() - write_ns;
    calls.add(static_cast<std::uint64_t>(in_driver_ns));
  }

  Device& device_;
  SelfTest test_;
  LoopCounters counters_;
  ServoWatch watch_;
  std::atomic<bool> running_{true}, ready_{false};
  std::atomic<SelfTestPart> part_{SelfTestPart::kArm};
};

}  // namespace

SelfTestRun runSelfTest(Device& device, const std::function<void(SelfTestPart)>& report) {
  SelfTestRun result;
  result.rate_Hz = device.info().servo_rate_Hz;
  SelfTestThread test(device);
  std::thread thread = startThread("self test", [&] { test.run(result); });
  while (!test.ready()) std::this_thread::yield();
  test.watch(result.grant.fifo);
  SelfTestPart reported = SelfTestPart::kArm;
  while (reported != SelfTestPart::kDone) {
    if (const SelfTestPart part = test.part(); part != reported) report(reported = part);
    std::this_thread::sleep_for(kLook);
  }
  thread.join();
  test.endWatch();
  result.faults = faultsOf(result.report);
  if (static_cast<double>(result.deadlines_missed) > kMissedMax * static_cast<double>(result.steps))
    result.faults.push_back("of " + std::to_string(result.steps) + " servo steps " +
                            std::to_string(result.deadlines_missed) +
                            " were missed: end other programs, or give this one real-time priority (hl doctor)");
  return result;
}

}  // namespace hl

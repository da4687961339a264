#include "tools/bench_session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"

namespace hl {

namespace {

constexpr double kStep_s = 2e-6;  // of the integration, at most: half of it is time won

SimulatedDeviceSettings withFineSteps(SimulatedDeviceSettings settings) {
  settings.step_s = std::min(settings.step_s, kStep_s);
  return settings;
}

}  // namespace

BenchSession::BenchSession(const StabilityCase& loop, double stiffness_N_m, std::shared_ptr<const Snapshot> scene)
    : period_ns_(std::llround(1e9 / loop.rate_Hz)),
      device_(withFineSteps(loop.device)),
      scenes_(std::move(scene)),
      proxy_(scenes_, {}),
      settings_(ServoSettings::of(device_.info())) {
  settings_.stiffness_N_m = stiffness_N_m;
  settings_.damping_Ns_m = loop.damping_Ns_m;
  settings_.period_s = seconds(period_ns_);
  settings_.ramp_s = settings_.period_s;
  settings_.vibration.on = false;  // what the loop does by itself
  commands_.radius_W = kRadius_m;
  arm(step_.servo());
}

void BenchSession::step() {
  const ServoOutput out = step_.onTime(proxy_, commands_, settings_, device_.read(time_ns_));
  device_.write(out.force_N);
  force_N_ = out.force_N;
  on_ = out.safety == SafetyState::kOn || out.safety == SafetyState::kArming;
  time_ns_ += period_ns_;
}

}  // namespace hl

#include "tools/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/bench_session.h"

namespace hl {

namespace {

constexpr double kAbove_m = 0.001;  // the tip begins so far above the floor
constexpr double kWatch_s = 3, kLast_s = 0.3;

// A floor that a proxy at the device's origin is kAbove_m away from.
std::shared_ptr<const Snapshot> floorBelow() {
  constexpr double kHalf_m = 1, kHeight_m = -(BenchSession::kRadius_m + kAbove_m);
  Model model;
  for (const double z : {kHalf_m, -kHalf_m}) {
    for (const double x : {-kHalf_m, kHalf_m}) model.positions.emplace_back(x, kHeight_m, z);
  }
  model.triangles = {{0, 1, 3}, {0, 3, 2}};
  return makeSnapshot(std::move(model), HierarchyKind::kBvh);
}

// A session over that floor, ready to make force.
class FloorSession : public BenchSession {
 public:
  FloorSession(const StabilityCase& loop, double stiffness_N_m) : BenchSession(loop, stiffness_N_m, floorBelow()) {
    steps(kReady_s);
  }
  /// Of the tip beneath the place where it first touches the floor.
  double depth_m() const { return -kAbove_m - device().trueTip_D().y(); }
};

// How deep the hand must want to be to press with so many newtons: its springs and the floor's in series.
double goalDepth_m(const GripParameters& grip, double stiffness_N_m, double push_N) {
  return push_N * (1 / grip.pad_stiffness_N_m + 1 / grip.arm_stiffness_N_m + 1 / stiffness_N_m);
}

// Whether a small swing about the place where the load rests on the floor grows.
bool swingGrows(StabilityCase loop, double stiffness_N_m) {
  constexpr double kLoad_N = 1, kTime_s = 5;
  loop.device.held = false;
  loop.device.load_N = Vec3::Zero();
  FloorSession session(loop, stiffness_N_m);
  const double rest_m = kLoad_N / stiffness_N_m;
  constexpr int kLowering = 100;  // steps: a jump would be a blow, which the servo cuts
  for (int i = 1; i <= kLowering; ++i) {
    session.device().place({0, -kAbove_m - 1.05 * rest_m * i / kLowering, 0}, Vec3::Zero());
    session.step();
  }
  session.device().setLoad({0, -kLoad_N, 0});
  session.device().place({0, -kAbove_m - 1.05 * rest_m, 0}, Vec3::Zero());
  double early_m = 0, late_m = 0;
  for (double t = 0; t < kTime_s; t += session.period_s()) {
    session.step();
    const double swing_m = std::abs(session.depth_m() - rest_m);
    if (swing_m > 0.9 * rest_m) return true;
    if (t > 0.2 * kTime_s && t < 0.4 * kTime_s) early_m = std::max(early_m, swing_m);
    if (t > 0.8 * kTime_s) late_m = std::max(late_m, swing_m);
  }
  return late_m > early_m;
}

}  // namespace

double restlessness_m(const StabilityCase& loop, double stiffness_N_m, const Landing& landing) {
  FloorSession session(loop, stiffness_N_m);
  SimulatedDevice& device = session.device();
  const GripParameters& grip = loop.device.firm ? kFirmGrip : kLightGrip;
  device.place(device.trueTip_D(), {0, -landing.speed_m_s, 0});
  device.setHandGoal({0, -kAbove_m - goalDepth_m(grip, stiffness_N_m, landing.push_N), 0});
  double highest_m = -std::numeric_limits<double>::infinity(), lowest_m = -highest_m;
  for (double t = 0; t < kWatch_s; t += session.period_s()) {
    session.step();
    if (!session.on()) return std::numeric_limits<double>::infinity();
    if (t < kWatch_s - kLast_s) continue;
    highest_m = std::max(highest_m, session.depth_m());
    lowest_m = std::min(lowest_m, session.depth_m());
  }
  return highest_m - lowest_m;
}

bool settles(const StabilityCase& loop, double stiffness_N_m, Landings landings) {
  for (const double speed_m_s : kImpactSpeeds_m_s) {
    for (const double push_N : kPushes_N) {
      const bool one_only = push_N == kMiddlingPush_N || speed_m_s == kImpactSpeeds_m_s.front();
      if (landings == Landings::kOneByOne && !one_only) continue;
      if (!(restlessness_m(loop, stiffness_N_m, {speed_m_s, push_N}) < kSettled_m)) return false;
    }
  }
  return true;
}

double highestStiffness_N_m(const StabilityCase& loop, Landings landings) {
  double good = 0, bad = kStiffnessLow_N_m;
  while (bad <= kStiffnessHigh_N_m && settles(loop, bad, landings)) {
    good = bad;
    bad *= M_SQRT2;
  }
  if (good == 0) return 0;
  if (bad > kStiffnessHigh_N_m) return kStiffnessHigh_N_m;
  while (bad / good > 1.02) {
    const double middle = std::sqrt(good * bad);
    (settles(loop, middle, landings) ? good : bad) = middle;
  }
  return good;
}

double criticalStiffness_N_m(const StabilityCase& loop, double low_N_m, double high_N_m) {
  while (high_N_m / low_N_m > 1.002) {
    const double middle = std::sqrt(low_N_m * high_N_m);
    (swingGrows(loop, middle) ? high_N_m : low_N_m) = middle;
  }
  return std::sqrt(low_N_m * high_N_m);
}

}  // namespace hl

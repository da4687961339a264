#include "control/vibration_guard.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// The force turns when it comes back by so much: a count of an encoder, 32 um at 5 kN/m, is 0.16 N.
constexpr double kTurn_N = 0.25;
// A swing of less is not looked at.
constexpr double kMin_N = 0.3, kLarge_N = 2;
// How long a period takes at most, by the size of its swings. People tremble at 8 to 12 Hz, by less than 2 N, and tap
// at up to 10 Hz, by less than 5 N; by 7 N they do not strike six times a second.
struct PeriodLimit {
  double swing_N, period_s;
};
constexpr std::array<PeriodLimit, 4> kPeriodLimits{{{7, 0.160}, {5, 0.115}, {kLarge_N, 0.085}, {kMin_N, 0.070}}};
// A row goes on for so long at least. Small swings come from rough surfaces too, but not for long.
constexpr double kLargeRow_s = 0.05, kRow_s = 0.3;
constexpr double kKeptPart = 0.9;       // of their size four swings keep from one period to the next, or die away
constexpr double kGrows = 1.15;         // three large swings on end by so much: there is no need to see more
constexpr double kOwnPart = 0.7;        // of a swing is the finger's own
constexpr double kCriticalPart = 0.15;  // of the critical stiffness: a gain margin of 6 and more
constexpr double kZeta = 0.4;           // of the damper
constexpr double kMinDrop = 0.5, kMaxDrop = 0.02;  // of K s in one softening
constexpr double kOpen_s = 1;                      // in the open, after which ...
constexpr double kRise = 1.1;                      // ... the limit goes up by so much
constexpr std::uint32_t kRow = 6;                  // swings: two sums of four, a period apart

using Mark = AxisSwings::Mark;
using Swing = AxisSwings::Swing;

// Whether this swing is one of those a row is made of.
bool counts(const Mark& from, const Mark& to) {
  const double own_N = to.own_N - from.own_N, other_N = to.other_N - from.other_N;
  return std::abs(to.force_N - from.force_N) >= kMin_N && own_N >= kOwnPart * (own_N + other_N);
}

double longestPeriod_s(double swing_N) {
  for (const PeriodLimit& limit : kPeriodLimits) {
    if (swing_N >= limit.swing_N) return limit.period_s;
  }
  return 0;
}

// The swing from the last turn to the best mark is over: the force turned there.
void turn(AxisSwings& axis, double period_s) {
  const Mark& from = axis.turn;
  const Mark& to = axis.best;
  const Swing swing{std::abs(to.force_N - from.force_N), std::abs(to.finger_m - from.finger_m), to.step - from.step};
  const double most_s = longestPeriod_s(std::min(swing.force_N, axis.last[0].force_N));
  const bool soon = (swing.steps + axis.last[0].steps) * period_s <= most_s;
  if (!counts(from, to) || swing.steps * period_s > longestPeriod_s(swing.force_N)) {
    axis.row = 0;
  } else {
    axis.row = soon ? axis.row + 1 : 1;
    if (axis.row == 1) axis.row_step = from.step;
  }
  std::copy_backward(axis.last.begin(), axis.last.end() - 1, axis.last.end());
  axis.last[0] = swing;
  axis.turn = axis.best;
  axis.direction = -axis.direction;
}

double fourFrom(const AxisSwings& axis, std::size_t first) {
  double sum_N = 0;
  for (std::size_t i = first; i < first + 4; ++i) sum_N += axis.last[i].force_N;
  return sum_N;
}

// A row that dies away begins anew with its newest swings.
void forgetWhatDied(AxisSwings& axis) {
  constexpr std::uint32_t kNewest = 4;
  if (axis.row < kRow || fourFrom(axis, 0) >= kKeptPart * fourFrom(axis, 2)) return;
  axis.row = kNewest;
  axis.row_step = axis.turn.step;
  for (std::size_t i = 0; i < kNewest; ++i) axis.row_step -= axis.last[i].steps;
}

// True when a swing is over.
bool follow(AxisSwings& axis, const Mark& now, double period_s) {
  if (axis.direction == 0) {
    if (now.force_N == axis.turn.force_N) axis.turn = now;
    if (std::abs(now.force_N - axis.turn.force_N) < kTurn_N) return false;
    axis.direction = now.force_N > axis.turn.force_N ? 1 : -1;
    axis.best = now;
    return false;
  }
  const double back_N = axis.direction * (axis.best.force_N - now.force_N);
  if (back_N <= 0) axis.best = now;
  if (back_N < kTurn_N) return false;
  turn(axis, period_s);
  forgetWhatDied(axis);
  axis.best = now;
  return true;
}

bool shakes(const AxisSwings& axis, double period_s) {
  const bool large = std::min(axis.last[0].force_N, axis.last[1].force_N) >= kLarge_N;
  const auto grows = [&](std::size_t i) { return axis.last[i].force_N > kGrows * axis.last[i + 2].force_N; };
  if (large && axis.row >= kRow - 1 && grows(0) && grows(1) && grows(2)) return true;
  const double row_s = (axis.turn.step - axis.row_step) * period_s;
  return axis.row >= kRow && row_s >= (large ? kLargeRow_s : kRow_s);
}

// The newest period gives Ku, which is not above the stiffness that swings, and w.
void soften(VibrationGuard& guard, const AxisSwings& axis, const SpringStep& step, double period_s) {
  const Swing &one = axis.last[0], &other = axis.last[1];
  const double way_m = one.way_m + other.way_m;
  const double swing_N = one.force_N + other.force_N;
  const double critical_N_m = way_m > 0 ? std::min(swing_N / way_m, guard.used_N_m) : guard.used_N_m;
  const double limit_N_m =
      std::clamp(kCriticalPart * critical_N_m, kMaxDrop * guard.used_N_m, kMinDrop * guard.used_N_m);
  const double w_1_s = 2 * M_PI / (period_s * (one.steps + other.steps));
  guard.damping_Ns_m = 2 * kZeta * std::sqrt(limit_N_m * critical_N_m) / w_1_s;
  if (step.pulling) guard.dissipated_J += 0.5 * (step.stiffness_N_m - limit_N_m) * step.gap.squaredNorm();
  guard.limit_N_m = limit_N_m;
  ++guard.alarms;
  for (AxisSwings& each : guard.axes) each.row = 0;
}

// In the open the limit goes up, until it limits nothing.
void recover(VibrationGuard& guard, bool pulling, double full_N_m, double period_s) {
  guard.open_s = pulling ? 0 : guard.open_s + period_s;
  if (guard.limit_N_m == 0 || guard.open_s < kOpen_s) return;
  guard.open_s = 0;
  guard.limit_N_m *= kRise;
  if (guard.limit_N_m >= full_N_m) guard.limit_N_m = guard.damping_Ns_m = 0;
}

// What the finger's own way along the force did to it. Where it comes to the surface or leaves it, that is all.
Vec3 ownChange_N(const SpringStep& before, const SpringStep& now, const Vec3& change_N) {
  if (!before.pulling || !now.pulling || !(before.gap.squaredNorm() > 0)) return change_N;
  const Vec3 along = before.gap.normalized();
  return -before.stiffness_N_m * (now.finger_D - before.finger_D).dot(along) * along;
}

}  // namespace

double limitedStiffness_N_m(const VibrationGuard& guard, double stiffness_N_m, double surface) {
  const bool limits = guard.limit_N_m > 0 && stiffness_N_m * surface > guard.limit_N_m;
  return limits ? guard.limit_N_m / surface : stiffness_N_m;
}

void watchVibration(VibrationGuard& guard, const VibrationSettings& settings, const SpringStep& step, double full_N_m,
                    const Vec3& velocity_m_s, double period_s) {
  if (!settings.on) return;
  ++guard.steps;
  const Vec3 change_N = step.stiffness_N_m * step.gap - guard.before.stiffness_N_m * guard.before.gap;
  const Vec3 own_N = ownChange_N(guard.before, step, change_N);
  const AxisSwings* shaking = nullptr;
  for (int i = 0; i < 3; ++i) {
    AxisSwings& axis = guard.axes[static_cast<std::size_t>(i)];
    axis.own_N += std::abs(own_N[i]);
    axis.other_N += std::abs(change_N[i] - own_N[i]);
    const Mark now{step.force_N[i], step.finger_D[i], axis.own_N, axis.other_N, guard.steps};
    if (!follow(axis, now, period_s) || !shakes(axis, period_s)) continue;
    if (shaking == nullptr || axis.last[0].force_N > shaking->last[0].force_N) shaking = &axis;
  }
  if (step.pulling) {
    guard.used_N_m = step.stiffness_N_m;
    guard.dissipated_J += guard.damping_Ns_m * velocity_m_s.squaredNorm() * period_s;
  }
  if (shaking != nullptr) soften(guard, *shaking, step, period_s);
  guard.before = step;
  recover(guard, step.pulling, full_N_m, period_s);
}

void restVibration(VibrationGuard& guard) {
  guard.axes = {};
  guard.before = {};
}

}  // namespace hl

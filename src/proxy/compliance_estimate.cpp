#include "proxy/compliance_estimate.h"

#include <algorithm>
#include <array>

namespace hl {

namespace {

constexpr double kRoundUp = 1.25;
constexpr double kMaxEstimate_m_N = 0.05;  // 20 N/m: softer than any tissue that is pressed
constexpr std::size_t kMaxLag = 4;         // frames from a force to the end of the motion that answers it
constexpr double kMinChange_N = 0.01;      // root of the summed squares; less gives nothing
constexpr double kMinExplained = 0.95;     // r^2 of the secant
constexpr double kMin_m_N = 1e-5;          // 100 kN/m: nothing
constexpr double kDecay = 0.25;            // of an estimate that is too high, in a frame

// Sums over pairs (change of force, motion of the mesh).
struct Secant {
  double force2 = 0, move2 = 0, both = 0;
  void add(double change_N, double moved_m) {
    force2 += change_N * change_N;
    move2 += moved_m * moved_m;
    both += change_N * moved_m;
  }
  double explained() const { return move2 > 0 && force2 > 0 ? both * both / (force2 * move2) : 0; }
};

void append(double value, std::array<double, ComplianceEstimate::kFrames>& list) {
  std::rotate(list.begin(), list.begin() + 1, list.end());
  list.back() = value;
}

}  // namespace

void ComplianceEstimate::closeFrame(double period_s, double servo_m_N) {
  const auto count = static_cast<double>(ticks);
  append(moved_m, moves_m);
  append(sum_N / count, means_N);
  append(normal.dot(force_N), lasts_N);
  frame_s = count * period_s;
  moved_m = sum_N = 0;
  ticks = 0;
  const double secant = secant_m_N();
  if (secant < 0) return;
  const double measured_m_N = secant > servo_m_N ? secant : 0;
  const double wanted = std::min(kRoundUp * measured_m_N, kMaxEstimate_m_N), before = compliance_m_N;
  double change = wanted > before ? wanted - before : kDecay * (wanted - before);
  if (before + change < kMin_m_N) change = -before;
  compliance_m_N = before + change;
  lift_m += change * force_N;  // the force stays what it is
}

double ComplianceEstimate::secant_m_N() const {
  double best = 0, explained = kMinExplained;
  bool known = false;
  for (const auto* forces_N : {&means_N, &lasts_N}) {
    for (std::size_t lag = 1; lag <= kMaxLag; ++lag) {
      Secant secant;
      for (std::size_t i = lag + 1; i < kFrames; ++i)
        secant.add((*forces_N)[i - lag] - (*forces_N)[i - lag - 1], moves_m[i]);
      if (secant.force2 < kMinChange_N * kMinChange_N) continue;
      known = true;
      if (secant.both >= 0 || secant.explained() <= explained) continue;
      explained = secant.explained();
      best = -secant.both / secant.force2;
    }
  }
  return known ? best : -1;
}

}  // namespace hl

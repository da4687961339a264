// The stability bench: how stiff a floor may be under a simulated device in a hand before it shakes. Everything runs as
// in a session, on a virtual clock: simulated device, TouchStep, proxy on a real scene.
//
// A stiffness settles when after every impact on the floor and under every push the tip moves by less than 0.15 mm,
// peak to peak. The highest one is found by steps of root two and bisection.
#pragma once

#include <array>
#include <cstdint>

#include "tools/stability_case.h"

namespace hl {

/// How the finger comes to the floor, and how hard the hand then wants to press.
struct Landing {
  double speed_m_s = 0;
  double push_N = 0;
};

/// What a stiffness must settle after.
enum class Landings : std::uint8_t {
  kOneByOne,  ///< fast impacts under a middling push, and hard pushes after a slow impact
  kTogether,  ///< every speed of impact with every push
};

inline constexpr double kSettled_m = 0.15e-3;  ///< peak to peak
inline constexpr std::array<double, 4> kImpactSpeeds_m_s{0.05, 0.1, 0.2, 0.4};
inline constexpr std::array<double, 3> kPushes_N{0.3, 1, 3};
inline constexpr double kMiddlingPush_N = 1;

/// The tip's way, peak to peak, in the last 0.3 s of 3 s after the impact, m; infinite when the servo cut the force.
double restlessness_m(const StabilityCase& loop, double stiffness_N_m, const Landing& landing);
bool settles(const StabilityCase& loop, double stiffness_N_m, Landings landings);

inline constexpr double kStiffnessLow_N_m = 50, kStiffnessHigh_N_m = 40'000;
/// The highest stiffness that settles, to 2 %: the end of the lowest stretch of those that do. 0 and kStiffnessHigh_N_m
/// when none does, or all do.
double highestStiffness_N_m(const StabilityCase& loop, Landings landings);

/// For a device without hand and friction that a load presses on the floor: the stiffness at which a small swing starts
/// to grow, N/m, to 0.2 %, between `low` and `high`. Theory: b / (T (1/2 + d)), d ticks of delay.
double criticalStiffness_N_m(const StabilityCase& loop, double low_N_m, double high_N_m);

}  // namespace hl

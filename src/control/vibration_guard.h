// The vibration guard: notices that spring and hand shake each other, and softens the spring until they do not.
//
// A spring that is sampled or late feeds energy; above some stiffness the loop of spring, device and hand swings up to
// the limit of the force and stays there. Along each axis the guard follows the force from turn to turn, and acts on a
// row of swings that neither a hand makes nor a surface explains:
//   - a period is shorter than people can shake or tap;
//   - the finger's own way along the force makes them, dF = -K s dx: no surface that moves, bends or has a texture;
//   - they do not die away.
// A loop that swings for good, its force by F and the finger by X, has the critical stiffness Ku = F / X, whatever
// limits its force, and swings as a mass m = Ku / w^2 on a spring: the relay experiment of Astrom and Hagglund
// ("Automatic tuning of simple regulators with specifications on phase and amplitude margins", Automatica 20(5), 1984).
// The guard then holds K s below a part of Ku, and damps what still swings by b = 2 zeta sqrt(K m). Softening takes
// 1/2 (K - K') s |gap|^2 out of the spring; that and the damper's work are booked. The limit goes up again a little at
// a time and only in the open: there the spring holds nothing, so that a stiffer one costs nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/vec.h"

namespace hl {

struct VibrationSettings {
  bool on = true;
};

/// Along one axis: where the force turned last, and the swings before.
struct AxisSwings {
  struct Mark {
    double force_N = 0, finger_m = 0;
    double own_N = 0, other_N = 0;  ///< sums of |dF| until then: by the finger's way, and by anything else
    std::uint32_t step = 0;
  };
  struct Swing {
    double force_N = 0, way_m = 0;
    std::uint32_t steps = 0;
  };
  static constexpr std::size_t kKept = 6;

  int direction = 0;  ///< in which the force goes: 1, -1, or 0 before it has gone anywhere
  Mark turn;          ///< the last one
  Mark best;          ///< the farthest since
  double own_N = 0, other_N = 0;
  std::array<Swing, kKept> last{};  ///< the newest first
  std::uint32_t row = 0;            ///< how many swings belong together, up to the newest
  std::uint32_t row_step = 0;       ///< when the first of them began
};

/// The spring of one step, as it is used.
struct SpringStep {
  bool pulling = false;         ///< false: the finger is in the open
  double stiffness_N_m = 0;     ///< K s
  Vec3 gap = Vec3::Zero();      ///< proxy - finger
  Vec3 force_N = Vec3::Zero();  ///< what is wanted of the motors
  Vec3 finger_D = Vec3::Zero();
};

/// Between steps. Owned by the servo.
struct VibrationGuard {
  double used_N_m = 0;       ///< K s when the spring pulled last
  double limit_N_m = 0;      ///< K s is held below it; 0: there is no limit
  double damping_Ns_m = 0;   ///< of the guard, while there is a limit and the spring pulls
  std::uint32_t alarms = 0;  ///< how often it has softened
  double dissipated_J = 0;   ///< what that and the damper took
  double open_s = 0;         ///< how long the finger has been in the open
  std::uint32_t steps = 0;
  SpringStep before{};
  std::array<AxisSwings, 3> axes{};
};

/// K for a surface of stiffness s, within the limit. RT-safe.
double limitedStiffness_N_m(const VibrationGuard& guard, double stiffness_N_m, double surface);

/// Watches what the spring does in this step; what it softens counts from the next one on. `full_N_m`: K without a
/// limit. RT-safe.
void watchVibration(VibrationGuard& guard, const VibrationSettings& settings, const SpringStep& step, double full_N_m,
                    const Vec3& velocity_m_s, double period_s);
/// Without force nothing swings; the limit stays. RT-safe.
void restVibration(VibrationGuard& guard);

}  // namespace hl

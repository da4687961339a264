// Arm: the moving part of a simulated device, from the motors' current to the tip. Frame D.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace hl {

/// On the thread that reads the device. RT-safe.
class Arm {
 public:
  /// `current_lag_s`: time constant of the motors' current loop; 0: the current is there at once.
  explicit Arm(double current_lag_s) : current_lag_s_(current_lag_s) {}
  virtual ~Arm() = default;

  virtual Vec3 tip_D() const = 0;
  virtual Vec3 velocity_D() const = 0;
  /// Where the encoders say that the tip is.
  virtual Vec3 countedTip_D() const = 0;
  /// Sets the force that the motors make at the tip: rounded by the DAC, cut to their peak, held until the next call.
  virtual void drive(const Vec3& force_N) = 0;
  /// What the motors make now, at the tip.
  virtual Vec3 motorForce_N() const = 0;
  /// Advances by `dt_s` under the motors and a force on the tip. Semi-implicit Euler; Coulomb friction implicitly, so
  /// that it stops a motion and never drives one.
  virtual void step(const Vec3& pull_N, double dt_s) = 0;
  /// Kinetic, and what end stops hold.
  virtual double energy_J() const = 0;
  /// Takes the tip there, moving; a place out of reach changes nothing.
  virtual void place(const Vec3& tip_D, const Vec3& velocity_m_s) = 0;

 protected:
  /// The current after `dt_s` on its way to what the DAC says; in the units of both.
  Vec3 currentAfter(const Vec3& now, const Vec3& commanded, double dt_s) const {
    return current_lag_s_ > 0 ? Vec3(commanded + std::exp(-dt_s / current_lag_s_) * (now - commanded)) : commanded;
  }

 private:
  double current_lag_s_;
};

}  // namespace hl

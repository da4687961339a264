// HandScript: what a simulated hand does over time, given in advance: samples with straight lines between them.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "base/vec.h"

namespace hl {

/// Times strictly increasing, in seconds; positions in metres, in the frame its user says.
struct HandScript {
  struct Sample {
    double time_s = 0;
    Vec3 position = Vec3::Zero();
    bool holds = true;  ///< from here on
    // In all samples or in none.
    std::optional<Eigen::Quaterniond> turned{};  ///< of the stylus; unit
    std::optional<double> gripper_rad{};
  };
  std::vector<Sample> samples;

  /// Before the first sample the first position, after the last one the last. Needs at least one sample.
  Vec3 at(double time_s) const;
  bool holdsAt(double time_s) const;
  /// The same for the stylus, turning at a constant rate the short way round between samples.
  std::optional<Eigen::Quaterniond> turnedAt(double time_s) const;
  std::optional<double> gripperAt(double time_s) const;
};

/// Writes the script of a person who gets instructions, one thing after the other.
class PersonScript {
 public:
  /// Waits at `start` for so long.
  PersonScript(const Vec3& start, double wait_s);

  PersonScript& moveTo(const Vec3& place, double speed_m_s);
  PersonScript& wait(double duration_s);
  /// Wants to be `way` farther, stays so for the time, and comes back.
  PersonScript& press(const Vec3& way, double speed_m_s, double duration_s);
  /// The same, `times` times, coming back at once.
  PersonScript& tap(const Vec3& way, double speed_m_s, int times);
  /// Wants to be `way` farther, goes `along` and back there, and comes back.
  PersonScript& stroke(const Vec3& way, const Vec3& along, double speed_m_s);
  /// Lets the device go, and takes it again.
  PersonScript& letGo(double duration_s);

  const HandScript& script() const { return script_; }
  double duration_s() const { return script_.samples.back().time_s; }

 private:
  Vec3 place() const { return script_.samples.back().position; }

  HandScript script_;
};

}  // namespace hl

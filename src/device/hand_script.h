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
    // In all samples or in none.
    std::optional<Eigen::Quaterniond> turned{};  ///< of the stylus; unit
    std::optional<double> gripper_rad{};
  };
  std::vector<Sample> samples;

  /// Before the first sample the first position, after the last one the last. Needs at least one sample.
  Vec3 at(double time_s) const;
  /// How the stylus is turned: at a constant rate the short way round between samples.
  std::optional<Eigen::Quaterniond> turnedAt(double time_s) const;
  std::optional<double> gripperAt(double time_s) const;
};

}  // namespace hl

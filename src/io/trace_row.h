// TraceRow: what one tick of a trace came to.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/vec.h"
#include "bodies/energy_book.h"

namespace hl {

/// A rigid body after a tick; world frame.
struct TracedBody {
  Vec3 origin = Vec3::Zero();  ///< m, of its object frame
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
  Vec3 velocity = Vec3::Zero();  ///< m/s, of the centre of mass
  Vec3 spin = Vec3::Zero();      ///< rad/s
};

/// A joint after a tick, along its coordinate: m and N, or rad and N m.
struct TracedJoint {
  double coordinate = 0;
  double velocity = 0;  ///< m/s or rad/s
  double force = 0;     ///< on body a: of spring, damper, table, friction and limits together
};

/// All bodies together.
struct TracedWorld {
  double kinetic_J = 0, gravity_J = 0;
  double spring_J = 0;     ///< in the springs and tables of joints
  EnergyBook book{};       ///< since the first row
  std::uint64_t hash = 0;  ///< hashOf()
};

/// World frame; seconds, metres, newtons, joules.
struct TraceRow {
  double t = 0;
  Vec3 finger = Vec3::Zero(), proxy = Vec3::Zero(), target = Vec3::Zero(), force = Vec3::Zero();
  int contacts = 0;  ///< active planes at the end of the tick
  int iterations = 0;
  double injected_J = 0;     ///< energy that the tick added to the spring (positive) or took (negative)
  std::int64_t tick_ns = 0;  ///< the one column that differs from run to run

  std::span<const TracedBody> bodies{};  ///< by key; empty: nothing in the scene moves as a body. Until the next row
  /// Those that have a coordinate, by key; empty: there are none. Until the next row.
  std::span<const TracedJoint> joints{};
  TracedWorld world{};  ///< if there are bodies
  /// The snap that holds the proxy, from 1 in the order of the scene; 0: none. Absent: the scene has none.
  std::optional<std::size_t> snap{};
  // Of the stylus, as the path says; absent: it does not.
  std::optional<Eigen::Quaterniond> turned{};
  std::optional<double> gripper_rad{};
};

}  // namespace hl

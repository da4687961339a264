// HandOrders: what a simulated hand is ordered to do, by one thread, for another that moves it.
#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>

#include "base/latest.h"
#include "base/vec.h"

namespace hl {

/// Lock-free; the writers of SimulatedHand are one thread. Frame D.
struct HandOrders {
  Latest<Vec3> goal_D{Vec3::Zero()};
  Latest<Eigen::Quaterniond> turn_D{Eigen::Quaterniond::Identity()};
  std::atomic<double> gripper_rad{0};
  std::atomic<bool> firm{false}, holds{true};
  std::atomic<std::uint32_t> buttons{0};
};

}  // namespace hl

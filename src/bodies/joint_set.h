// Joint set: all joints of a step in the solve (row_solver.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bodies/joint_tree.h"

namespace hl {

/// By one thread at a time.
struct JointSet {
  explicit JointSet(const World& world);
  /// 1/kg: of a coordinate while the trees, which are prepared, hold. RT-safe, as all below.
  double mobilityAlong(const JointBlock& block, std::span<const Node> nodes);
  /// The masses of a block that closes a loop.
  void prepareLoop(JointBlock& block, std::span<const Node> nodes);
  /// Of a sweep over the joints with these numbers, in updates of single rows.
  std::size_t work(std::span<const std::uint32_t> numbers) const;
  /// One sweep of the solver over them; they are all that connect their bodies, directly or by others.
  void sweep(std::span<const std::uint32_t> numbers, std::span<Node> nodes, double period_s);
  void searchOn(std::span<const std::uint32_t> numbers, std::span<Node> nodes, double part, bool anew);
  /// Of another set of the same world.
  void copyFrom(const JointSet& other, std::span<const std::uint32_t> numbers);

  std::vector<JointBlock> blocks;  ///< as World::joints
  JointTrees trees;
};

/// Some of the joints: those of an island, or all that are awake.
struct JointPart {
  JointSet* set = nullptr;
  std::span<const std::uint32_t> numbers{};
};

}  // namespace hl

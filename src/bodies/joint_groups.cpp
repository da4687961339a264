#include "bodies/joint_groups.h"

#include <algorithm>

namespace hl {

namespace {

std::pair<std::uint32_t, std::uint32_t> numbersOf(const Joint& joint, const World& world) {
  const auto number = [&](std::uint64_t key) { return static_cast<std::uint32_t>(world.numberOf(key)); };
  return std::minmax({number(joint.body_a), number(joint.body_b)});
}

}  // namespace

std::vector<std::uint32_t> jointGroups(const World& world) {
  std::vector<std::uint32_t> group(world.bodies.size());
  for (std::uint32_t i = 0; i < group.size(); ++i) group[i] = i;
  const auto root = [&](std::uint32_t i) {
    while (group[i] != i) i = group[i];
    return i;
  };
  for (const Joint& joint : world.joints) {
    if (joint.body_b == 0) continue;
    const auto [a, b] = numbersOf(joint, world);
    const auto [low, high] = std::minmax({root(a), root(b)});
    group[high] = low;
  }
  for (std::uint32_t i = 0; i < group.size(); ++i) group[i] = root(i);
  return group;
}

JoinedPairs::JoinedPairs(const World& world) {
  for (const Joint& joint : world.joints) {
    if (joint.body_b != 0 && !joint.collide) pairs_.push_back(numbersOf(joint, world));
  }
  std::sort(pairs_.begin(), pairs_.end());
}

bool JoinedPairs::has(std::uint32_t a, std::uint32_t b) const {
  return std::binary_search(pairs_.begin(), pairs_.end(), std::pair(std::min(a, b), std::max(a, b)));
}

}  // namespace hl

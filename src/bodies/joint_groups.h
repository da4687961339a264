// Joint groups: which bodies the joints of a world connect.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bodies/world.h"

namespace hl {

/// For each body the lowest number of the bodies that joints connect with it, through others too.
std::vector<std::uint32_t> jointGroups(const World& world);

/// Pairs of bodies that do not collide, since a joint connects them.
class JoinedPairs {
 public:
  explicit JoinedPairs(const World& world);
  /// Numbers of bodies. RT-safe.
  bool has(std::uint32_t a, std::uint32_t b) const;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;  // sorted, the lower number first
};

}  // namespace hl

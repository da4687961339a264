// A query in single precision, for the boxes of a WideBvh and for the packed coordinates of one block. All margins are
// on the side of proposing too much: distances grow by more than single precision can be off.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/wide_bvh_query.h"

namespace hl {

/// Of all coordinates that take part: some sixteen roundings of 2^-24 each; none of the sums has more.
inline constexpr double kWideRounding = 1e-6;

inline double largestOf(const double (&v)[3]) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

/// The moving sphere for boxes. On each axis it enters a box at (bound[near] - near_from) * per_motion and leaves it at
/// (bound[1 - near] - far_from) * per_motion, times as fractions of the motion. Beside, no box farther than `reach`
/// from the box [way_min, way_max] of the way up to the limit is entered.
struct BoxQuery {
  float near_from[3], far_from[3], per_motion[3];
  int near[3];
  float way_min[3], way_max[3];
  float reach2;
  float limit;
  float from[3], motion[3];
};

/// Shortens the way to `limit` (a fraction of the motion).
inline void setLimit(BoxQuery& box, double limit) {
  constexpr float kLater = 1 + 1e-6f;  // of the time: its own rounding
  box.limit = static_cast<float>(limit) * kLater;
  for (int i = 0; i < 3; ++i) {
    const float end = box.from[i] + box.limit * box.motion[i];
    box.way_min[i] = std::min(box.from[i], end);
    box.way_max[i] = std::max(box.from[i], end);
  }
}

inline BoxQuery boxQuery(const WideTree& tree, const WideQuery& query) {
  constexpr double kMostPerMotion = 1e30;  // an axis without motion: finite, so that zero times it is zero
  const double size = tree.extent + largestOf(query.from) + largestOf(query.motion) + query.reach;
  const double reach = query.reach + kWideRounding * size;
  BoxQuery box;
  for (int i = 0; i < 3; ++i) {
    box.from[i] = static_cast<float>(query.from[i]);
    box.motion[i] = static_cast<float>(query.motion[i]);
    box.near[i] = query.motion[i] < 0 ? 1 : 0;
    const double toward = query.motion[i] < 0 ? -reach : reach;
    box.near_from[i] = static_cast<float>(query.from[i] + toward);
    box.far_from[i] = static_cast<float>(query.from[i] - toward);
    const double per_motion = 1 / std::max(std::abs(query.motion[i]), 1 / kMostPerMotion);
    box.per_motion[i] = static_cast<float>(query.motion[i] < 0 ? -per_motion : per_motion);
  }
  box.reach2 = static_cast<float>(reach * reach * (1 + kWideRounding));
  setLimit(box, 1);
  return box;
}

/// The moving sphere in the packed coordinates of a block.
struct BlockQuery {
  float from[3], motion[3];
  float reach;
};

inline BlockQuery blockQuery(const WideBlock& block, const WideQuery& query) {
  constexpr double kPacked = 1;           // steps: a vertex is off by at most sqrt(3) / 2
  constexpr double kBlockSize = 1 << 17;  // more than the sum of the coordinates of a vertex
  const double per_step = block.per_step;
  BlockQuery packed;
  double size = kBlockSize;
  for (int i = 0; i < 3; ++i) {
    const double from = (query.from[i] - static_cast<double>(block.origin[i])) * per_step;
    const double motion = query.motion[i] * per_step;
    packed.from[i] = static_cast<float>(from);
    packed.motion[i] = static_cast<float>(motion);
    size += std::abs(from) + std::abs(motion);
  }
  const double reach = query.reach * per_step;
  packed.reach = static_cast<float>((reach + kPacked + kWideRounding * size) * (1 + kWideRounding));
  return packed;
}

}  // namespace hl

// A query in single precision, for the boxes of a WideBvh and for the quantised coordinates of one block. All margins
// are conservative: distances grow by more than the error of single precision, so too much is proposed, never too
// little.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/wide_bvh_layout.h"

namespace hl {

/// Relative error over all coordinates involved: about sixteen roundings of 2^-24 each; no sum has more.
inline constexpr double kWideRounding = 1e-6;

inline double largestOf(const double (&v)[3]) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

/// The same for boxes: the frame adds a product and a sum of three terms per coordinate.
inline constexpr double kFramedRounding = 3e-6;

/// The moving sphere for box tests, up to `limit` (a fraction of the motion).
struct BoxQuery {
  alignas(16) float from[4], motion[4];  ///< the fourth is 0
  float reach2, limit;
};

/// Shortens the way to `limit`.
inline void setLimit(BoxQuery& box, double limit) {
  constexpr float kLater = 1 + 1e-6f;  // factor on the time, for its rounding
  box.limit = static_cast<float>(limit) * kLater;
}

inline BoxQuery boxQuery(const WideTree& tree, const WideQuery& query) {
  const double size = tree.extent + largestOf(query.from) + largestOf(query.motion) + query.reach;
  const double reach = query.reach + kFramedRounding * size;
  BoxQuery box{};
  for (int i = 0; i < 3; ++i) {
    box.from[i] = static_cast<float>(query.from[i]);
    box.motion[i] = static_cast<float>(query.motion[i]);
  }
  // Lanes without a child are infinitely far away: no query reaches them.
  constexpr double kFarthest2 = std::numeric_limits<float>::max();
  box.reach2 = static_cast<float>(std::min(reach * reach * (1 + kFramedRounding), kFarthest2));
  setLimit(box, 1);
  return box;
}

/// The moving sphere in the quantised coordinates of a block.
struct BlockQuery {
  float from[3], motion[3];
  float reach;
};

inline BlockQuery blockQuery(const WideBlock& block, const WideQuery& query) {
  constexpr double kPacked = 1;           // steps: the error of a vertex is at most sqrt(3) / 2
  constexpr double kBlockSize = 1 << 17;  // more than the sum of the coordinates of a vertex
  constexpr double kMaxSize = 1e18;       // steps: sums of its squares do not overflow single precision
  const double per_step = block.per_step;
  double from[3], motion[3], size = kBlockSize;
  for (int i = 0; i < 3; ++i) {
    from[i] = (query.from[i] - static_cast<double>(block.origin[i])) * per_step;
    motion[i] = query.motion[i] * per_step;
    size += std::abs(from[i]) + std::abs(motion[i]);
  }
  const double reach = query.reach * per_step;
  // A block this small compared to the query cannot be tested in single precision: all its primitives are proposed.
  const bool fits = size + reach < kMaxSize;
  BlockQuery packed;
  for (int i = 0; i < 3; ++i) {
    packed.from[i] = fits ? static_cast<float>(from[i]) : 0;
    packed.motion[i] = fits ? static_cast<float>(motion[i]) : 0;
  }
  const double grown = (reach + kPacked + kWideRounding * size) * (1 + kWideRounding);
  packed.reach = fits ? static_cast<float>(grown) : std::numeric_limits<float>::infinity();
  return packed;
}

}  // namespace hl

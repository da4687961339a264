// Every tolerance of the tick, in metres, with its reason. All scale with the proxy radius and the size of the scene.
#pragma once

#include <cmath>
#include <limits>

namespace hl {

/// Distances in a scene of coordinates up to `extent` carry a rounding error of some units of eps * extent.
struct Tolerances {
  double skin;      ///< the width within which a primitive counts as a contact
  double reach;     ///< radius at which the proxy is held; above the nominal one, so that rounding never enters it
  double swept;     ///< radius of the sweep: less by a rounding, so that on a flat surface it stops at no neighbour
  double touching;  ///< a primitive no farther than this is a contact (a plane); all others are swept
  double feasible;  ///< by which a plane may be violated; far below the skin, far above rounding
  double rest;      ///< a step shorter than this is no step

  /// rad: so far the plane of a neighbour within the skin may lean, as an edge is round: skin = radius lean^2 / 2.
  double lean() const { return std::sqrt(2 * skin / (reach - 2 * skin)); }

  static Tolerances of(double radius, double extent) {
    constexpr double kEps = std::numeric_limits<double>::epsilon();
    constexpr double kSkinPerRadius = 1e-10;
    constexpr double kSkinPerExtent = 512 * kEps;
    const double skin = kSkinPerRadius * radius + kSkinPerExtent * (extent + radius);
    const double rest = 8 * kEps * (extent + radius);
    return {skin, radius + 2 * skin, radius + 2 * skin - rest, radius + 3 * skin, skin / 4, rest};
  }
};

/// The local minimum is reached when the step that the solver still wants is below this fraction of the gap: the way
/// from the proxy to the finger, which is what is felt.
inline constexpr double kRestPerGap = 1e-8;

/// A sweep is cut to this many times the size of the scene: the impact time's rounding then stays below the skin.
inline constexpr double kSweepPerExtent = 100;

}  // namespace hl

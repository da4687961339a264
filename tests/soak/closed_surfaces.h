// Surfaces that nothing can go around, of random form, and what decides whether a place is behind them.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "geometry/scenes.h"
#include "proxy/proxy.h"

namespace hl::soak {

inline constexpr std::array kClosedKinds{"height field", "volume", "expression"};

/// Metres, world.
struct ClosedSurface {
  std::shared_ptr<const Snapshot> snapshot;
  ProxySettings settings;
  Vec3 centre = Vec3::Zero();
  double half = 0;          ///< radii; the surface lies about within -half..half of the centre
  std::vector<Vec3> marks;  ///< radii from the centre: places of the surface
  /// Of no place within a cell of the surface, or within the stated error, it is known.
  std::function<Site(const Vec3& place)> siteOf;
  /// The place, where fingers may go; else one near it where they may. A height field is a basin with a rim.
  std::function<Vec3(const Vec3& place)> confined = [](const Vec3& place) { return place; };
};

/// `kind`: of kClosedKinds.
ClosedSurface drawClosed(test::Random& random, std::size_t kind);

}  // namespace hl::soak

// Places: points in an order of their own, whatever order they came in.
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "base/vec.h"

namespace hl {

/// By x, then y, then z.
inline bool precedesPlace(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// Ascending, each once.
inline std::vector<Vec3> sortedPlaces(std::vector<Vec3> places) {
  std::sort(places.begin(), places.end(), precedesPlace);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace hl

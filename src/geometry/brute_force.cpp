#include "geometry/brute_force.h"

namespace hl {

std::size_t BruteForceIndex::overlap(const Vec3&, double, FunctionRef<void(ElementId)> visit) const {
  for (std::size_t i = 0; i < primitives_; ++i) visit(static_cast<std::uint32_t>(i));
  return primitives_;
}

std::size_t BruteForceIndex::sweep(const Vec3&, const Vec3&, double, double,
                                   FunctionRef<double(ElementId, double)> visit) const {
  double limit = 1;
  for (std::size_t i = 0; i < primitives_; ++i) limit = visit(static_cast<std::uint32_t>(i), limit);
  return primitives_;
}

IndexStats BruteForceIndex::stats() const { return IndexStats{0, primitives_, 0, 0}; }

}  // namespace hl

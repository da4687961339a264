// CloudIndex: finds the points or surfels of a cloud near a moving ball, by the bounds of its blocks.
#pragma once

#include <cstddef>

#include "surfaces/placed_cloud.h"
#include "surfaces/walked_index.h"

namespace hl {

class CloudIndex final : public WalkedIndex {
 public:
  /// The cloud must outlive it. Takes no memory: the bounds are those of its points.
  explicit CloudIndex(const PlacedCloud& cloud);

  IndexStats stats() const override;

 private:
  std::size_t walk(const GridBall& ball, Visit visit) const override;

  const PlacedCloud& cloud_;
};

}  // namespace hl

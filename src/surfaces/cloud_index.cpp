#include "surfaces/cloud_index.h"

#include "surfaces/cloud_walk.h"

namespace hl {

CloudIndex::CloudIndex(const PlacedCloud& cloud)
    : WalkedIndex(cloud.frame(), cloud.bounds(), cloud.stretch() * cloud.points()->usualSpacing()), cloud_(cloud) {}

std::size_t CloudIndex::walk(const GridBall& ball, Visit visit) const {
  return CloudWalk(cloud_, scale(), ball).run(visit);
}

IndexStats CloudIndex::stats() const {
  const CloudPoints& points = *cloud_.points();
  IndexStats stats;
  stats.bytes = sizeof(*this);
  stats.depth = points.levels();
  stats.leaves = points.blocks();
  for (int level = 1; level < points.levels(); ++level) stats.nodes += points.countOn(level);
  return stats;
}

}  // namespace hl

#include "surfaces/cloud_points.h"

namespace hl {

std::size_t CloudPoints::bytes() const {
  std::size_t bytes = sizeof(*this) + blocks_.capacity() * sizeof(Block) + packed_.capacity() * sizeof(packed_[0]) +
                      colours_.capacity() * sizeof(Rgb);
  for (const HugeVector<LatticeBox>& level : nodes_) bytes += level.capacity() * sizeof(LatticeBox);
  return bytes;
}

}  // namespace hl

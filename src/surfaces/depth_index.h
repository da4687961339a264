// DepthIndex: finds the triangles of a depth image near a moving ball, by its tiles (depth_walk.h).
#pragma once

#include <cstddef>

#include "surfaces/depth_frame.h"
#include "surfaces/walked_index.h"

namespace hl {

class DepthIndex final : public WalkedIndex {
 public:
  /// The frame must outlive it.
  explicit DepthIndex(const DepthFrame& frame);

  IndexStats stats() const override;

 private:
  std::size_t walk(const GridBall& ball, Visit visit) const override;

  const DepthFrame& frame_;
};

}  // namespace hl

// FrameVolumes: the volumes of a frame, each decoded once for all of its surfaces; and surfaces at another value.
#pragma once

#include <hl.pb.h>

#include <map>
#include <memory>
#include <string>

#include "base/memory_budget.h"
#include "io/decode_volumes.h"
#include "scene/scene_limits.h"

namespace hl {

class FrameVolumes {
 public:
  /// Both must outlive it. `size` counts what its shapes need.
  FrameVolumes(const MemoryBudget& memory, ModelSizes& size) : memory_(memory), size_(size) {}

  /// What the item shows of `in`, which stays where it is. Throws hl::Error.
  std::shared_ptr<const Shape> surface(const proto::Volume& in, const proto::Item& item, const std::string& where);
  /// The same samples at another value. Throws hl::Error if `before` is no surface of a volume.
  std::shared_ptr<const Shape> surfaceAt(const Shape* before, const proto::IsoUpdate& in,
                                         const std::string& where) const;

 private:
  const PlacedVolume& volumeOf(const proto::Volume& in, const std::string& where);

  const MemoryBudget& memory_;
  ModelSizes& size_;
  std::map<const proto::Volume*, PlacedVolume> volumes_;
};

}  // namespace hl

// Volumes in messages, for recordings and for the process that reads foreign files. Samples come in parts, which are
// put where they stay as they come: nothing is copied twice, and nobody holds two of a large volume.
#pragma once

#include <recording.pb.h>

#include <cstddef>
#include <functional>
#include <memory>

#include "io/volume_sink.h"
#include "surfaces/iso_surface.h"
#include "surfaces/sample_room.h"

namespace hl {

void toProto(const VolumeHeader& header, proto::RecordedVolume& out);
/// Throws hl::Error for what makes no sense.
VolumeHeader headerOf(const proto::RecordedVolume& in);
GridFrame frameOf(const proto::RecordedVolume& in);
IsoValue isoOf(const proto::RecordedVolume& in);
/// Null: there is none.
std::shared_ptr<const MatterTable> matterOf(const proto::RecordedVolume& in);

/// Calls `take` with each part; the first has all but most of the samples. `like`: the number of a surface of the same
/// volume that was written before; 0: there is none.
void writeVolume(const IsoSurface& surface, std::uint64_t like,
                 const std::function<void(proto::RecordedVolume& part)>& take);

/// Puts a volume together.
class VolumeCollector {
 public:
  /// Throws hl::Error if the samples take more than `most_bytes`.
  VolumeCollector(const VolumeHeader& header, std::size_t most_bytes);
  /// Throws hl::Error for too many.
  void add(const void* samples, std::size_t bytes) { room_.add(samples, bytes); }
  const VolumeHeader& header() const { return header_; }
  /// Once. Builds its pyramid. Throws hl::Error if samples lack.
  std::shared_ptr<const Volume> take();

 private:
  VolumeHeader header_;
  SampleRoom room_;
};

}  // namespace hl

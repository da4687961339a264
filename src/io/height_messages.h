// Height fields in messages, for recordings and for the process that reads foreign files. Samples come in parts, which
// are put where they stay as they come: nothing is copied twice, and nobody holds two of a large field.
#pragma once

#include <recording.pb.h>

#include <cstddef>
#include <functional>
#include <memory>

#include "io/height_sink.h"
#include "surfaces/depth_frame.h"
#include "surfaces/height_field.h"
#include "surfaces/sample_room.h"

namespace hl {

void toProto(const HeightHeader& header, proto::RecordedHeights& out);
/// Throws hl::Error for what makes no sense.
HeightHeader headerOf(const proto::RecordedHeights& in);

/// Calls `take` with each part; the first has all but most of the samples. Material and name apart.
void writeHeights(const HeightField& field, const std::function<void(proto::RecordedHeights& part)>& take);
void writeDepths(const DepthFrame& frame, const std::function<void(proto::RecordedHeights& part)>& take);

/// Puts a height field or a depth image together.
class HeightCollector {
 public:
  /// Throws hl::Error if the samples take more than `most_bytes`.
  HeightCollector(const HeightHeader& header, std::size_t most_bytes);
  /// Throws hl::Error for too many.
  void add(const void* samples, std::size_t bytes) { samples_.add(samples, bytes); }
  /// Once. Builds its pyramid. Throws hl::Error if samples lack, or where no such surface can be.
  std::shared_ptr<const PrimitiveSource> take();

 private:
  HeightHeader header_;
  SampleRoom samples_;
};

}  // namespace hl

// Height fields of scene files and of clients' frames, from messages of proto/hl.proto. Every number is checked.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <memory>

#include "surfaces/depth_frame.h"
#include "surfaces/height_field.h"

namespace hl {

/// Memory that a field of the message takes, bytes; at most what its samples are.
std::uint64_t bytesToMakeHeights(const proto::Heights& in);

/// A height field, or a depth image: then `before`, if it is one too, is what its object showed before. Throws
/// hl::Error for what makes no sense, or names a file.
std::shared_ptr<const PrimitiveSource> decodeHeights(const proto::Heights& in, const PrimitiveSource* before = nullptr);

/// A field from a file with the spacing and vertical scale that the message has over what the file says; or a depth
/// image of its samples. Throws hl::Error.
std::shared_ptr<const PrimitiveSource> withSpacing(const std::shared_ptr<const PrimitiveSource>& field,
                                                   const proto::Heights& in);

}  // namespace hl

// Implicit surfaces of scene files, of clients' frames and of recordings, from and to messages of proto/hl.proto. Every
// number is checked.
#pragma once

#include <recording.pb.h>

#include <cstdint>
#include <memory>

#include "surfaces/implicit/implicit_surface.h"

namespace hl {

/// Memory that one takes at most, bytes.
std::uint64_t bytesToMakeImplicit(const proto::Implicit& in);

/// Throws hl::Error for what makes no sense, or cannot be kept within its error.
std::shared_ptr<const ImplicitSurface> decodeImplicit(const proto::Implicit& in);

void toProto(const ImplicitSurface& surface, proto::RecordedImplicit& out);
/// Throws hl::Error.
std::shared_ptr<const PrimitiveSource> implicitOf(const proto::RecordedImplicit& in);

}  // namespace hl

// Volumes of scene files and of clients' frames, from messages of proto/hl.proto. Every number is checked.
#pragma once

#include <hl.pb.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "surfaces/iso_surface.h"

namespace hl {

/// Samples, and where they lie.
struct PlacedVolume {
  std::shared_ptr<const Volume> volume;
  GridFrame frame;
  std::optional<IsoValue> iso{};  ///< of its surface, as its file says; nothing: it does not
};

/// Along the axes, `spacing` m apart, with the middle of the grid at the origin.
GridFrame uprightFrame(const std::array<std::uint32_t, 3>& side, const Vec3& spacing);

/// Memory that a volume of the message takes, bytes; at most what its samples are.
std::uint64_t bytesToMakeVolume(const proto::Volume& in);

/// Throws hl::Error for what makes no sense, or names a file or a builtin.
PlacedVolume decodeVolume(const proto::Volume& in);

/// What a file or a builtin holds, with the spacing that the message has over what it says. Throws hl::Error.
PlacedVolume withSpacing(PlacedVolume volume, const proto::Volume& in);

/// What a message says of the surface of a volume.
IsoChoice isoChoiceOf(const proto::Volume& in);
IsoChoice isoChoiceOf(const proto::Item& in);
IsoChoice isoChoiceOf(const proto::IsoChange& in);
IsoChoice isoChoiceOf(const proto::IsoUpdate& in);

/// What the message says that the values feel like; null: nothing. Throws hl::Error for what makes no sense.
std::shared_ptr<const MatterTable> matterOf(const proto::Volume& in);

/// The surface that is asked for, over what the volume's file says. Throws hl::Error where there is none.
std::shared_ptr<const IsoSurface> isoSurfaceOf(const PlacedVolume& volume, const IsoChoice& iso,
                                               std::shared_ptr<const MatterTable> matter = nullptr);

}  // namespace hl

// Iso shape: the surface of a volume as an object of a scene, and the same object at another iso value.
#pragma once

#include <cstdint>
#include <memory>

#include "scene/snapshot.h"
#include "surfaces/iso_surface.h"

namespace hl {

/// Null: the shape is no surface of a volume, or a client has brought it.
const IsoSurface* isoSurfaceOf(const Instance& instance);

/// The same surface with its material at another value, which costs some 50 us, whatever the volume.
/// `of` is the surface of a volume. Throws hl::Error for a value that is not finite. Setup only.
std::shared_ptr<const Shape> withIso(const Shape& of, const IsoChoice& choice);

/// A material with what the matter of a volume has to say at this value (surfaces/matter.h).
Material materialAt(const IsoSurface& surface, Material material);
/// As withIso(), for the shape and the material of an instance.
void setIso(Instance& instance, const IsoChoice& choice);

/// The key of the surface whose value is to be changed; `surface` is that key, or 0 for the only one. Throws hl::Error,
/// which says what there is, if there is no such surface or if the value is not finite.
std::uint64_t checkIsoChange(const Snapshot& scene, std::uint64_t surface, const IsoChoice& choice);

}  // namespace hl

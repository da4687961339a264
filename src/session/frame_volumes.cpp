#include "session/frame_volumes.h"

#include <cmath>

#include "base/error.h"
#include "scene/iso_shape.h"

namespace hl {

namespace {

constexpr std::size_t kSurface_bytes = 4096;  // of a volume, without it

}  // namespace

std::shared_ptr<const Shape> FrameVolumes::surface(const proto::Volume& in, const proto::Item& item,
                                                   const std::string& where) {
  const PlacedVolume& volume = volumeOf(in, where);
  return makeCounted(memory_, kSurface_bytes, [&] {
    try {
      return makeShape(isoSurfaceOf(volume, isoChoiceOf(item).after(isoChoiceOf(in)), matterOf(in)));
    } catch (const Error& error) {
      throw Error(where + ": " + error.what());
    }
  });
}

std::shared_ptr<const Shape> FrameVolumes::surfaceAt(const Shape* before, const proto::IsoUpdate& in,
                                                     const std::string& where) const {
  if (before == nullptr || dynamic_cast<const IsoSurface*>(before->source.get()) == nullptr)
    throw Error(where + ": item " + std::to_string(in.item()) + " of object " + std::to_string(in.object()) +
                " is no surface of a volume");
  if (!std::isfinite(in.value())) throw Error(where + ".value must be a finite number");
  return makeCounted(memory_, kSurface_bytes, [&] { return withIso(*before, isoChoiceOf(in)); });
}

// Counted once, until the last of its surfaces goes.
const PlacedVolume& FrameVolumes::volumeOf(const proto::Volume& in, const std::string& where) {
  PlacedVolume& placed = volumes_[&in];
  if (placed.volume) return placed;
  size_.add(bytesToMakeVolume(in), where + ": ");
  MemoryShare memory(memory_);
  memory.take(bytesToMakeVolume(in));
  try {
    placed = decodeVolume(in);
  } catch (const Error& error) {
    throw Error(where + ": " + error.what());
  }
  memory.set(placed.volume->bytes());
  placed.volume = withShare(std::move(placed.volume), std::move(memory));
  return placed;
}

}  // namespace hl

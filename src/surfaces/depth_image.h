// DepthImage: the depths that a camera sees, and how they follow from one image to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "surfaces/depth_camera.h"
#include "surfaces/depth_pixels.h"
#include "surfaces/depth_tiles.h"
#include "surfaces/height_grid.h"

namespace hl {

/// Immutable.
struct DepthImage {
  DepthImage(DepthPixels depths, const DepthCamera& by, std::vector<std::uint8_t> held_for = {})
      : pixels(std::move(depths)), camera(by), tiles(pixels, camera), held(std::move(held_for)) {}
  std::size_t bytes() const { return sizeof(*this) + pixels.bytes() + tiles.bytes() + held.capacity(); }

  DepthPixels pixels;
  DepthCamera camera;
  DepthTiles tiles;
  std::vector<std::uint8_t> held;  ///< for each pixel: images since it was last seen; empty: all are of this image
};

/// The depths of an image, `scale_m` metres for each unit, each of them drawn toward what `before` has at the pixel:
/// before + (1 - smoothing) (now - before), where both are one surface. `smoothing`: 0..1, of one image to the next;
/// above 0, a pixel that is missing keeps what it was for up to kMaxHeld images. `before` may be null, or an image of
/// another size or camera: then it does not count.
std::shared_ptr<const DepthImage> smoothed(const HeightGrid& now, double scale_m, const DepthCamera& camera,
                                           const DepthImage* before, double smoothing);

/// A quarter of a second at 30 Hz.
inline constexpr std::uint8_t kMaxHeld = 8;

}  // namespace hl

// DepthFrame: an image of a depth camera as a surface of triangles, two between four pixels, which are made when they
// are asked for. Where neighbouring depths differ too much there is a gap: what lies behind is another thing.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/primitive_source.h"
#include "surfaces/depth_camera.h"
#include "surfaces/depth_tiles.h"
#include "surfaces/grid_frame.h"
#include "surfaces/height_cell.h"
#include "surfaces/height_grid.h"

namespace hl {

/// A depth image, shared by its copies in other places. Immutable.
struct DepthImage {
  DepthImage(std::shared_ptr<const HeightGrid> depths, const DepthCamera& by, std::vector<std::uint8_t> held_for = {})
      : grid(std::move(depths)), camera(by), tiles(*grid, camera), held(std::move(held_for)) {}
  std::size_t bytes() const { return grid->bytes() + tiles.bytes() + held.capacity(); }

  std::shared_ptr<const HeightGrid> grid;  ///< depths; what is missing, or not above 0, is none
  DepthCamera camera;
  DepthTiles tiles;
  std::vector<std::uint8_t> held;  ///< for each pixel: images since it was last seen; empty: all are of this image
};

/// Numbers of triangles as of a height field (height_cell.h). An image in which nothing is joined is empty. Immutable.
class DepthFrame final : public PrimitiveSource {
 public:
  /// `frame`: from (x / z depth, y / z depth, depth) of the camera to metres. Throws hl::Error where something lies
  /// beyond 1e9 m, or where the frame's axes have no volume.
  DepthFrame(std::shared_ptr<const DepthImage> image, const GridFrame& frame);

  ElementId count() const override;
  std::uint64_t triangles() const override { return image_->tiles.triangles(); }
  std::array<Vec3, 3> corners(ElementId id) const override;
  /// At a pixel by central differences among the neighbours that it is one surface with; in between interpolated.
  Vec3 trueNormal(ElementId id, const Vec3& point) const override;
  Box bounds() const override { return bounds_; }
  std::unique_ptr<const SpatialIndex> makeIndex() const override;
  std::size_t bytes() const override { return sizeof(*this); }
  SharedMemory shared() const override { return {image_.get(), image_->bytes()}; }
  /// 0: the triangles are the surface. How well the camera measures, no image tells.
  double error_m() const override { return 0; }
  /// Matter is what the camera does not see: behind the surface, as far as there is one.
  Site siteOf(const Vec3& point) const override;
  std::shared_ptr<const PrimitiveSource> placed(const Mat3& linear, const Vec3& offset) const override;
  DrawnMesh drawn(std::size_t most_triangles) const override;

  const std::shared_ptr<const DepthImage>& image() const { return image_; }
  const GridFrame& frame() const { return frame_; }
  /// Whether the triangle is there. RT-safe.
  bool exists(const HeightCell& cell) const;
  Vec3 pointAt(std::uint32_t column, std::uint32_t row) const;

 private:
  using Corners = std::array<std::array<std::uint32_t, 2>, 3>;  // column and row of each

  const HeightGrid& grid() const { return *image_->grid; }
  double depthAt(const std::array<std::uint32_t, 2>& pixel) const { return grid().at(pixel[0], pixel[1]); }
  Corners cornersOf(const HeightCell& cell) const;
  Vec3 normalAt(std::uint32_t column, std::uint32_t row, const Vec3& otherwise) const;
  DrawnMesh every(std::uint32_t step) const;
  Box boundsOfTiles() const;

  std::shared_ptr<const DepthImage> image_;
  GridFrame frame_;
  Mat3 inverse_;
  bool mirrored_ = false;
  Box bounds_;
};

/// From a camera at the origin that looks along -z with y up, as GL's does, whose depths are in units of `scale_m`.
GridFrame cameraFrame(double scale_m);

/// The depths of an image in metres, each of them drawn toward what `before` has at the pixel: before + (1 - smoothing)
/// (now - before), where both are one surface. `smoothing`: 0..1, of one image to the next; above 0, a pixel that is
/// missing keeps what it was for up to kMostHeld images. `before` may be null, or an image of another size or camera:
/// then it does not count.
std::shared_ptr<const DepthImage> smoothed(const HeightGrid& now, double scale_m, const DepthCamera& camera,
                                           const DepthImage* before, double smoothing);

/// A quarter of a second at 30 Hz.
inline constexpr std::uint8_t kMostHeld = 8;

}  // namespace hl

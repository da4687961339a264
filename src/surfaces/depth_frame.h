// DepthFrame: an image of a depth camera as a surface of triangles, two between four pixels, which are made when they
// are asked for. Where neighbouring depths differ too much there is a gap: what lies behind is another thing.
#pragma once

#include <array>
#include <memory>

#include "geometry/primitive_source.h"
#include "surfaces/depth_cells.h"

namespace hl {

/// Numbers of triangles as of a height field (height_cell.h). An image in which nothing is joined is empty. Immutable;
/// shares the image with its copies in other places.
class DepthFrame final : public PrimitiveSource {
 public:
  /// `frame`: from (x / z depth, y / z depth, depth) of the camera to metres. Throws hl::Error where something lies
  /// beyond 1e9 m, or where the frame's axes have no volume.
  DepthFrame(std::shared_ptr<const DepthImage> seen, const GridFrame& frame);

  ElementId count() const override;
  std::uint64_t triangles() const override { return image().tiles.triangles(); }
  std::array<Vec3, 3> corners(ElementId id) const override { return cells_.corners(id); }
  /// At a pixel by central differences among the neighbours that it is one surface with; in between interpolated.
  Vec3 trueNormal(ElementId id, const Vec3& point) const override;
  bool hasTexcoords() const override { return true; }
  Vec2 texcoord(ElementId id, std::size_t corner) const override {
    return texcoordAt(cells_.pixelsOf(cellOf(id, pixels().columns()))[corner]);
  }
  Box bounds() const override { return bounds_; }
  std::unique_ptr<const SpatialIndex> makeIndex() const override;
  std::size_t bytes() const override { return sizeof(*this); }
  SharedMemory shared() const override { return {&image(), image().bytes()}; }
  /// 0: the triangles are the surface. No image gives how well the camera measures.
  double error_m() const override { return 0; }
  /// Matter is what the camera does not see: behind the surface, as far as there is one.
  Site siteOf(const Vec3& point) const override;
  std::shared_ptr<const PrimitiveSource> placed(const Mat3& linear, const Vec3& offset) const override;
  DrawnMesh drawn(std::size_t most_triangles) const override;

  const DepthCells& cells() const { return cells_; }
  const DepthImage& image() const { return *cells_.image(); }
  const GridFrame& frame() const { return cells_.frame(); }

 private:
  const DepthPixels& pixels() const { return cells_.pixels(); }
  Site siteInGap(const DepthCells::Pixel& pixel, double depth) const;
  Vec3 normalAt(std::uint32_t column, std::uint32_t row, const Vec3& otherwise) const;
  Vec2 texcoordAt(const DepthCells::Pixel& pixel) const;
  DrawnMesh every(std::uint32_t step) const;
  Box boundsOfTiles() const;
  void extendBy(int level, std::uint32_t column, std::uint32_t row, Box& box) const;

  DepthCells cells_;
  Mat3 inverse_;
  Box bounds_;
};

/// From a camera at the origin that looks along -z with y up, as GL's does, whose depths are in units of `scale_m`.
GridFrame cameraFrame(double scale_m);

}  // namespace hl

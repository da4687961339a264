// DepthCells: the triangles of a depth image, two between four pixels, in space.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "surfaces/depth_image.h"
#include "surfaces/grid_frame.h"
#include "surfaces/height_cell.h"

namespace hl {

/// Numbers of triangles as of a height field (height_cell.h). Immutable; RT-safe.
class DepthCells {
 public:
  using Pixel = std::array<std::uint32_t, 2>;  ///< column and row

  /// `frame`: from (x / z depth, y / z depth, depth) of the camera to metres.
  DepthCells(std::shared_ptr<const DepthImage> image, const GridFrame& frame)
      : image_(std::move(image)), frame_(frame), mirrored_(frame.axes.determinant() < 0), plain_(isPlain()) {}

  const std::shared_ptr<const DepthImage>& image() const { return image_; }
  const DepthPixels& pixels() const { return image_->pixels; }
  const GridFrame& frame() const { return frame_; }
  /// Whether the frame turns a right hand into a left one.
  bool mirrored() const { return mirrored_; }

  /// Metres along the axis; 0: none.
  float depthAt(const Pixel& pixel) const { return pixels().at(pixel[0], pixel[1]); }
  /// Metres.
  Vec3 pointAt(const Pixel& pixel) const { return pointAt(pixel[0], pixel[1], depthAt(pixel)); }
  Vec3 pointAt(double column, double row, double depth) const {
    return frame_.point(image_->camera.across(column) * depth, image_->camera.down(row) * depth, depth);
  }
  /// Counterclockwise, seen from the camera.
  std::array<Pixel, 3> pixelsOf(const HeightCell& cell) const;
  std::array<Vec3, 3> corners(ElementId id) const;
  /// Whether the triangle is there.
  bool exists(const HeightCell& cell) const;
  /// 1 / depth, m⁻¹, of the triangle where the camera sees it at a column and row; 0: it is not there. On a plane
  /// 1 / depth is linear in both.
  double nearness(const HeightCell& cell, double column, double row) const;

 private:
  bool isPlain() const;

  std::shared_ptr<const DepthImage> image_;
  GridFrame frame_;
  bool mirrored_, plain_;  // plain: three pixels that are joined always are a triangle
};

}  // namespace hl

// What a depth camera above a table sees: a ball, a box and a cone on it, each with its shadow, in which there is no
// depth.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "surfaces/depth_frame.h"

namespace hl {

/// A picture of a camera as its driver gives it.
struct DepthPicture {
  std::uint32_t columns, rows;
  double unit_m;
  DepthCamera camera;
  std::vector<std::uint16_t> depths;  ///< row by row from the top; 0: none

  /// Valid as long as the picture.
  HeightGrid grid() const;
};

/// By a camera half a metre above the table that looks down at it, and sees as much of it with any number of columns;
/// in 0.1 mm.
DepthPicture pictureOfTable(std::uint32_t columns, std::uint32_t rows);
/// Where it lies: the table is y = 0, and the middle of the picture is at the origin.
GridFrame frameOfTable();

/// The picture of 640 x 480 pixels.
std::shared_ptr<const PrimitiveSource> makeDepthTable();

}  // namespace hl

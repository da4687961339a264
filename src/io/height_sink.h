// HeightSink: takes what a reader of heights finds, so that no reader holds a whole field.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "surfaces/depth_camera.h"
#include "surfaces/grid_frame.h"
#include "surfaces/height_grid.h"

namespace hl {

/// All of a height field but its samples.
struct HeightHeader {
  GridSize size;
  std::optional<double> missing{};
  GridFrame frame{};
  std::optional<DepthCamera> camera{};  ///< of a depth image
};

/// Called in this order: a header, and all samples, row by row. Each may throw.
class HeightSink {
 public:
  virtual ~HeightSink() = default;
  virtual void header(const HeightHeader& header) = 0;
  virtual void samples(const void* samples, std::size_t bytes) = 0;
  /// What a user should know, at any time.
  virtual void warn(const std::string& line) = 0;
};

}  // namespace hl

// VolumeSink: takes what a reader of volumes finds, so that no reader holds a whole volume.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "surfaces/grid_frame.h"
#include "surfaces/iso_cells.h"
#include "surfaces/voxel_grid.h"

namespace hl {

/// All of a volume but its samples.
struct VolumeHeader {
  std::array<std::uint32_t, 3> side{};  ///< samples along x, y, z
  SampleKind kind = SampleKind::kInt16;
  std::optional<double> missing{};  ///< sample that stands for none
  ValueScale values{};
  /// Metres, from sample numbers. Of a patient: x to the right hand, y to the head, z to the back, so that who looks
  /// along -z sees the back.
  GridFrame frame{};
  std::optional<IsoValue> iso{};  ///< of its surface; nothing: the file does not say
};

/// Called in this order: a header, and all samples, x first, then y, then z. Each may throw.
class VolumeSink {
 public:
  virtual ~VolumeSink() = default;
  virtual void header(const VolumeHeader& header) = 0;
  virtual void samples(const void* samples, std::size_t bytes) = 0;
  /// What a user should know, at any time.
  virtual void warn(const std::string& line) = 0;
};

}  // namespace hl

// hl bench --volumes: ticks on the surfaces of volumes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace hl {

struct VolumeBenchOptions {
  std::uint32_t most = 0;  ///< samples along a side
  std::size_t ticks = 20'000;
  double radius_m = 1e-3;
  std::string csv;  ///< a file; empty: none
};

/// Throws hl::Error where memory lacks, or the file cannot be written.
void runVolumeBench(const VolumeBenchOptions& options);

}  // namespace hl

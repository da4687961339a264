// hl bench --fields: ticks on height fields, beside the same triangles as a mesh.
#pragma once

#include <cstddef>
#include <string>

namespace hl {

struct FieldBenchOptions {
  std::size_t most = 0;  ///< triangles
  std::size_t ticks = 20'000;
  double radius_m = 1e-3;
  std::string csv;  ///< a file; empty: none
};

/// Throws hl::Error where memory lacks, or the file cannot be written.
void runFieldBench(const FieldBenchOptions& options);

}  // namespace hl

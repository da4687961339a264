// hl bench --clouds: ticks on clouds of points and on surfels of them.
#pragma once

#include <cstddef>
#include <string>

namespace hl {

struct CloudBenchOptions {
  std::size_t most = 0;  ///< points
  std::size_t ticks = 20'000;
  double radius_m = 1e-3;
  std::string csv;  ///< a file; empty: none
};

/// Throws hl::Error where memory lacks, or the file cannot be written.
void runCloudBench(const CloudBenchOptions& options);

}  // namespace hl

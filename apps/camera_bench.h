// hl bench --depth: pictures of a depth camera, each as a surface, and ticks on them.
#pragma once

#include <cstddef>
#include <string>

namespace hl {

struct CameraBenchOptions {
  std::size_t pictures = 0;  ///< for each row
  std::string csv;           ///< a file; empty: none
};

/// Throws hl::Error where the file cannot be written.
void runCameraBench(const CameraBenchOptions& options);

}  // namespace hl

// Isolated: runs a parser of foreign files in a child process with limits on time and memory, so that a corrupt or
// hostile file ends the child and not HL.
#pragma once

#include <functional>
#include <string>

#include "scene/model.h"

namespace hl {

struct IsolationLimits {
  unsigned cpu_s = 120;  ///< processor time of the parser
  std::size_t memory_bytes = std::size_t{12} << 30;
};

/// Forks, runs `parse` in the child and returns its model. Throws hl::Error (with `name` in front) with what parse
/// threw, or with what became of the child. Call it before the program starts threads: only the calling one goes along.
/// `progress` is called here, with fractions that the child's parse reports through its argument.
Model runIsolated(const std::string& name, const IsolationLimits& limits,
                  const std::function<Model(const std::function<void(double)>& report)>& parse,
                  const std::function<void(double)>& progress);

}  // namespace hl

// What a shape costs beside the time of its queries: building its hierarchy, and memory.
#pragma once

#include "scene/shape.h"

namespace hl::bench {

/// For one primitive.
struct Cost {
  double build_one_thread_ns = 0;  ///< the hierarchy alone
  double build_ns = 0;             ///< the same on all threads that oneTBB has
  double refit_ns = 0;     ///< on all threads, to fit it again to vertices that move; not a number where it cannot
  double index_bytes = 0;  ///< of the hierarchy
  double all_bytes = 0;    ///< and with it of vertices and index lists
};

/// Builds the hierarchy twice more, and refits it twice.
Cost costOf(const Shape& shape, HierarchyKind hierarchy);

}  // namespace hl::bench

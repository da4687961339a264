// FreeNumbers: numbers for objects and textures that are not in use: above all that were, and where the application has
// chosen the largest of all, those that are free below.
#pragma once

#include <hl/hl_types.h>

#include <algorithm>
#include <limits>
#include <string>

#include "client/fault.h"

namespace hl::client {

class FreeNumbers {
 public:
  /// The application has chosen this one.
  void choose(HLuint number) { highest_ = std::max(highest_, number); }
  /// A number > 0 that is not in the table `used`, of what `kind` names.
  template <typename Table>
  HLuint next(const Table& used, const char* kind) {
    constexpr HLuint kLargest = std::numeric_limits<HLuint>::max();
    if (highest_ < kLargest) return ++highest_;
    do {
      if (below_ == kLargest) throw Fault(HL_OUT_OF_MEMORY, std::string("all numbers of ") + kind + " are in use");
      ++below_;
    } while (used.contains(below_));
    return below_;
  }

 private:
  HLuint highest_ = 0, below_ = 0;
};

}  // namespace hl::client

// FreeNumbers: numbers for objects and textures that are not in use: one after another, without those that the
// application has chosen itself. So one that chooses the largest number takes no others away.
#pragma once

#include <hl/hl_types.h>

#include <limits>
#include <string>

#include "client/fault.h"

namespace hl::client {

class FreeNumbers {
 public:
  /// A number > 0 that was never returned before and is not in the table `used`, of what `kind` names.
  template <typename Table>
  HLuint next(const Table& used, const char* kind) {
    do {
      if (last_ == std::numeric_limits<HLuint>::max())
        throw Fault(HL_OUT_OF_MEMORY, std::string("all numbers of ") + kind + " are in use");
      ++last_;
    } while (used.contains(last_));
    return last_;
  }

 private:
  HLuint last_ = 0;
};

}  // namespace hl::client

// For what follows on scenes: the instances of one as a server remembers them.
#pragma once

#include <vector>

#include "scene/snapshot.h"

namespace hl::test {

/// Good as long as the instances are.
inline std::vector<const Instance*> pointersTo(const std::vector<Instance>& instances) {
  std::vector<const Instance*> pointers;
  for (const Instance& instance : instances) pointers.push_back(&instance);
  return pointers;
}

}  // namespace hl::test

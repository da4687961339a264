// What an environment variable asks of a test: longer runs than those of every day.
#pragma once

#include <cstdlib>

namespace hl::test {

/// The number in the variable, or else `otherwise`.
inline int numberIn(const char* variable, int otherwise) {
  const char* const said = std::getenv(variable);
  return said == nullptr ? otherwise : std::atoi(said);
}

}  // namespace hl::test

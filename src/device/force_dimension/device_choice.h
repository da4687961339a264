// Which of several Force Dimension devices is meant.
#pragma once

#include <optional>
#include <string>

namespace hl {

struct ForceDimensionChoice {
  std::optional<int> index;   ///< in the order of the vendor's library, from 0
  std::optional<int> serial;  ///< the number on the device; neither: the first that is free

  /// From INDEX, serial=NUMBER, or nothing. Throws hl::Error.
  static ForceDimensionChoice parse(const std::string& text);
  /// The same text for two choices of the same device.
  std::string key() const;
};

}  // namespace hl

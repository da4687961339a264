// Label: what a file calls an object, and the colour that it gives it. Pages show both; neither is felt.
#pragma once

#include <optional>
#include <string>

#include "base/rgb.h"

namespace hl {

struct Label {
  std::string name;
  std::optional<Rgb> colour{};  ///< absent: as pages draw others
  bool operator==(const Label&) const = default;
};

}  // namespace hl

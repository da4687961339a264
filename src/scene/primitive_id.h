// PrimitiveId: which primitive of a snapshot.
#pragma once

#include <cstdint>

namespace hl {

/// A primitive of one instance of a snapshot.
struct PrimitiveId {
  std::uint32_t instance = 0;
  std::uint32_t element = 0;  ///< index into its shape's primitives
  bool operator==(const PrimitiveId&) const = default;
};

}  // namespace hl

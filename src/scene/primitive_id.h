// PrimitiveId: which primitive of a snapshot.
#pragma once

#include <cstdint>

#include "geometry/element_id.h"

namespace hl {

/// A primitive of one instance of a snapshot.
struct PrimitiveId {
  std::uint32_t instance = 0;
  ElementId element = 0;  ///< number among its shape's primitives
  bool operator==(const PrimitiveId&) const = default;
};

}  // namespace hl

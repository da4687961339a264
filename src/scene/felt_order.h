// Felt order: which of two primitives with the same vertices counts. Where surfaces lie on each other only one can be
// felt, and what the file lists first must not decide. The harder one counts: of the higher stiffness; of equally hard
// ones the rougher, by dynamic friction, static friction, viscosity, and the rest; of equal materials what their
// textures, vertex normals and texture coordinates say. What is equal in all of this feels the same.
#pragma once

#include <cstdint>

#include "geometry/primitive.h"
#include "scene/snapshot.h"

namespace hl {

struct FeltPrimitive {
  const Instance& instance;
  ElementId element;           ///< number in the instance's shape
  const Primitive& primitive;  ///< that element
};

/// -1 where `a` counts, 1 where `b` does, 0 where they feel the same. RT-safe.
int compareFelt(const FeltPrimitive& a, const FeltPrimitive& b);

}  // namespace hl

// Felt order: which of two primitives with the same vertices counts as the contact. If surfaces coincide only one can
// be felt, and the order in the file must not decide. The one with the higher stiffness counts; at equal stiffness the
// rougher one, by dynamic friction, static friction, viscosity and the other quantities; for equal materials the
// textures, vertex normals and texture coordinates decide. If all of these are equal, both feel the same. A texture of
// stiffness is not read here: where the place is known, contacts.cpp compares the stiffness there first.
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

/// Puts both into one frame: that of their object if they have the same, else the world's at this time. RT-safe.
void toOneFrame(const Instance& of_a, const Instance& of_b, std::int64_t time_ns, Primitive& a, Primitive& b);
/// Whether two in one frame have the same vertices, to the bit.
inline bool areCopies(const Primitive& a, const Primitive& b) { return a.vertex == b.vertex && a.kind == b.kind; }

/// -1 if `a` counts, 1 if `b` counts, 0 if they feel the same. RT-safe.
int compareFelt(const FeltPrimitive& a, const FeltPrimitive& b);

}  // namespace hl

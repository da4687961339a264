// Segments and points that a test makes only where their vertices are sound, as makeTriangle() of geometry/primitive.h
// makes triangles.
#pragma once

#include "geometry/primitive.h"

namespace hl::test {

/// Returns false, and leaves `out` unchanged, if the vertices are not valid.
inline bool makeSegment(const Vec3& a, const Vec3& b, ElementId source, Primitive& out) {
  if (!isSegment(a, b)) return false;
  out = segmentOf(a, b, source);
  return true;
}

/// The same.
inline bool makePoint(const Vec3& a, ElementId source, Primitive& out) {
  if (!withinReach(a)) return false;
  out = pointOf(a, source);
  return true;
}

}  // namespace hl::test

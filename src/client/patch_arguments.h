// The arguments of hlNurbsSurface: checked and copied.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

namespace hl::client {

/// What is said of a surface along u, or along v.
struct SurfaceSide {
  HLsizei knot_count;  ///< 0: a Bezier patch
  const HLdouble* knots;
  HLint stride;  ///< numbers from one control point to the next
  HLint order;
};

/// Throws Fault for what makes no surface.
proto::Patch patchOf(const SurfaceSide& u, const SurfaceSide& v, const HLdouble* points, HLenum type);

}  // namespace hl::client

// ImplicitSpec: what an implicit surface is made from.
#pragma once

#include <optional>

#include "geometry/box.h"
#include "surfaces/implicit/expression.h"

namespace hl {

/// What is written down.
struct ImplicitSpec {
  Expression expression;
  std::optional<Box> bounds;  ///< the surface ends there; none: around the expression
  double error_m = 1e-5;      ///< distance that triangles may have from the surface
};

}  // namespace hl

// SheetSides: which smooth functions of an implicit function have one sign in a whole box. There conditions on them are
// decided, for all that is in the box: for the parts of a brick, and for the cuts of its triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "surfaces/implicit/implicit_function.h"

namespace hl {

/// Plain values; RT-safe.
class SheetSides {
 public:
  /// Whether all conditions may hold somewhere in a box, give or take `slack`. Functions whose sign is not known are
  /// looked at as far as it matters; what was known must be of a box that holds this one.
  bool mayHold(const ImplicitFunction& function, std::span<const ImplicitFunction::Condition> conditions, double slack,
               const SmoothFunction::Space& box);

  /// Whether a function is above `slack` in the box, or below -`slack`.
  bool isAbove(std::size_t sheet) const { return (above_ >> sheet & 1) != 0; }
  bool isBelow(std::size_t sheet) const { return (below_ >> sheet & 1) != 0; }
  /// Bodies of the functions that were looked at for the last box.
  std::size_t bodies() const { return bodies_; }

 private:
  struct Look {
    const ImplicitFunction& function;
    double slack;
    const SmoothFunction::Space& box;
    std::uint64_t open = 0;  // bit i: function i may have both signs
  };
  bool mayBe(Look& look, std::size_t node, double sign);
  bool mayBeSmooth(Look& look, std::size_t sheet, double sign);

  std::uint64_t above_ = 0, below_ = 0;  // bit i: of function i
  std::size_t bodies_ = 0;
};

}  // namespace hl

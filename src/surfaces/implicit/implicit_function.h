// ImplicitFunction: an expression in its normal form: the least and the greatest of smooth functions, and nothing else
// above these.
//
// Blends, shells and offsets go through the least and the greatest: a blend is monotone in both of its operands, so
// blend(min(a, b), c) = min(blend(a, c), blend(b, c)); |f| - t = max(f - t, -f - t); min(a, b) + t = min(a + t, b + t).
// So each edge of the solid is one between two smooth functions, and each smooth surface can be looked at alone.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "surfaces/implicit/expression.h"
#include "surfaces/implicit/smooth_function.h"

namespace hl {

/// Immutable; read by any thread. Below 0 in the solid.
class ImplicitFunction {
 public:
  /// The least or the greatest of two nodes, or a smooth function.
  struct Node {
    enum class Kind : std::uint8_t { kSmooth, kMin, kGreatest } kind;
    std::uint16_t first, second;  ///< nodes, or the number of a smooth function
  };
  /// sign * (value of the node) >= 0.
  struct Condition {
    std::uint16_t node;
    double sign;
  };

  /// Throws hl::Error for one that cannot be, or has too many smooth functions.
  explicit ImplicitFunction(const Expression& expression);

  const std::vector<SmoothFunction>& sheets() const { return sheets_; }
  const Node& node(std::size_t number) const { return nodes_[number]; }
  /// RT-safe.
  double at(const Vec3& p) const { return at(root_, p); }
  /// All must hold where a sheet, which is 0 there, is the surface of the whole.
  std::span<const Condition> conditions(std::size_t sheet) const { return conditions_[sheet]; }
  std::size_t bytes() const;

 private:
  double at(std::size_t node, const Vec3& p) const;
  void addConditions(std::uint16_t node, std::vector<Condition>& above);

  std::vector<SmoothFunction> sheets_;
  std::vector<Node> nodes_;
  std::uint16_t root_ = 0;
  std::vector<std::vector<Condition>> conditions_;
};

}  // namespace hl

#include "surfaces/implicit/sheet_sides.h"

#include <algorithm>
#include <cmath>

namespace hl {

bool SheetSides::mayHold(const ImplicitFunction& function, std::span<const ImplicitFunction::Condition> conditions,
                         double slack, const SmoothFunction::Space& box) {
  bodies_ = 0;
  Look look{function, std::abs(slack), box};
  return std::all_of(conditions.begin(), conditions.end(), [&](const ImplicitFunction::Condition& condition) {
    return mayBe(look, condition.node, condition.sign);
  });
}

// The least of two is above where both are, and below where one is.
bool SheetSides::mayBe(Look& look, std::size_t number, double sign) {
  const ImplicitFunction::Node& node = look.function.node(number);
  if (node.kind == ImplicitFunction::Node::Kind::kSmooth) return mayBeSmooth(look, node.first, sign);
  const bool both = (node.kind == ImplicitFunction::Node::Kind::kMin) == (sign > 0);
  return both ? mayBe(look, node.first, sign) && mayBe(look, node.second, sign)
              : mayBe(look, node.first, sign) || mayBe(look, node.second, sign);
}

bool SheetSides::mayBeSmooth(Look& look, std::size_t sheet, double sign) {
  const std::uint64_t bit = std::uint64_t{1} << sheet;
  if (((above_ | below_ | look.open) & bit) == 0) {
    const SmoothFunction& smooth = look.function.sheets()[sheet];
    bodies_ += smooth.bodies();
    const Interval value = smooth.over(look.box);
    (value.low > look.slack ? above_ : value.high < -look.slack ? below_ : look.open) |= bit;
  }
  return ((sign > 0 ? below_ : above_) & bit) == 0;
}

}  // namespace hl

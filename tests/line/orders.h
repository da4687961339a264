// Orders: the words that change a line, or ask what it did, one order a line of text:
//
//   [from END] [to END] [delay MS] [jitter MS] [loss PERCENT] [rate MBIT_S] [reorder on|off]   of these directions
//   cut END, mend END                                                                          all directions of this
//   end count                                                                                      packets so far
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "line/link.h"

namespace hl::line {

enum class OrderKind : std::uint8_t { kSet, kCut, kMend, kMulticast, kCount };

/// What is not said stays as it is. Ends are numbered from 1.
struct Order {
  OrderKind kind = OrderKind::kSet;
  int end = 0;            ///< of kCut and kMend
  bool multicast = true;  ///< of kMulticast
  int from = 0, to = 0;   ///< of kSet; 0: all
  std::optional<double> delay_ms, jitter_ms, loss_percent, rate_Mbit_s;
  std::optional<bool> reorder;
};

/// Throws hl::Error for what is no order for a line with so many ends.
Order orderOf(std::string_view text, int ends);

/// The settings of a link after this order. Throws hl::Error when they do not go together.
LinkSettings changed(LinkSettings settings, const Order& order);

}  // namespace hl::line

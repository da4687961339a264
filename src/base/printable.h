// Text that people type and that messages quote: one line stays one line.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "base/error.h"

namespace hl {

/// Throws hl::Error when there is a control character in `text`, such as the end of a line. `what` it is: "an address".
inline void checkPrintable(std::string_view text, const char* what) {
  constexpr unsigned char kDelete = 0x7f;
  const auto control = [](unsigned char c) { return c < ' ' || c == kDelete; };
  if (std::any_of(text.begin(), text.end(), control))
    throw Error(std::string(what) + " has a control character in it: write it in one line");
}

}  // namespace hl

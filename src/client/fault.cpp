#include "client/fault.h"

#include <array>
#include <charconv>

namespace hl::client {

namespace {

// As the documents write it: 1e-9, not 1e-09.
std::string plainText(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  std::string text(digits.data(), end);
  const std::size_t exponent = text.find('e');
  if (exponent == text.npos) return text;
  const std::size_t first = exponent + (text[exponent + 1] == '-' ? 2 : 1);
  return text.erase(first, text.find_first_of("123456789", first) - first);
}

}  // namespace

void requireWithin(std::string_view what, double value, double least, double most) {
  if (value >= least && value <= most) return;
  throw Fault(HL_INVALID_VALUE, std::string(what) + " must be " + plainText(least) + " to " + plainText(most) +
                                    ", and is " + plainText(value));
}

}  // namespace hl::client

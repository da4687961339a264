// Fault: why a call cannot be done. Thrown before anything is changed, caught at the C boundary (call.h), where it
// becomes the context's error.
#pragma once

#include <hl/hl_types.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hl::client {

class Fault : public std::runtime_error {
 public:
  /// `code` is one of HL_INVALID_ENUM ..; `text` says what to do, without the call's name.
  Fault(HLenum code, const std::string& text) : std::runtime_error(text), code_(code) {}
  HLenum code() const { return code_; }

 private:
  HLenum code_;
};

/// A finite number times 0 is 0, NaN and infinities times 0 are NaN: one comparison for all of them.
template <typename... Numbers>
bool allFinite(Numbers... numbers) {
  return ((numbers * 0) + ...) == 0;
}

template <typename... Numbers>
void requireFinite(Numbers... numbers) {
  if (!allFinite(numbers...)) throw Fault(HL_INVALID_VALUE, "numbers must be finite");
}

/// `what`: the number's name, for the Fault HL_INVALID_VALUE that says its range.
void requireWithin(std::string_view what, double value, double least, double most);

inline void requireCount(HLsizei n) {
  if (n < 0) throw Fault(HL_INVALID_VALUE, "a count must not be negative");
}

inline void requirePointer(const void* pointer) {
  if (pointer == nullptr) throw Fault(HL_INVALID_VALUE, "the pointer must not be null");
}

/// `n` numbers in the application's memory.
inline void requireList(HLsizei n, const void* list) {
  requireCount(n);
  if (n > 0) requirePointer(list);
}

}  // namespace hl::client

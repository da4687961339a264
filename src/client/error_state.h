// ErrorState: GL's sticky error. The first error is kept until it is taken; a callback hears of every one. The end of
// the conversation is reported once, so it waits behind an error that is kept.
#pragma once

#include <hl/hl_types.h>

#include <optional>
#include <string>

namespace hl::client {

class ErrorState {
 public:
  /// Keeps the error if none is kept, and calls the callback. `function`: the call that makes it; null: none does.
  void note(HLenum code, const char* function, const std::string& text) noexcept;
  /// The kept error, forgotten; HL_NO_ERROR: none.
  HLenum take() noexcept;
  /// One line about the error that take() returns or has returned last.
  const std::string& text() const { return text_; }
  void setCallback(HLerrorfunc callback, void* user);

 private:
  HLenum kept_ = HL_NO_ERROR;
  std::string text_;
  std::optional<std::string> lost_;  // HL_CONNECTION_LOST, that came while another one was kept
  HLerrorfunc callback_ = nullptr;
  void* user_ = nullptr;
};

/// Notes the exception that is being handled: a Fault by its code, bad_alloc as HL_OUT_OF_MEMORY, others as
/// HL_INVALID_OPERATION. Only inside a catch block.
void noteCurrentException(ErrorState& errors, const char* function) noexcept;

}  // namespace hl::client

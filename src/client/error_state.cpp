#include "client/error_state.h"

#include <new>
#include <utility>

#include "client/fault.h"

namespace hl::client {

void ErrorState::note(HLenum code, const char* function, const std::string& text) noexcept {
  try {
    const std::string line = function == nullptr ? text : std::string(function) + ": " + text;
    if (kept_ == HL_NO_ERROR) text_ = line;
    if (kept_ != HL_NO_ERROR && code == HL_CONNECTION_LOST) lost_ = line;
    if (callback_ != nullptr) callback_(code, line.c_str(), user_);
  } catch (...) {
    // No memory for the text, or the callback has thrown: the code is still kept.
  }
  if (kept_ == HL_NO_ERROR) kept_ = code;
}

HLenum ErrorState::take() noexcept {
  if (kept_ == HL_NO_ERROR && lost_) {
    text_ = std::move(*lost_);
    lost_.reset();
    return HL_CONNECTION_LOST;
  }
  const HLenum code = kept_;
  kept_ = HL_NO_ERROR;
  return code;
}

void ErrorState::setCallback(HLerrorfunc callback, void* user) {
  callback_ = callback;
  user_ = user;
}

void noteCurrentException(ErrorState& errors, const char* function) noexcept {
  try {
    throw;
  } catch (const Fault& fault) {
    errors.note(fault.code(), function, fault.what());
  } catch (const std::bad_alloc&) {
    errors.note(HL_OUT_OF_MEMORY, function, "no memory");
  } catch (const std::exception& error) {
    errors.note(HL_INVALID_OPERATION, function, error.what());
  } catch (...) {
    errors.note(HL_INVALID_OPERATION, function, "a callback has thrown something");
  }
}

}  // namespace hl::client

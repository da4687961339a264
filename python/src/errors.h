// HL's errors on their way to Python: hl.errors has a class for each kind.
#pragma once

#include <hl/hl_types.h>

#include <stdexcept>
#include <string>

/// An error of a call. Becomes the exception that hl.errors.make(code, text) returns.
class CallFailed : public std::runtime_error {
 public:
  CallFailed(HLenum code, const std::string& text) : std::runtime_error(text), code_(code) {}
  HLenum code() const { return code_; }

 private:
  HLenum code_;
};

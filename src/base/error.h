// Error: bad input from outside (a file, an argument, a packet), with one line that says what to do.
// Thrown only outside the real-time loops; programs print what() and end with code 2.
#pragma once

#include <stdexcept>
#include <string>

namespace hl {

class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace hl

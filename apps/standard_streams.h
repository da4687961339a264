// Standard streams: what a program says, wherever that goes. A terminal that is closed, a disk that is full or a stream
// that was never open ends no session; what a program was asked to print and could not is its failure.
#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <string>
#include <utility>

namespace hl {

/// To stderr; nothing happens where that takes nothing.
template <typename... Arguments>
void tell(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  const std::string line = fmt::format(text, std::forward<Arguments>(arguments)...);
  static_cast<void>(std::fwrite(line.data(), 1, line.size(), stderr));
}

/// At the begin of main(): no file gets the number of a stream that is not open, and a file that may not grow is an
/// error of writing, not a signal.
void prepareStreams();
/// At its end: `code`, or 1 and a line where what was printed to stdout is lost.
int codeWithOutput(int code, const char* program);

}  // namespace hl

// Lines for people: how far a sweep is, and why a task failed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hl {

/// "950 of 1000 tasks, 400 a second, 2 s left".
std::string fleetProgressText(std::size_t done, std::size_t all, double seconds);

/// Whatever the text is: one line of UTF-8, at most 500 characters long.
std::string oneLineOf(std::string_view text);

}  // namespace hl

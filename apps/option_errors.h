// What is said of a wrong option: CLI11 knows what is wrong, and its words do not say what to do.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hl {

/// What CLI11 says of a wrong option, in words that say what to do.
std::string errorText(const CLI::ParseError& error);

/// No option of the program or of its commands takes an empty word, as an unset variable of a shell makes it.
void refuseEmptyWords(CLI::App& app);

}  // namespace hl

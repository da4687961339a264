// What main() of a program does that hl or hld starts for a part of their work.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hl {

/// `--version` prints it; other words are answered. An hl::Error of `answer` is one line on stderr and the exit code 2.
int programMain(const std::string& name, const std::string& version, std::span<const char* const> arguments,
                const std::function<void(const std::vector<std::string>& words)>& answer);

}  // namespace hl

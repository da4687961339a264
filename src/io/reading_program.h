// Programs of their own that read what few need and what takes large libraries: hl-cad, hl-vdb.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hl {

/// The first file of this name that may be run: beside this program, or where the shell would look. Throws hl::Error
/// with `otherwise` if there is none.
std::string readingProgram(const std::string& name, const std::string& otherwise);

/// What main() of such a program does: `--version` prints it; other words are answered. An hl::Error of `answer` is one
/// line on stderr and the exit code 2.
int readingMain(const std::string& name, const std::string& version, std::span<const char* const> arguments,
                const std::function<void(const std::vector<std::string>& words)>& answer);

}  // namespace hl

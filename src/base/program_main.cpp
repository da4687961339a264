#include "base/program_main.h"

#include <cstdio>

#include "base/error.h"

namespace hl {

int programMain(const std::string& name, const std::string& version, std::span<const char* const> arguments,
                const std::function<void(const std::vector<std::string>& words)>& answer) {
  const std::vector<std::string> words(arguments.begin() + 1, arguments.end());
  if (words.size() == 1 && words[0] == "--version") {
    std::printf("%s %s\n", name.c_str(), version.c_str());
    return 0;
  }
  try {
    answer(words);
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return 2;
  }
}

}  // namespace hl

#include "io/reading_program.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"

namespace hl {

std::string readingProgram(const std::string& name, const std::string& otherwise) {
  namespace fs = std::filesystem;
  std::error_code failed;
  const fs::path self = fs::read_symlink("/proc/self/exe", failed);
  std::string folders = self.parent_path().string();
  if (const char* const path = std::getenv("PATH")) folders += std::string(":") + path;
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    const fs::path program = fs::path(folders.substr(begin, end - begin)) / name;
    if (program.is_absolute() && access(program.c_str(), X_OK) == 0) return program.string();
    begin = end + 1;
  }
  throw Error(otherwise);
}

}  // namespace hl

// How a file's name ends, which decides what reads it.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace hl {

/// ".obj" of "A/b.OBJ": in lower case, empty without a dot.
inline std::string endingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

}  // namespace hl

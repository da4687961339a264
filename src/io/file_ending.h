// How a file's name ends, which decides what reads it.
#pragma once

#include <filesystem>
#include <string>

#include "base/text.h"

namespace hl {

/// ".obj" of "A/b.OBJ", ".nii.gz" of "c.nii.gz": in lower case, empty without a dot.
inline std::string endingOf(const std::string& path) {
  const auto last_of = [](const std::filesystem::path& name) { return lowered(name.extension().string()); };
  const std::string ending = last_of(path);
  return ending == ".gz" ? last_of(std::filesystem::path(path).stem()) + ending : ending;
}

}  // namespace hl

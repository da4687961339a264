#include "fleet/beside.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>

#include "base/error.h"

namespace hl {

std::string nameBeside(const std::string& path) {
  std::random_device random;  // of the kernel
  return fmt::format("{}{}{:08x}{:08x}", path, kBeside, random(), random());
}

void removeBeside(const std::string& path) {
  const std::filesystem::path place(path);
  const std::string begin = place.filename().string() + kBeside;
  std::error_code failed;
  for (std::filesystem::directory_iterator at(place.parent_path(), failed), end; !failed && at != end;
       at.increment(failed)) {
    std::error_code gone;
    if (at->path().filename().string().starts_with(begin)) std::filesystem::remove(at->path(), gone);
  }
}

void putInPlace(const std::string& beside, const std::string& path) {
  if (std::rename(beside.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  unlink(beside.c_str());
  throw Error(path + ": cannot be written: " + std::strerror(error));
}

}  // namespace hl

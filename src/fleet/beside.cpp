#include "fleet/beside.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>

#include "base/error.h"

namespace hl {

std::string nameBeside(const std::string& path) {
  std::random_device random;  // of the kernel
  return fmt::format("{}{}{:08x}{:08x}", path, kBeside, random(), random());
}

void putInPlace(const std::string& beside, const std::string& path) {
  if (std::rename(beside.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  unlink(beside.c_str());
  throw Error(path + ": cannot be written: " + std::strerror(error));
}

}  // namespace hl

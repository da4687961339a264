#include "fleet/beside.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
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

bool isLeftBeside(const std::string& file) {
  constexpr std::chrono::minutes kAge{10};
  if (std::filesystem::path(file).filename().string().find(kBeside) == std::string::npos) return false;
  std::error_code failed;
  const auto written = std::filesystem::last_write_time(file, failed);
  return !failed && std::filesystem::file_time_type::clock::now() - written > kAge;
}

void removeBeside(const std::string& path) {
  const std::filesystem::path place(path);
  const std::string begin = place.filename().string() + kBeside;
  std::error_code failed;
  for (std::filesystem::directory_iterator at(place.parent_path(), failed), end; !failed && at != end;
       at.increment(failed)) {
    std::error_code gone;
    const bool is_of = at->path().filename().string().starts_with(begin);
    if (is_of && isLeftBeside(at->path().string())) std::filesystem::remove(at->path(), gone);
  }
}

void putInPlace(const std::string& beside, const std::string& path) {
  if (std::rename(beside.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  unlink(beside.c_str());
  throw Error(path + ": cannot be written: " + std::strerror(error));
}

}  // namespace hl

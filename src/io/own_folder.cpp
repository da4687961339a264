#include "io/own_folder.h"

#include <filesystem>
#include <system_error>

#include "io/companion_file.h"

namespace hl {

// What does not exist is reported by assimp: it tries names.
bool OwnFolder::isOwn(const std::string& file) const {
  std::error_code failed;
  if (file == path_ || !std::filesystem::exists(file, failed) || isCompanion(path_, file)) return true;
  refused_ = file;
  return false;
}

Assimp::IOStream* OwnFolder::Open(const char* file, const char* mode) {
  const bool to_read = std::string(mode).find_first_of("wa+") == std::string::npos;
  return to_read && isOwn(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
}

}  // namespace hl

#include "io/own_folder.h"

#include <assimp/MemoryIOWrapper.h>

#include <cstdint>
#include <filesystem>
#include <system_error>

#include "base/url.h"
#include "io/companion_file.h"

namespace hl {

// What does not exist is reported by assimp: it tries names.
bool OwnFolder::isOwn(const std::string& file) const {
  std::error_code failed;
  if (file == path_ || !std::filesystem::exists(file, failed) || isCompanion(path_, file)) return true;
  refused_ = file;
  return false;
}

// A name that does not exist may be that of a URI.
std::string OwnFolder::found(const std::string& file) const {
  std::error_code failed;
  if (file == path_ || file.find('%') == std::string::npos || std::filesystem::exists(file, failed)) return file;
  const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  const std::string begin = folder.empty() ? "" : folder.string() + "/";
  if (!file.starts_with(begin)) return file;
  const std::optional<std::string> decoded = percentDecoded(file.substr(begin.size()));
  return decoded ? begin + *decoded : file;
}

bool OwnFolder::Exists(const char* file) const {
  const std::string name = found(file);
  return isOwn(name) && DefaultIOSystem::Exists(name.c_str());
}

Assimp::IOStream* OwnFolder::Open(const char* file, const char* mode) {
  const bool to_read = std::string(mode).find_first_of("wa+") == std::string::npos;
  const std::string name = found(file);
  if (!to_read || !isOwn(name)) return nullptr;
  if (text_ && name == path_)
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text_->data()), text_->size());
  return DefaultIOSystem::Open(name.c_str(), mode);
}

}  // namespace hl

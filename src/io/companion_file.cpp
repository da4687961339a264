#include "io/companion_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "base/url.h"
#include "io/text_words.h"

namespace hl {

namespace {

namespace fs = std::filesystem;

bool isBeneath(const fs::path& folder, const fs::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

fs::path folderOf(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? "." : parent;
}

}  // namespace

bool isCompanion(const std::string& path, const std::string& file) {
  std::error_code failed, missing;
  const fs::path folder = fs::canonical(folderOf(path), failed), real = fs::canonical(file, missing);
  return !failed && !missing && isBeneath(folder, real);
}

std::string companionPath(const std::string& path, const std::string& name) {
  const fs::path wanted(name);
  const bool leads_up = std::find(wanted.begin(), wanted.end(), "..") != wanted.end();
  const auto require = [&](bool beneath) {
    if (!beneath)
      throw Error(fmt::format("names '{}', which is not in its folder: put that file beside it", shown(name)));
  };
  require(!wanted.is_absolute() && !leads_up);
  const fs::path file = folderOf(path) / wanted;
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) {
    const std::optional<std::string> decoded = percentDecoded(name);
    if (decoded && *decoded != name) return companionPath(path, *decoded);
    throw Error(fmt::format("names '{}', and there is no such file", shown(name)));
  }
  const std::string real = fs::canonical(file, failed).string();
  require(!failed && isCompanion(path, real));
  return real;
}

}  // namespace hl

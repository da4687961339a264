#include "base/plain_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "base/error.h"

namespace hl {

void checkPlainFile(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw Error(path + ": there is no such file");
  if (error) throw Error(path + ": may not be read: " + error.message());
  if (std::filesystem::is_directory(status)) throw Error(path + ": is a folder");
  if (!std::filesystem::is_regular_file(status)) throw Error(path + ": is not a file");
  if (!std::ifstream(path, std::ios::binary)) throw Error(path + ": may not be read");
}

std::optional<std::string> contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return {};
  return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace hl

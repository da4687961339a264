#include "token_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/text.h"
#include "http/access.h"

namespace hl {

std::string readTokenFile(const std::string& file) {
  constexpr std::size_t kMax_bytes = 4096;  // a device has no end
  std::ifstream in(file, std::ios::binary);
  std::string line(kMax_bytes, ' ');
  in.read(line.data(), static_cast<std::streamsize>(line.size()));
  if (in.gcount() <= 0) throw Error(file + ": no token can be read from it");
  line.resize(std::min(static_cast<std::size_t>(in.gcount()), line.find('\n')));
  line = std::string(trimmed(line));
  try {
    checkToken(line);
  } catch (const Error& error) {
    throw Error(file + ": " + error.what());
  }
  return line;
}

bool isReadableByOthers(const std::string& file) {
  std::error_code error;
  const auto permissions = std::filesystem::status(file, error).permissions();
  return !error && (permissions & std::filesystem::perms::others_read) != std::filesystem::perms::none;
}

}  // namespace hl

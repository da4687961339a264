#include "token_file.h"

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "http/access.h"

namespace hl {

std::string readTokenFile(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) throw Error(file + ": no token can be read from it");
  constexpr const char* kSpace = " \t\r";
  line.erase(0, line.find_first_not_of(kSpace));
  line.erase(line.find_last_not_of(kSpace) + 1);
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

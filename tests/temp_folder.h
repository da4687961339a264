// Files for a test to read and write. Cases run side by side as processes of their own, so each process has its own
// folder, removed when it ends.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace hl::test {

class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hl_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// This process's own folder.
inline const std::filesystem::path& tempFolder() {
  static const TempFolder folder;
  return folder.path();
}

// The path of a file in tempFolder(), which need not exist.
inline std::string tempFile(const std::string& name) { return (tempFolder() / name).string(); }

// Writes a file into tempFolder(); its path.
inline std::string fileWith(const std::string& name, const std::string& content) {
  std::ofstream(tempFile(name), std::ios::binary) << content;
  return tempFile(name);
}

}  // namespace hl::test

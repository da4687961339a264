#include "io/output_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.h"

namespace hl {

void requireNotRead(const std::string& path, const std::vector<std::string>& read) {
  for (const std::string& other : read) {
    std::error_code none;
    if (std::filesystem::equivalent(path, other, none))
      throw Error(path + ": is read by this command, so it cannot be written too: give another file");
  }
}

OutputFile::OutputFile(std::string path, std::initializer_list<std::string> read) : path_(std::move(path)) {
  requireNotRead(path_, read);
  file_ = std::fopen(path_.c_str(), "wb");
  if (file_ == nullptr) fail();
}

OutputFile::~OutputFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void OutputFile::fail() const { throw Error(path_ + ": cannot be written: " + std::strerror(errno)); }

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
}

void OutputFile::flush() {
  if (std::fflush(file_) != 0) fail();
}

void OutputFile::close() {
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail();
}

}  // namespace hl

#include "http/temporary_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "base/descriptor_bytes.h"
#include "base/error.h"

namespace hl {

namespace {

[[noreturn]] void fail() { throw Error(std::string("no room for the file: ") + std::strerror(errno)); }

// Where a file system knows no files without a name, the name goes at once.
int openNamed(const std::string& folder) {
  std::string name = folder + "/hl-XXXXXX";
  const int descriptor = mkostemp(name.data(), O_CLOEXEC);
  if (descriptor >= 0) unlink(name.c_str());
  return descriptor;
}

}  // namespace

TemporaryFile::TemporaryFile() {
  std::error_code error;
  const std::string folder = std::filesystem::temp_directory_path(error).string();
  descriptor_ = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (descriptor_ < 0) descriptor_ = openNamed(folder);
  if (descriptor_ < 0) fail();
}

TemporaryFile::~TemporaryFile() { close(descriptor_); }

void TemporaryFile::write(const void* data, std::size_t size) {
  if (!writeWhole(descriptor_, data, size)) fail();
}

}  // namespace hl

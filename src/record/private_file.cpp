#include "record/private_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "base/error.h"

namespace hl {

FilePointer makePrivateFile() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) throw Error("there is no folder for temporary files: set TMPDIR to one");
  std::string name = (folder / "hl-recording-XXXXXX").string();
  const int descriptor = mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) throw Error(folder.string() + ": no file can be made: " + std::strerror(errno));
  unlink(name.c_str());
  return std::make_shared<const OpenFile>(descriptor);
}

}  // namespace hl

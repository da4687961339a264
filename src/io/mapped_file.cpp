#include "io/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include "base/error.h"
#include "base/open_file.h"

namespace hl {

MappedFile::MappedFile(const std::string& path) {
  const OpenFile file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.descriptor() < 0 || fstat(file.descriptor(), &status) != 0) throw Error("cannot be opened");
  if (status.st_size == 0) return;
  size_ = static_cast<std::size_t>(status.st_size);
  begin_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.descriptor(), 0);
  if (begin_ != MAP_FAILED) return;
  begin_ = nullptr;
  throw Error("is too large to be read");
}

MappedFile::~MappedFile() {
  if (begin_ != nullptr) munmap(begin_, size_);
}

}  // namespace hl

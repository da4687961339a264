// MappedFile: the bytes of a file to look at, without a copy: what is asked of a large file before its reader has it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hl {

class MappedFile {
 public:
  /// Throws hl::Error, without the name, for one that cannot be opened.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  /// Valid as long as this is.
  std::string_view bytes() const { return {static_cast<const char*>(begin_), size_}; }

 private:
  void* begin_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace hl

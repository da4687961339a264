// TemporaryFile: a place on the disk without a name, which is gone with this object, however the program ends.
#pragma once

#include <cstddef>

namespace hl {

class TemporaryFile {
 public:
  /// In the folder for temporary files; only this user could open it. Throws hl::Error when there is no room.
  TemporaryFile();
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// At its end. Throws hl::Error when there is no room.
  void write(const void* data, std::size_t size);
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

}  // namespace hl

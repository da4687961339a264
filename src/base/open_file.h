// OpenFile: a file that its owner closes.
#pragma once

#include <unistd.h>

namespace hl {

class OpenFile {
 public:
  /// Below 0: there is none.
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  const int descriptor_;
};

}  // namespace hl

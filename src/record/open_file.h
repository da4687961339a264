// OpenFile: a file that its last owner closes, such as a private one that has no name and is gone then.
#pragma once

#include <memory>

namespace hl {

/// An open file, closed with its last owner.
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};
using FilePointer = std::shared_ptr<const OpenFile>;

/// A new file in the folder for temporary ones, for this user alone, that has no name any more. Throws hl::Error.
FilePointer makePrivateFile();

}  // namespace hl

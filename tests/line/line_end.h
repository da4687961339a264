// LineEnd: a network namespace with one device, line0, of MTU 1500. What its programs send comes out of a file, and
// what is written to that file they receive. The namespace has no name: it is gone when the file is closed and no
// program is in it any more, however this one ends.
#pragma once

#include "base/error.h"

namespace hl::line {

/// This machine does not allow namespaces or devices, in one line: for tests a reason to be skipped.
class LineRefused : public Error {
 public:
  using Error::Error;
};

/// Two files of this process, closed when it is gone.
class LineEnd {
 public:
  /// The thread that calls it is in the new namespace from then on. Throws LineRefused; hl::Error for what else fails.
  explicit LineEnd(int end);
  ~LineEnd();
  LineEnd(LineEnd&& other) noexcept;
  LineEnd& operator=(LineEnd&&) = delete;

  int device() const { return device_; }         ///< reads and writes packets of IP, without waiting
  int nameSpace() const { return name_space_; }  ///< for setns()

 private:
  int name_space_ = -1, device_ = -1;
};

}  // namespace hl::line

// ByteFile: the bytes of a file from one place to its end, unpacked on the way where they are gzip.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>

struct gzFile_s;

namespace hl {

/// What is said of a file that is too short.
inline constexpr const char* kEndsEarly = "ends before its last sample";

/// Whether a file begins as gzip does.
bool beginsAsGzip(const std::string& path);

/// Every call throws hl::Error, without the file's name: if the file ends too early, is no sound gzip or cannot be
/// read.
class ByteFile {
 public:
  enum class Form { kPlain, kGzip };
  explicit ByteFile(const std::string& path, Form form = Form::kPlain, std::uint64_t begin = 0);

  /// The next `bytes`, all of them.
  void read(void* data, std::size_t bytes);
  /// Up to `bytes`, at least one but at the end. Returns how many.
  std::size_t some(void* data, std::size_t bytes);
  void skip(std::uint64_t bytes);
  /// The next line of a header, without its end (LF or CR LF), which the last one need not have. False at the end.
  bool line(std::string& text);
  /// Unpacked bytes so far, and where in the file a plain one stands.
  std::uint64_t place() const { return place_; }
  /// Before a long read: throws at once if the file is shorter than what is to come, or its gzip too short to hold it.
  void expect(std::uint64_t bytes) const;
  /// After the last read: gzip that ends here must have the right checksum.
  void checkEnd();

 private:
  struct Close {
    void operator()(gzFile_s* file) const;
  };

  std::ifstream plain_;
  std::unique_ptr<gzFile_s, Close> packed_;  // instead, of zlib
  std::uint64_t place_, bytes_ = 0;          // bytes_: of the file, of gzip as it is packed
};

/// The value with its bytes in the other order.
template <typename Value>
Value swapped(Value value) {
  std::array<std::byte, sizeof(Value)> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

}  // namespace hl

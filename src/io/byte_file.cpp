#include "io/byte_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <vector>

#include "base/error.h"

namespace hl {

namespace {

constexpr const char* kNoGzip = "is not sound gzip: it is broken, or cut off";

gzFile openGzip(const std::string& path, std::uint64_t begin) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw Error("may not be read");
  lseek(descriptor, static_cast<off_t>(begin), SEEK_SET);
  const gzFile file = gzdopen(descriptor, "rb");
  if (file == nullptr) close(descriptor);
  return file;
}

}  // namespace

bool beginsAsGzip(const std::string& path) {
  char first[2] = {};
  std::ifstream(path, std::ios::binary).read(first, sizeof first);
  return first[0] == '\x1f' && first[1] == '\x8b';
}

void ByteFile::Close::operator()(gzFile_s* file) const { gzclose(file); }

ByteFile::ByteFile(const std::string& path, Form form, std::uint64_t begin) : place_(begin) {
  if (form == Form::kGzip) {
    constexpr unsigned kRoom = 1 << 18;
    place_ = 0;
    std::error_code failed;
    const std::uint64_t all = std::filesystem::file_size(path, failed);
    bytes_ = failed || all < begin ? 0 : all - begin;
    packed_.reset(openGzip(path, begin));
    if (!packed_ || gzbuffer(packed_.get(), kRoom) != 0) throw std::bad_alloc();
    if (gzdirect(packed_.get()) != 0) throw Error(kNoGzip);
    return;
  }
  std::error_code failed;
  bytes_ = std::filesystem::file_size(path, failed);
  plain_.open(path, std::ios::binary);
  if (failed || !plain_) throw Error("may not be read");
  plain_.seekg(static_cast<std::streamoff>(begin));
}

std::size_t ByteFile::some(void* data, std::size_t bytes) {
  constexpr std::size_t kMax = 1 << 30;  // zlib counts in 32 bits
  std::size_t got = 0;
  if (packed_) {
    const int read = gzread(packed_.get(), data, static_cast<unsigned>(std::min(bytes, kMax)));
    int code = Z_OK;
    gzerror(packed_.get(), &code);
    if (read < 0 || (code != Z_OK && code != Z_STREAM_END)) throw Error(kNoGzip);
    got = static_cast<std::size_t>(read);
  } else {
    plain_.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes));
    got = static_cast<std::size_t>(plain_.gcount());
  }
  place_ += got;
  return got;
}

void ByteFile::read(void* data, std::size_t bytes) {
  char* at = static_cast<char*>(data);
  while (bytes > 0) {
    const std::size_t got = some(at, bytes);
    if (got == 0) throw Error(kEndsEarly);
    at += got;
    bytes -= got;
  }
}

void ByteFile::skip(std::uint64_t bytes) {
  expect(bytes);
  if (!packed_) {
    place_ += bytes;
    plain_.seekg(static_cast<std::streamoff>(place_));
    return;
  }
  std::vector<char> room(std::min<std::uint64_t>(bytes, 1 << 16));
  while (bytes > 0) {
    const std::size_t part = std::min<std::uint64_t>(bytes, room.size());
    read(room.data(), part);
    bytes -= part;
  }
}

bool ByteFile::line(std::string& text) {
  constexpr std::size_t kLongest = 1 << 16;
  text.clear();
  char c = 0;
  bool any = false;
  while (some(&c, 1) == 1) {
    any = true;
    if (c == '\n') break;
    if (text.size() == kLongest) throw Error("has a line of more than 65536 letters in its header");
    text += c;
  }
  if (text.ends_with('\r')) text.pop_back();
  return any;
}

void ByteFile::expect(std::uint64_t bytes) const {
  // Two bits of deflate, a length and a distance, stand for 258 bytes at most.
  constexpr std::uint64_t kMaxPerByte = 1032;
  const std::uint64_t most = packed_ ? kMaxPerByte * bytes_ : bytes_;
  if (most < place_ || most - place_ < bytes) throw Error(kEndsEarly);
}

void ByteFile::checkEnd() {
  char more = 0;
  if (packed_) some(&more, 1);
}

}  // namespace hl

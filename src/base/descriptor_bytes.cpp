#include "base/descriptor_bytes.h"

#include <unistd.h>

#include <cerrno>

namespace hl {

namespace {

// `call` moves some bytes from `at` on, as write() and read() do.
template <typename Byte, typename Call>
bool inParts(Byte* at, std::size_t bytes, const Call& call) {
  while (bytes > 0) {
    const ssize_t moved = call(at, bytes);
    if (moved < 0 && errno == EINTR) continue;
    if (moved <= 0) return false;
    at += moved;
    bytes -= static_cast<std::size_t>(moved);
  }
  return true;
}

}  // namespace

bool writeWhole(int descriptor, const void* data, std::size_t bytes) {
  return inParts(static_cast<const char*>(data), bytes,
                 [&](const char* at, std::size_t left) { return ::write(descriptor, at, left); });
}

bool readWhole(int descriptor, void* data, std::size_t bytes) {
  return inParts(static_cast<char*>(data), bytes,
                 [&](char* at, std::size_t left) { return ::read(descriptor, at, left); });
}

}  // namespace hl

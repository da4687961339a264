#include "io/lzf.h"

#include <cstddef>
#include <cstring>

#include "base/error.h"

namespace hl {

namespace {

constexpr const char* kBrokenLzf = "is packed in a way that makes no sense: it is broken, or cut off";

}  // namespace

// A first byte below 32 is followed by so many bytes and one, as they are. Of another one the upper three bits are a
// length less 2, seven for one that goes on in the next byte; the lower five and a last byte are the distance less 1.
void unpackLzf(std::span<const char> packed, std::span<char> out) {
  constexpr unsigned kShortest = 32, kLong = 7;
  std::size_t at = 0, made = 0;
  const auto next = [&]() -> unsigned {
    if (at == packed.size()) throw Error(kBrokenLzf);
    return static_cast<unsigned char>(packed[at++]);
  };
  while (at < packed.size()) {
    const unsigned first = next();
    if (first < kShortest) {
      const std::size_t length = first + 1;
      if (length > packed.size() - at || length > out.size() - made) throw Error(kBrokenLzf);
      std::memcpy(out.data() + made, packed.data() + at, length);
      at += length;
      made += length;
      continue;
    }
    std::size_t length = first >> 5;
    if (length == kLong) length += next();
    length += 2;
    const std::size_t distance = (std::size_t{first & 31} << 8 | next()) + 1;
    if (distance > made || length > out.size() - made) throw Error(kBrokenLzf);
    for (; length > 0; --length, ++made) out[made] = out[made - distance];  // they may overlap
  }
  if (made != out.size()) throw Error(kBrokenLzf);
}

}  // namespace hl

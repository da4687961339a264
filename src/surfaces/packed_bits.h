// Whole numbers of any width one after the other in bytes, the lowest bit first.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace hl {

static_assert(std::endian::native == std::endian::little, "bits are read from bytes as a number of eight of them");

/// Widest number, bits: with the bits before it in its first byte it fits into eight bytes.
inline constexpr unsigned kWidestBits = 57;
/// So many bytes may be read behind a number.
inline constexpr std::size_t kReadBehind_bytes = 8;

/// The lowest bits of a number.
inline std::uint64_t lowBits(std::uint64_t number, unsigned width) {
  return number & ((std::uint64_t{1} << width) - 1);
}

/// RT-safe.
inline std::uint64_t readBits(const std::uint8_t* bytes, std::uint64_t first_bit, unsigned width) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes + first_bit / 8, sizeof word);
  return lowBits(word >> first_bit % 8, width);
}

/// Where all bits are 0. Only the bytes that have the number are touched.
inline void writeBits(std::uint8_t* bytes, std::uint64_t first_bit, unsigned width, std::uint64_t number) {
  for (unsigned done = 0; done < width;) {
    const std::uint64_t bit = first_bit + done;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] | number >> done << bit % 8);
    done += 8 - static_cast<unsigned>(bit % 8);
  }
}

}  // namespace hl

// VolumeTaker: what a reader of volumes gives, kept whole for a test to look at.
#pragma once

#include <zlib.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/file_ending.h"
#include "io/read_volumes.h"

namespace hl::test {

class VolumeTaker final : public VolumeSink {
 public:
  void header(const VolumeHeader& header) override {
    if (headers_++ > 0) throw std::logic_error("two headers");
    header_ = header;
  }
  void samples(const void* samples, std::size_t bytes) override {
    if (headers_ != 1) throw std::logic_error("samples before a header");
    const char* const first = static_cast<const char*>(samples);
    bytes_.insert(bytes_.end(), first, first + bytes);
  }
  void warn(const std::string& line) override { warnings_.push_back(line); }

  const VolumeHeader& header() const { return header_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  const std::vector<char>& bytes() const { return bytes_; }
  bool whole() const {
    return bytes_.size() == sizeOf(header_.kind) * header_.side[0] * header_.side[1] * header_.side[2];
  }
  /// Sample, before the scale of its values.
  double at(std::size_t x, std::size_t y, std::size_t z) const {
    const std::size_t place = (z * header_.side[1] + y) * header_.side[0] + x;
    switch (header_.kind) {
      case SampleKind::kInt16:
        return number<std::int16_t>(place);
      case SampleKind::kUint16:
        return number<std::uint16_t>(place);
      case SampleKind::kFloat32:
        break;
    }
    return number<float>(place);
  }
  double value(std::size_t x, std::size_t y, std::size_t z) const {
    return header_.values.offset + header_.values.scale * at(x, y, z);
  }

 private:
  template <typename Number>
  Number number(std::size_t place) const {
    Number number;
    std::memcpy(&number, bytes_.data() + place * sizeof number, sizeof number);
    return number;
  }

  VolumeHeader header_;
  int headers_ = 0;
  std::vector<char> bytes_;
  std::vector<std::string> warnings_;
};

inline VolumeTaker volumeIn(const std::string& path, bool alone = false) {
  VolumeTaker taker;
  readVolume({path, endingOf(path), alone}, taker);
  return taker;
}

/// Empty if it was taken.
inline std::string volumeRefusalOf(const std::string& path, bool alone = false) {
  try {
    volumeIn(path, alone);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The bytes of a number in the order that a file asks for.
template <typename Number>
std::string bytesOf(Number number, bool swap) {
  std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
  if (swap) bytes.assign(bytes.rbegin(), bytes.rend());
  return bytes;
}

/// As gzip.
inline std::string packed(const std::string& bytes) {
  z_stream stream{};
  constexpr int kGzip = 15 + 16, kMemory = 8;
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// The sample of a test's files, within the range of 8 bits.
inline int testSample(std::size_t x, std::size_t y, std::size_t z) {
  return static_cast<int>((7 * x + 3 * y * y + 31 * z) % 100);
}
template <typename Number>
std::string testSamples(const std::array<std::size_t, 3>& side, bool swap) {
  std::string bytes;
  for (std::size_t z = 0; z < side[2]; ++z) {
    for (std::size_t y = 0; y < side[1]; ++y) {
      for (std::size_t x = 0; x < side[0]; ++x) bytes += bytesOf(static_cast<Number>(testSample(x, y, z)), swap);
    }
  }
  return bytes;
}

}  // namespace hl::test

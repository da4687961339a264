// Laser scans: ASPRS LAS 1.4 (2019). Points are int32 steps of a lattice, so nothing of them is rounded.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/byte_file.h"
#include "io/read_clouds.h"

namespace hl {

namespace {

constexpr std::size_t kPieceOfRecords = 1 << 15;

struct LasHeader {
  unsigned format = 0;
  std::uint32_t offset_bytes = 0;  // of the first point
  std::uint16_t record_bytes = 0;
  std::uint64_t count = 0;
  CloudLattice lattice{};
};

// Little-endian, as this program's processors are.
template <typename Number>
Number lasNumber(const std::vector<char>& header, std::size_t at) {
  Number number;
  std::memcpy(&number, header.data() + at, sizeof number);
  return number;
}

CloudLattice lasLattice(const std::vector<char>& header) {
  constexpr std::size_t kScale = 131, kOffset = 155;
  CloudLattice lattice;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::size_t at = sizeof(double) * static_cast<std::size_t>(axis);
    lattice.step[axis] = lasNumber<double>(header, kScale + at);
    lattice.origin[axis] = lasNumber<double>(header, kOffset + at);
  }
  constexpr double kMin_m = 1e-12, kMax_m = 1e6;
  if (!lattice.origin.allFinite() || !(lattice.step.minCoeff() >= kMin_m && lattice.step.maxCoeff() <= kMax_m))
    throw Error("is no sound LAS file: its scale is not above 0, or its offset is no number");
  return lattice;
}

LasHeader readLasHeader(ByteFile& in) {
  constexpr std::size_t kMin = 227, kLong = 375, kCount64 = 247;
  constexpr std::array<std::uint16_t, 11> kRecordBytes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  std::vector<char> bytes(kMin);
  in.read(bytes.data(), bytes.size());
  if (std::memcmp(bytes.data(), "LASF", 4) != 0) throw Error("is not a LAS file");
  const auto minor = lasNumber<std::uint8_t>(bytes, 25);
  const auto size = lasNumber<std::uint16_t>(bytes, 94);
  LasHeader header;
  header.offset_bytes = lasNumber<std::uint32_t>(bytes, 96);
  header.format = lasNumber<std::uint8_t>(bytes, 104);
  header.record_bytes = lasNumber<std::uint16_t>(bytes, 105);
  header.count = lasNumber<std::uint32_t>(bytes, 107);
  if (header.format >= 64) throw Error(cloudAdvice(".laz"));  // the highest bits say that it is packed
  if (header.format >= kRecordBytes.size() || header.record_bytes < kRecordBytes[header.format])
    throw Error(fmt::format("has points of format {} in {} bytes: formats 0 to 10 can be read", header.format,
                            header.record_bytes));
  if (size < kMin || header.offset_bytes < size) throw Error("is no sound LAS file: its header is too short");
  header.lattice = lasLattice(bytes);
  if (minor < 4 || size < kLong) return header;
  bytes.resize(kLong);
  in.read(bytes.data() + kMin, kLong - kMin);
  header.count = lasNumber<std::uint64_t>(bytes, kCount64);
  return header;
}

// Points that are marked as withheld were deleted.
bool isWithheld(const char* record, unsigned format) {
  constexpr std::size_t kFlags = 15;
  const auto flags = static_cast<unsigned char>(record[kFlags]);
  return format < 6 ? (flags & 0x80U) != 0 : (flags & 0x04U) != 0;
}

// Bytes before the colour of a point; none: this format has none.
std::optional<std::size_t> lasColourAt(unsigned format) {
  switch (format) {
    case 2:
      return 20;
    case 3:
    case 5:
      return 28;
    case 7:
    case 8:
    case 10:
      return 30;
    default:
      return {};
  }
}

using LasColour = std::array<std::uint16_t, 3>;

LasColour lasColour(const char* record, std::size_t at) {
  LasColour colour;
  std::memcpy(colour.data(), record + at, sizeof colour);
  return colour;
}

// Calls each(records, count) for pieces of the points of a file.
template <typename Each>
void inLasPieces(ByteFile& in, const LasHeader& header, const Each& each) {
  std::vector<char> room(header.record_bytes * std::min<std::uint64_t>(header.count, kPieceOfRecords));
  for (std::uint64_t left = header.count; left > 0;) {
    const std::size_t some = std::min<std::uint64_t>(left, kPieceOfRecords);
    in.read(room.data(), some * header.record_bytes);
    if (!each(room.data(), some)) return;
    left -= some;
  }
}

constexpr std::uint16_t kMaxOfByte = 255;

// The largest number of a colour, or one above 255: then others do not matter. Colours have 16 bits, yet many programs
// write 8 of them, and some write none at all: only the whole file shows it. In one of 16 bits the first points do.
std::uint16_t mostOfColours(const std::string& path, const LasHeader& header, std::size_t at) {
  ByteFile in(path);
  in.skip(header.offset_bytes);
  std::uint16_t most = 0;
  inLasPieces(in, header, [&](const char* records, std::size_t count) {
    for (std::size_t i = 0; i < count && most <= kMaxOfByte; ++i) {
      const LasColour colour = lasColour(records + i * header.record_bytes, at);
      most = std::max(most, *std::max_element(colour.begin(), colour.end()));
    }
    return most <= kMaxOfByte;
  });
  return most;
}

Mat3 eastNorthUp() {
  Mat3 turn;
  turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return turn;
}

}  // namespace

void readLas(const ModelFile& file, CloudSink& sink) {
  ByteFile in(file.path);
  const LasHeader header = readLasHeader(in);
  in.skip(header.offset_bytes - in.place());
  if (header.count > std::numeric_limits<std::uint64_t>::max() / header.record_bytes) throw Error(kEndsEarly);
  in.expect(header.count * header.record_bytes);
  sink.header({header.lattice, eastNorthUp()});
  std::optional<std::size_t> colour_at = lasColourAt(header.format);
  const std::uint16_t most = colour_at ? mostOfColours(file.path, header, *colour_at) : std::uint16_t{0};
  if (most == 0) colour_at.reset();
  const unsigned shift = most > kMaxOfByte ? 8 : 0;
  std::vector<std::array<std::int32_t, 3>> steps;
  std::vector<Rgb> colours;
  std::uint64_t withheld = 0;
  inLasPieces(in, header, [&](const char* records, std::size_t count) {
    steps.clear();
    colours.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const char* const record = records + i * header.record_bytes;
      if (isWithheld(record, header.format)) {
        ++withheld;
        continue;
      }
      std::memcpy(steps.emplace_back().data(), record, sizeof steps[0]);
      if (!colour_at) continue;
      const LasColour colour = lasColour(record, *colour_at);
      const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(colour[k] >> shift); };
      colours.push_back({byte(0), byte(1), byte(2)});
    }
    if (!steps.empty()) sink.points({steps, {}, {}, colours});
    return true;
  });
  if (withheld > 0) sink.warn(fmt::format("left out {} points that are marked as withheld", withheld));
}

}  // namespace hl

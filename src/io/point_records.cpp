#include "io/point_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/error.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr std::size_t kPieceOfPoints = 1 << 15;

template <typename Number>
double readNumber(const char* at, bool swap) {
  Number number;
  std::memcpy(&number, at, sizeof number);
  return static_cast<double>(swap ? swapped(number) : number);
}

}  // namespace

std::size_t sizeOf(ScalarKind form) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(form)];
}

double numberAt(const char* record, const RecordField& field, bool swap) {
  const char* const at = record + field.offset;
  switch (field.form) {
    case ScalarKind::kInt8:
      return readNumber<std::int8_t>(at, false);
    case ScalarKind::kUint8:
      return readNumber<std::uint8_t>(at, false);
    case ScalarKind::kInt16:
      return readNumber<std::int16_t>(at, swap);
    case ScalarKind::kUint16:
      return readNumber<std::uint16_t>(at, swap);
    case ScalarKind::kInt32:
      return readNumber<std::int32_t>(at, swap);
    case ScalarKind::kUint32:
      return readNumber<std::uint32_t>(at, swap);
    case ScalarKind::kInt64:
      return readNumber<std::int64_t>(at, swap);
    case ScalarKind::kUint64:
      return readNumber<std::uint64_t>(at, swap);
    case ScalarKind::kFloat:
      return readNumber<float>(at, swap);
    case ScalarKind::kDouble:
      break;
  }
  return readNumber<double>(at, swap);
}

void PointRecord::requireCoordinates() const {
  if (!fields[kPointX] || !fields[kPointY] || !fields[kPointZ]) throw Error("has points without x, y and z");
}

namespace {

// What a colour of this form is multiplied by to be 0..1; 0: it is none.
double colourFactor(ScalarKind form) {
  if (form == ScalarKind::kUint8) return 1.0 / 255;
  if (form == ScalarKind::kUint16) return 1.0 / 65535;
  return form == ScalarKind::kFloat || form == ScalarKind::kDouble ? 1 : 0;
}

}  // namespace

bool PointRecord::hasColours() const {
  if (fields[kPackedRgb]) return true;
  const auto is_colour = [&](PointNumber n) { return fields[n] && colourFactor(fields[n]->form) > 0; };
  return is_colour(kRed) && is_colour(kGreen) && is_colour(kBlue);
}

Rgb PointRecord::colourOf(const PointNumbers& numbers) const {
  if (fields[kPackedRgb]) {
    const double packed = numbers[kPackedRgb];
    constexpr double kMax = std::numeric_limits<std::uint32_t>::max();
    if (fields[kPackedRgb]->form == ScalarKind::kFloat)
      return unpackRgb(std::bit_cast<std::uint32_t>(static_cast<float>(packed)));
    return unpackRgb(packed > 0 ? static_cast<std::uint32_t>(std::min(packed, kMax)) : 0);
  }
  const auto byte = [&](PointNumber n) { return colourByte(colourFactor(fields[n]->form) * numbers[n]); };
  return {byte(kRed), byte(kGreen), byte(kBlue)};
}

std::optional<PointNumber> pointNumberOf(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PointNumber>, 18> kNames{{{"x", kPointX},
                                                                             {"y", kPointY},
                                                                             {"z", kPointZ},
                                                                             {"nx", kNormalX},
                                                                             {"ny", kNormalY},
                                                                             {"nz", kNormalZ},
                                                                             {"normal_x", kNormalX},
                                                                             {"normal_y", kNormalY},
                                                                             {"normal_z", kNormalZ},
                                                                             {"r", kRed},
                                                                             {"g", kGreen},
                                                                             {"b", kBlue},
                                                                             {"red", kRed},
                                                                             {"green", kGreen},
                                                                             {"blue", kBlue},
                                                                             {"diffuse_red", kRed},
                                                                             {"diffuse_green", kGreen},
                                                                             {"diffuse_blue", kBlue}}};
  for (const auto& [of, number] : kNames) {
    if (of == name) return number;
  }
  return {};
}

void PointPieces::add(const PointNumbers& numbers) {
  const Vec3 position(numbers[kPointX], numbers[kPointY], numbers[kPointZ]);
  if (!position.allFinite()) return;
  positions_.push_back(position);
  if (normals_) packed_.push_back(packNormal(Vec3(numbers[kNormalX], numbers[kNormalY], numbers[kNormalZ])));
  if (coloured_) colours_.push_back(record_.colourOf(numbers));
  if (positions_.size() == kPieceOfPoints) flush();
}

void PointPieces::flush() {
  if (!positions_.empty()) sink_.points({{}, positions_, packed_, colours_});
  positions_.clear();
  colours_.clear();
  packed_.clear();
}

void copyRecords(ByteFile& in, std::uint64_t count, const PointRecord& record, CloudSink& sink) {
  if (record.bytes == 0 || count > std::numeric_limits<std::uint64_t>::max() / record.bytes) throw Error(kEndsEarly);
  in.expect(count * record.bytes);
  PointPieces pieces(sink, record);
  std::vector<char> room(record.bytes * std::min<std::uint64_t>(count, kPieceOfPoints));
  PointNumbers numbers{};
  for (std::uint64_t left = count; left > 0;) {
    const std::size_t some = std::min<std::uint64_t>(left, kPieceOfPoints);
    in.read(room.data(), some * record.bytes);
    for (std::size_t i = 0; i < some; ++i) {
      for (std::size_t k = 0; k < kPointNumbers; ++k) {
        if (record.fields[k]) numbers[k] = numberAt(room.data() + i * record.bytes, *record.fields[k], record.swap);
      }
      pieces.add(numbers);
    }
    left -= some;
  }
  pieces.flush();
}

void copyLines(ByteFile in, std::uint64_t count, const PointRecord& record, const std::string& kind, CloudSink& sink) {
  TextWords words(std::move(in), kind);
  PointPieces pieces(sink, record);
  PointNumbers numbers{};
  for (std::uint64_t i = 0; i < count; ++i) {
    for (std::size_t column = 0; column < record.bytes; ++column) {
      const double value = words.number("a point");
      for (std::size_t k = 0; k < kPointNumbers; ++k) {
        if (record.fields[k] && record.fields[k]->offset == column) numbers[k] = value;
      }
    }
    pieces.add(numbers);
  }
  pieces.flush();
}

}  // namespace hl

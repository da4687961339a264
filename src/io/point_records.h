// Points in records of binary files, all of the same bytes, and in the columns of text: where their numbers are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/byte_file.h"
#include "io/cloud_sink.h"

namespace hl {

/// The numbers of a point that count. kPackedRgb: its colour as one number, or as a float of the same bits.
enum PointNumber : std::uint8_t {
  kPointX,
  kPointY,
  kPointZ,
  kNormalX,
  kNormalY,
  kNormalZ,
  kRed,
  kGreen,
  kBlue,
  kPackedRgb,
  kPointNumbers
};
using PointNumbers = std::array<double, kPointNumbers>;

enum class ScalarKind : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat,
  kDouble
};
std::size_t sizeOf(ScalarKind form);

struct RecordField {
  std::size_t offset = 0;  ///< bytes; in text: number of the column
  ScalarKind form = ScalarKind::kFloat;
};

struct PointRecord {
  std::size_t bytes = 0;  ///< of a record; in text: columns
  bool swap = false;      ///< the bytes of each number are in the other order
  std::array<std::optional<RecordField>, kPointNumbers> fields{};

  /// Throws hl::Error where a coordinate lacks.
  void requireCoordinates() const;
  bool hasNormals() const { return fields[kNormalX] && fields[kNormalY] && fields[kNormalZ]; }
  /// Whether there are numbers that are colours: whole ones of 8 or 16 bits, or of 0 to 1.
  bool hasColours() const;
  /// Requires hasColours().
  Rgb colourOf(const PointNumbers& numbers) const;
};

/// The number of a name such as "x", "nx", "normal_x" or "red".
std::optional<PointNumber> pointNumberOf(std::string_view name);

/// Gathers points and hands them on in pieces.
class PointPieces {
 public:
  PointPieces(CloudSink& sink, const PointRecord& record)
      : sink_(sink), record_(record), normals_(record.hasNormals()), coloured_(record.hasColours()) {}
  /// Nothing of a point whose coordinates are no numbers.
  void add(const PointNumbers& numbers);
  /// After the last.
  void flush();

 private:
  CloudSink& sink_;
  const PointRecord record_;
  const bool normals_, coloured_;
  std::vector<Vec3> positions_;
  std::vector<std::uint32_t> packed_;
  std::vector<Rgb> colours_;
};

/// `count` records that follow each other. Throws hl::Error if the file ends before.
void copyRecords(ByteFile& in, std::uint64_t count, const PointRecord& record, CloudSink& sink);

/// `count` lines of numbers. Throws hl::Error if the file ends before, or for a word that is no number.
void copyLines(ByteFile in, std::uint64_t count, const PointRecord& record, const std::string& kind, CloudSink& sink);

/// One number of a record.
double numberAt(const char* record, const RecordField& field, bool swap);

}  // namespace hl

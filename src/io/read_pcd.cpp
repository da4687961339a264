// PCD files of the Point Cloud Library, version 0.7: ascii, binary and binary_compressed.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/error.h"
#include "io/lzf.h"
#include "io/point_records.h"
#include "io/read_clouds.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr const char* kNoPcd = "is no sound PCD file: ";

struct PcdField {
  std::string name;
  std::size_t size = 4, count = 1;
  char type = 'F';
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t points = 0;
  std::string data;
};

std::uint64_t pcdNumber(const std::string& word) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size())
    throw Error(std::string(kNoPcd) + "'" + shown(word) + "' is no number");
  return number;
}

void setEach(std::vector<PcdField>& fields, const std::string& key, const std::vector<std::string>& words) {
  if (words.size() != fields.size()) throw Error(std::string(kNoPcd) + key + " needs a word for each of FIELDS");
  constexpr std::size_t kMaxNumbers = 1 << 16;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (key == "TYPE") fields[i].type = words[i][0];
    if (key == "SIZE") fields[i].size = pcdNumber(words[i]);
    if (key == "COUNT") fields[i].count = pcdNumber(words[i]);
    if (fields[i].count > kMaxNumbers || fields[i].size > sizeof(double))
      throw Error(std::string(kNoPcd) + "its SIZE or COUNT is too large");
  }
}

// Up to the line DATA.
PcdHeader readPcdHeader(ByteFile& in) {
  constexpr std::size_t kMaxLines = 1000, kMaxFields = 1000;
  PcdHeader header;
  std::uint64_t width = 0, height = 1;
  std::string line;
  for (std::size_t lines = 0; lines < kMaxLines && in.line(line); ++lines) {
    std::istringstream text(line);
    std::string key;
    std::vector<std::string> words;
    text >> key;
    for (std::string word; words.size() < kMaxFields && text >> word;) words.push_back(word);
    if (key.empty() || key[0] == '#') continue;
    if (words.empty()) throw Error(std::string(kNoPcd) + "a line of its header is '" + shown(line) + "'");
    if (key == "FIELDS" || key == "COLUMNS") {
      header.fields.clear();
      for (const std::string& word : words) header.fields.push_back({word});
    }
    if (key == "SIZE" || key == "TYPE" || key == "COUNT") setEach(header.fields, key, words);
    if (key == "WIDTH") width = pcdNumber(words[0]);
    if (key == "HEIGHT") height = pcdNumber(words[0]);
    if (key == "POINTS") header.points = pcdNumber(words[0]);
    if (key != "DATA") continue;
    constexpr std::uint64_t kMaxSide = std::uint64_t{1} << 31;
    if (header.points == 0 && width < kMaxSide && height < kMaxSide) header.points = width * height;
    header.data = words[0];
    return header;
  }
  throw Error(std::string(kNoPcd) + "its header has no line DATA");
}

ScalarKind pcdKind(const PcdField& field) {
  constexpr std::array<std::tuple<char, std::size_t, ScalarKind>, 10> kForms{{{'I', 1, ScalarKind::kInt8},
                                                                              {'U', 1, ScalarKind::kUint8},
                                                                              {'I', 2, ScalarKind::kInt16},
                                                                              {'U', 2, ScalarKind::kUint16},
                                                                              {'I', 4, ScalarKind::kInt32},
                                                                              {'U', 4, ScalarKind::kUint32},
                                                                              {'I', 8, ScalarKind::kInt64},
                                                                              {'U', 8, ScalarKind::kUint64},
                                                                              {'F', 4, ScalarKind::kFloat},
                                                                              {'F', 8, ScalarKind::kDouble}}};
  for (const auto& [type, size, form] : kForms) {
    if (type == field.type && size == field.size) return form;
  }
  throw Error(fmt::format("{}a field of type {} has {} bytes", kNoPcd, shown(std::string(1, field.type)), field.size));
}

// The Point Cloud Library keeps a colour as 0xRRGGBB in four bytes, which it calls a float or a whole number.
bool isPackedRgb(const PcdField& field) {
  return (field.name == "rgb" || field.name == "rgba") && field.count == 1 && field.size == sizeof(std::uint32_t) &&
         (field.type == 'F' || field.type == 'U');
}

// `text`: columns count in place of bytes.
PointRecord pcdRecord(const PcdHeader& header, bool text) {
  PointRecord record;
  for (const PcdField& field : header.fields) {
    const std::optional<PointNumber> number = pointNumberOf(field.name);
    if (number && field.count == 1) record.fields[*number] = {record.bytes, pcdKind(field)};
    if (isPackedRgb(field)) record.fields[kPackedRgb] = {record.bytes, text ? pcdKind(field) : ScalarKind::kUint32};
    record.bytes += field.count * (text ? 1 : field.size);
  }
  record.requireCoordinates();
  return record;
}

// Unpacked, all numbers of a field follow each other.
void copyPacked(ByteFile& in, const PcdHeader& header, PointRecord record, CloudSink& sink) {
  constexpr std::uint64_t kMaxBytes = 0xffffffff;
  std::array<std::uint32_t, 2> sizes{};
  in.read(sizes.data(), sizeof sizes);
  const auto [packed_bytes, bytes] = sizes;
  if (record.bytes == 0 || header.points > kMaxBytes / record.bytes || header.points * record.bytes != bytes)
    throw Error(fmt::format("{}it has {} bytes for {} points", kNoPcd, bytes, header.points));
  in.expect(packed_bytes);
  constexpr std::uint64_t kMaxPacked = 128;  // LZF makes no more of a byte
  if (bytes / kMaxPacked > packed_bytes) throw Error(std::string(kNoPcd) + "it unpacks to more than it could");
  std::vector<char> packed(packed_bytes), all(bytes);
  in.read(packed.data(), packed.size());
  unpackLzf(packed, all);
  PointPieces pieces(sink, record);
  PointNumbers numbers{};
  for (std::uint64_t i = 0; i < header.points; ++i) {
    for (std::size_t k = 0; k < kPointNumbers; ++k) {
      if (!record.fields[k]) continue;
      const RecordField& field = *record.fields[k];
      numbers[k] = numberAt(all.data() + field.offset * header.points + i * sizeOf(field.form), {0, field.form}, false);
    }
    pieces.add(numbers);
  }
  pieces.flush();
}

}  // namespace

void readPcd(const ModelFile& file, CloudSink& sink) {
  ByteFile in(file.path);
  const PcdHeader header = readPcdHeader(in);
  const bool text = header.data == "ascii";
  const PointRecord record = pcdRecord(header, text);
  sink.header({});
  if (text) return copyLines(std::move(in), header.points, record, "a PCD file", sink);
  if (header.data == "binary") return copyRecords(in, header.points, record, sink);
  if (header.data == "binary_compressed") return copyPacked(in, header, record, sink);
  throw Error(std::string(kNoPcd) + "its DATA is '" + shown(header.data) + "', not ascii, binary or binary_compressed");
}

}  // namespace hl

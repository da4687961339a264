#include "io/nrrd_header.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr std::size_t kMaxAxes = 16;

[[noreturn]] void failNrrd(const std::string& why) { throw Error("is not a sound NRRD file: " + why); }

// Pieces of `text` between letters of `separators`, the empty ones left out.
std::vector<std::string_view> piecesOf(std::string_view text, const char* separators) {
  std::vector<std::string_view> pieces;
  for (std::size_t at = text.find_first_not_of(separators); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    pieces.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(separators, end);
  }
  return pieces;
}

double numberIn(std::string_view text) {
  double value = 0;
  const std::string_view digits = text.substr(text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    failNrrd(fmt::format("'{}' is no number", shown(text)));
  return value;
}

std::vector<double> numbersIn(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view word : piecesOf(text, " \t")) numbers.push_back(numberIn(word));
  return numbers;
}

std::vector<std::string> wordsIn(std::string_view text) {
  std::vector<std::string> words;
  for (const std::string_view word : piecesOf(text, " \t")) words.emplace_back(word);
  return words;
}

// "(1,0,0) (0,1,0) none (0,0,2.5)"
std::vector<std::optional<Vec3>> vectorsIn(std::string_view text) {
  std::vector<std::optional<Vec3>> vectors;
  while (!(text = trimmed(text)).empty()) {
    if (text.starts_with("none")) {
      vectors.emplace_back();
      text.remove_prefix(4);
      continue;
    }
    const std::size_t end = text.find(')');
    if (text[0] != '(' || end == std::string_view::npos) failNrrd("its space directions are no list of vectors");
    const auto parts = piecesOf(text.substr(1, end - 1), ", ");
    if (parts.size() < 3) failNrrd("its space has less than three dimensions");
    vectors.emplace_back(Vec3(numberIn(parts[0]), numberIn(parts[1]), numberIn(parts[2])));
    text.remove_prefix(end + 1);
  }
  return vectors;
}

NumberType typeNamed(const std::string& name) {
  using Names = std::pair<NumberType, std::array<std::string_view, 5>>;
  static constexpr std::array<Names, 8> kNames{
      {{NumberType::kInt8, {"signed char", "int8", "int8_t"}},
       {NumberType::kUint8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
       {NumberType::kInt16, {"short", "short int", "signed short", "int16", "int16_t"}},
       {NumberType::kUint16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
       {NumberType::kInt32, {"int", "signed int", "int32", "int32_t"}},
       {NumberType::kUint32, {"uint", "unsigned int", "uint32", "uint32_t"}},
       {NumberType::kFloat32, {"float"}},
       {NumberType::kFloat64, {"double"}}}};
  const std::string wanted = name == "signed short int" ? "int16" : name;
  for (const auto& [type, names] : kNames) {
    if (!wanted.empty() && std::find(names.begin(), names.end(), wanted) != names.end()) return type;
  }
  throw Error(
      fmt::format("has numbers of type '{}': a volume has integers of 8, 16 or 32 bits, float or double", shown(name)));
}

// The first of "mm" "mm" "mm".
std::string firstUnit(std::string_view text) {
  const std::size_t begin = text.find('"'), end = begin == std::string_view::npos ? begin : text.find('"', begin + 1);
  return end == std::string_view::npos ? "" : std::string(text.substr(begin + 1, end - begin - 1));
}

bool isBigEndian(const std::string& name) {
  if (name != "big" && name != "little") failNrrd(fmt::format("'{}' is no endian", shown(name)));
  return name == "big";
}

/// What the fields of a file say, one after the other.
class NrrdFields {
 public:
  void take(const std::string& field, std::string_view value) {
    if (!taken_.insert(field).second) failNrrd(fmt::format("it has two fields '{}'", shown(field)));
    const std::string low = lowered(value);
    if (field == "type") header_.type = typeNamed(low), typed_ = true;
    if (field == "encoding") header_.encoding = low;
    if (field == "endian") header_.big_endian = isBigEndian(low);
    if (field == "dimension") dimension_ = numberIn(value);
    if (field == "sizes") header_.sizes = numbersIn(value);
    if (field == "space") header_.space = low;
    if (field == "space directions") header_.directions = vectorsIn(low);
    if (field == "spacings") header_.spacings = numbersIn(low);
    if (field == "space units" || (field == "units" && header_.unit.empty())) header_.unit = firstUnit(value);
    if (field == "data file" || field == "datafile") header_.data_file = value;
    if (field == "line skip" || field == "lineskip") header_.line_skip = numberIn(value);
    if (field == "byte skip" || field == "byteskip") header_.byte_skip = numberIn(value);
    if (field == "axis mins" || field == "axismins") header_.axis_mins = numbersIn(low);
    if (field == "axis maxs" || field == "axismaxs") header_.axis_maxs = numbersIn(low);
    if (field == "centerings" || field == "centers") header_.centerings = wordsIn(low);
    if (field == "kinds") header_.kinds = wordsIn(low);
  }
  NrrdHeader whole() const {
    const std::size_t axes = header_.sizes.size();
    const auto fits = [&](std::size_t count) { return count == 0 || count == axes; };
    if (!typed_) failNrrd("it has no type");
    if (header_.encoding.empty()) failNrrd("it has no encoding");
    if (axes == 0 || axes > kMaxAxes || dimension_ != static_cast<double>(axes))
      failNrrd(fmt::format("it has dimension {:g} and {} sizes", dimension_, axes));
    if (!fits(header_.directions.size())) failNrrd("it has not one space direction for each axis");
    if (!fits(header_.spacings.size())) failNrrd("it has not one spacing for each axis");
    if (!fits(header_.kinds.size())) failNrrd("it has not one kind for each axis");
    if (!fits(header_.axis_mins.size()) || !fits(header_.axis_maxs.size()))
      failNrrd("it has not one axis min and max for each axis");
    if (!fits(header_.centerings.size())) failNrrd("it has not one centering for each axis");
    return header_;
  }

 private:
  std::set<std::string> taken_;
  NrrdHeader header_;
  double dimension_ = 0;
  bool typed_ = false;
};

}  // namespace

NrrdHeader readNrrdHeader(ByteFile& in) {
  std::array<char, 5> magic{};
  in.read(magic.data(), magic.size());
  std::string line;
  if (std::string_view(magic.data(), magic.size()) != "NRRD0" || !in.line(line)) throw Error("is not a NRRD file");
  NrrdFields fields;
  while (in.line(line) && !line.empty()) {
    if (line[0] == '#' || line.find(":=") != std::string::npos) continue;
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) failNrrd(fmt::format("'{}' is no field", shown(line)));
    fields.take(lowered(std::string_view(line).substr(0, colon)), trimmed(std::string_view(line).substr(colon + 1)));
  }
  return fields.whole();
}

}  // namespace hl

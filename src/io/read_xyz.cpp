// Lists of points in text, a point a line. No format says what follows x, y and z: it is what a line of names says, and
// without one what the numbers of the first lines can be, if only one thing is possible.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/fixed_vector.h"
#include "base/text.h"
#include "io/point_records.h"
#include "io/read_clouds.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr std::size_t kMaxColumns = 32;  // what is beyond does not count
using PointRow = FixedVector<double, kMaxColumns>;

enum class DecimalMark : std::uint8_t { kPoint, kComma };

const char* separatorsFor(DecimalMark mark) { return mark == DecimalMark::kComma ? " \t;" : " \t,;"; }

// No number is longer.
bool readPointNumber(std::string_view word, DecimalMark mark, double& number) {
  constexpr std::size_t kLongest = 64;
  std::array<char, kLongest> digits;
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || word.size() > digits.size()) return false;
  std::copy(word.begin(), word.end(), digits.begin());
  const char* const last = digits.data() + word.size();
  if (mark == DecimalMark::kComma) std::replace(digits.begin(), digits.begin() + word.size(), ',', '.');
  const auto [end, error] = std::from_chars(digits.data(), last, number);
  return end == last && error != std::errc::invalid_argument;
}

// The numbers of a line; an empty field, or a word that is no number, ends them.
PointRow rowOf(std::string_view line, DecimalMark mark) {
  const std::string_view separators = separatorsFor(mark);
  PointRow row;
  while (row.size() < kMaxColumns) {
    const std::size_t begin = line.find_first_not_of(separators);
    if (begin == std::string_view::npos) break;
    const auto marks = std::count_if(line.begin(), line.begin() + begin, [](char c) { return c == ',' || c == ';'; });
    if (marks > (row.empty() ? 0 : 1)) break;
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(separators));
    double number = 0;
    if (!readPointNumber(word, mark, number)) break;
    row.push(number);
    line.remove_prefix(word.size());
  }
  return row;
}

/// The columns of a list by their names: x, y and z are among them.
using ColumnNames = std::vector<std::optional<PointNumber>>;

// Nothing: these are no names of columns.
std::optional<ColumnNames> columnNamesOf(std::string_view line) {
  constexpr std::string_view kBetween = " \t,;\"";
  const std::string text = lowered(line);
  ColumnNames names;
  std::array<bool, kPointNumbers> named{};
  for (std::string_view rest = text; names.size() < kMaxColumns;) {
    const std::size_t begin = rest.find_first_not_of(kBetween);
    if (begin == std::string_view::npos) break;
    rest.remove_prefix(begin);
    const std::string_view word = rest.substr(0, rest.find_first_of(kBetween));
    rest.remove_prefix(word.size());
    names.push_back(pointNumberOf(word));
    if (!names.back()) continue;
    if (named[*names.back()]) return {};
    named[*names.back()] = true;
  }
  const bool all = named[kPointX] && named[kPointY] && named[kPointZ];
  return all ? std::optional(names) : std::nullopt;
}

// Prose may have an x, a y and a z in it.
std::optional<ColumnNames> namesInComment(std::string_view comment) {
  const std::size_t begin = std::min(comment.find_first_not_of("#/ \t"), comment.size());
  std::optional<ColumnNames> names = columnNamesOf(comment.substr(begin));
  const ColumnNames::value_type x = kPointX, y = kPointY, z = kPointZ;
  if (!names || (*names)[0] != x || (*names)[1] != y || (*names)[2] != z) return {};
  return names;
}

/// The lines of a list that hold points.
class PointLines {
 public:
  explicit PointLines(const std::string& path) : in_(path) {}

  /// False at the end. The text is valid until the next call.
  bool next(std::string_view& text) {
    while (in_.line(line_)) {
      text = trimmed(++number_ == 1 ? withoutByteOrderMark(line_) : line_);
      if (text.empty()) continue;
      const bool comment = text.starts_with('#') || text.starts_with("//");
      if (comment && !begun_ && !names_) names_ = namesInComment(text);
      if (comment || (!begun_ && isHead(text))) continue;
      begun_ = true;
      return true;
    }
    return false;
  }
  /// Of the line, from 1.
  std::uint64_t number() const { return number_; }
  /// As the lines before the first point give them.
  const std::optional<ColumnNames>& names() const { return names_; }

 private:
  // The number of points, or the names of their columns; each is there once at most.
  bool isHead(std::string_view text) {
    if (!counted_ && rowOf(text, DecimalMark::kPoint).size() == 1) return counted_ = true;
    if (named_) return false;
    const std::optional<ColumnNames> names = columnNamesOf(text);
    if (names) names_ = names;
    return named_ = names.has_value();
  }

  ByteFile in_;
  std::string line_;
  std::uint64_t number_ = 0;
  bool begun_ = false, counted_ = false, named_ = false;
  std::optional<ColumnNames> names_;
};

/// What was seen of some lines of points.
class SeenRows {
 public:
  void add(const PointRow& row) {
    columns_ = std::min(columns_, row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      least_[i] = std::min(least_[i], row[i]);
      most_[i] = std::max(most_[i], row[i]);
      whole_[i] = whole_[i] && row[i] == std::floor(row[i]);
      if (i < 2) continue;
      constexpr double kRounded = 0.01;
      unit_[i - 2] = unit_[i - 2] && std::abs(Vec3(row[i - 2], row[i - 1], row[i]).norm() - 1) < kRounded;
    }
    ++rows_;
  }

  /// Normals are columns that are of length 1 together, colours whole ones of 0 to 255, if there is no other choice.
  PointRecord guessed() const {
    PointRecord record;
    set(record, kPointX, 0, ScalarKind::kDouble);
    const std::size_t columns = rows_ > 0 ? columns_ : 0;
    std::optional<std::size_t> normals;
    std::vector<std::size_t> colours;
    for (std::size_t first = 3; first + 3 <= columns && !normals; ++first) {
      if (unit_[first]) normals = first;
    }
    if (normals) set(record, kNormalX, *normals, ScalarKind::kDouble);
    for (std::size_t first = 3; first + 3 <= columns; ++first) {
      const bool apart = !normals || first + 3 <= *normals || *normals + 3 <= first;
      if (apart && isColour(first)) colours.push_back(first);
    }
    if (colours.size() == 1) set(record, kRed, colours[0], ScalarKind::kUint8);
    return record;
  }

  PointRecord named(const ColumnNames& names) const {
    PointRecord record;
    double most = 0;
    bool whole = true;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!names[i]) continue;
      record.fields[*names[i]] = {i, ScalarKind::kDouble};
      if (*names[i] != kRed && *names[i] != kGreen && *names[i] != kBlue) continue;
      most = std::max(most, most_[i]);
      whole = whole && whole_[i];
    }
    for (const PointNumber colour : {kRed, kGreen, kBlue}) {
      if (record.fields[colour]) record.fields[colour]->form = colourForm(most, whole);
    }
    return record;
  }

 private:
  static constexpr double kMaxByte = 255;

  template <typename T>
  static std::array<T, kMaxColumns> filled(T value) {
    std::array<T, kMaxColumns> all;
    all.fill(value);
    return all;
  }

  static void set(PointRecord& record, PointNumber number, std::size_t first, ScalarKind form) {
    for (std::size_t i = 0; i < 3; ++i) record.fields[number + i] = {first + i, form};
  }

  bool isColour(std::size_t first) const {
    double most = 0;
    for (std::size_t i = first; i < first + 3; ++i) {
      if (!whole_[i] || least_[i] < 0 || most_[i] > kMaxByte) return false;
      most = std::max(most, most_[i]);
    }
    return most > 0;
  }

  // 0 to 1, or whole numbers of one byte or two.
  static ScalarKind colourForm(double most, bool whole) {
    if (most <= 1 && !whole) return ScalarKind::kDouble;
    return most <= kMaxByte ? ScalarKind::kUint8 : ScalarKind::kUint16;
  }

  std::size_t rows_ = 0, columns_ = kMaxColumns;
  std::array<double, kMaxColumns> least_ = filled(std::numeric_limits<double>::infinity()),
                                  most_ = filled(-std::numeric_limits<double>::infinity());
  std::array<bool, kMaxColumns> whole_ = filled(true), unit_ = filled(true);  // unit: with the two that follow
};

// "1,5 2,5 3,5": words that are parted by something else, some with a comma between digits.
bool hasDecimalCommas(std::string_view line) {
  constexpr std::size_t kCoordinates = 3;
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t commas = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != ',') continue;
    ++commas;
    if (i == 0 || i + 1 == line.size() || !digit(line[i - 1]) || !digit(line[i + 1])) return false;
  }
  return commas > 0 && rowOf(line, DecimalMark::kComma).size() >= kCoordinates;
}

/// How a list is written.
struct ListForm {
  PointRecord record;  // columns
  DecimalMark mark = DecimalMark::kPoint;
};

ListForm listFormOf(const std::string& path) {
  constexpr std::size_t kLooked = 1000;  // lines
  std::vector<std::string> looked;
  PointLines lines(path);
  for (std::string_view text; looked.size() < kLooked && lines.next(text);) looked.emplace_back(text);
  const bool commas =
      std::any_of(looked.begin(), looked.end(), [](const auto& line) { return hasDecimalCommas(line); });
  ListForm form;
  form.mark = commas ? DecimalMark::kComma : DecimalMark::kPoint;
  SeenRows seen;
  for (const std::string& line : looked) seen.add(rowOf(line, form.mark));
  form.record = lines.names() ? seen.named(*lines.names()) : seen.guessed();
  return form;
}

// What a line lacks is 0.
PointNumbers numbersIn(const PointRow& row, const PointRecord& record) {
  PointNumbers numbers{};
  for (std::size_t k = 0; k < kPointNumbers; ++k) {
    if (record.fields[k] && record.fields[k]->offset < row.size()) numbers[k] = row[record.fields[k]->offset];
  }
  return numbers;
}

}  // namespace

void readXyz(const ModelFile& file, CloudSink& sink) {
  const auto& [record, mark] = listFormOf(file.path);
  sink.header({});
  PointLines lines(file.path);
  PointPieces pieces(sink, record);
  const std::size_t columns =
      1 + std::max({record.fields[kPointX]->offset, record.fields[kPointY]->offset, record.fields[kPointZ]->offset});
  for (std::string_view text; lines.next(text);) {
    const PointRow row = rowOf(text, mark);
    if (row.size() < columns)
      throw Error(
          fmt::format("is no list of points: line {} is '{}', and a point is x y z", lines.number(), shown(text)));
    pieces.add(numbersIn(row, record));
  }
  pieces.flush();
}

}  // namespace hl

// SRTM tiles, Esri ASCII grids and NumPy arrays: forms so simple that they need no library.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "io/copy_samples.h"
#include "io/read_heights.h"
#include "io/text_words.h"

namespace hl {

namespace {

/// "N37W123" gives the south-west corner of a tile, in degrees.
std::optional<double> southOf(const ModelFile& file) {
  const std::string name = file.name.empty() ? std::filesystem::path(file.path).filename().string() : file.name;
  int degrees = 0;
  if (name.size() < 7 || (name[0] != 'N' && name[0] != 'S' && name[0] != 'n' && name[0] != 's')) return {};
  const auto [end, error] = std::from_chars(name.data() + 1, name.data() + 3, degrees);
  if (error != std::errc() || end != name.data() + 3) return {};
  return name[0] == 'N' || name[0] == 'n' ? degrees : -degrees;
}

struct EsriHeader {
  std::optional<double> columns, rows, east, south;
  double missing = -9999;
};

// Reads up to the first word that is a number where a key should be, which is the first sample.
double readEsriHeader(TextWords& words, EsriHeader& header) {
  std::string_view word;
  while (words.next(word)) {
    const std::string key = lowered(word);
    if (key.empty() || !isLetter(key[0]) || key == "nan") return words.numberOf(key, "a height");
    const double value = words.number(shown(key).c_str());
    if (key == "ncols") header.columns = value;
    if (key == "nrows") header.rows = value;
    if (key == "cellsize") header.east = header.south = value;
    if (key == "dx") header.east = value;
    if (key == "dy") header.south = value;
    if (key == "nodata_value") header.missing = value;
  }
  throw Error(kEndsEarly);
}

std::uint32_t sideOf(std::optional<double> given, const char* what) {
  if (!given) throw Error(fmt::format("its header lacks {}", what));
  const double count = *given;
  if (!(count >= 2 && count <= kMaxGridSide && count == std::floor(count)))
    throw Error(fmt::format("has {:g} {}: a height field has 2 to {}", count, what, kMaxGridSide));
  return static_cast<std::uint32_t>(count);
}

struct NumpyHeader {
  std::string type;  // "<f4"
  bool fortran = false;
  std::uint32_t rows = 0, columns = 0;
};

// The value of a key in "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }".
std::string_view valueOf(std::string_view text, std::string_view key) {
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) throw Error("is not a sound NumPy file: its header has no " + std::string(key));
  std::string_view rest = text.substr(at + key.size());
  const std::size_t begin = rest.find_first_not_of("': ");
  if (begin == std::string_view::npos) throw Error("is not a sound NumPy file: its header ends early");
  rest.remove_prefix(begin);
  return rest.substr(0, rest.find_first_of(rest.starts_with('(') ? ")" : "',"));
}

NumpyHeader numpyHeaderOf(std::string_view text) {
  NumpyHeader header;
  header.type = valueOf(text, "descr");
  header.fortran = valueOf(text, "fortran_order").starts_with("True");
  const std::string_view sides = valueOf(text, "shape");
  if (!sides.starts_with('(')) throw Error("has no shape: a height field has two sides");
  const std::string shape = without(" L", sides.substr(1));
  if (std::count(shape.begin(), shape.end(), ',') == 2 && !shape.ends_with(','))
    throw Error("has shape (" + shown(shape) +
                "), and a height field has two sides: save a volume as NRRD or NIfTI, or " +
                "give its array to hl.Scene(volume=...)");
  double side[2] = {0, 0};
  const char *at = shape.data(), *const last = at + shape.size();
  for (double& one : side) {
    const auto [end, error] = std::from_chars(at, last, one);
    if (error != std::errc()) throw Error("has shape (" + shown(shape) + "): a height field has two sides");
    at = end != last && *end == ',' ? end + 1 : end;
  }
  if (at != last) throw Error("has shape (" + shown(shape) + "): a height field has two sides");
  header.rows = sideOf(side[0], "rows");
  header.columns = sideOf(side[1], "columns");
  return header;
}

}  // namespace

void readSrtm(const ModelFile& file, HeightSink& sink) {
  const std::uintmax_t bytes = std::filesystem::file_size(file.path);
  const std::uintmax_t samples = bytes / 2;
  const auto side = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(samples))));
  if (side < 2 || std::uintmax_t{2} * side * side != bytes)
    throw Error(fmt::format("has {} bytes: an SRTM tile is a square of 16-bit samples, such as 1201 x 1201", bytes));
  const GridSize size{side, side, SampleKind::kInt16};
  const double step_deg = 1.0 / (side - 1);
  const std::optional<double> south = southOf(file);
  if (!south) sink.warn("its name does not say where it lies, as N37W123.hgt does: it is taken to lie at the equator");
  const DegreeLength spacing = spacingOfDegrees(step_deg, step_deg, south.value_or(-0.5) + 0.5, sink);
  constexpr double kVoid = -32768;
  sink.header({size, kVoid, uprightFrame(size, spacing.east_m, spacing.north_m, 1)});
  ByteFile in(file.path);
  copySamples<std::int16_t>(in, size.samples(), std::endian::native == std::endian::little, sink);
}

void readEsriGrid(const ModelFile& file, HeightSink& sink) {
  TextWords words(ByteFile(file.path), "an Esri grid");
  EsriHeader header;
  double first = readEsriHeader(words, header);
  const GridSize size{sideOf(header.columns, "ncols"), sideOf(header.rows, "nrows"), SampleKind::kFloat32};
  const auto sound = [](double step) { return std::isfinite(step) && step > 0; };
  if (!header.east || !header.south) throw Error("its header lacks cellsize");
  if (!sound(*header.east) || !sound(*header.south)) throw Error("says no cellsize that could be");
  // A sample has a digit, and a blank before it. Of few samples the first that is none is reported instead.
  constexpr std::size_t kFew = std::size_t{1} << 20;
  if (size.samples() > kFew && std::filesystem::file_size(file.path) / 2 < size.samples()) throw Error(kEndsEarly);
  sink.header({size, header.missing, uprightFrame(size, *header.east, *header.south, 1)});
  std::vector<float> row(size.columns);
  for (std::uint32_t j = 0; j < size.rows; ++j) {
    for (std::uint32_t i = 0; i < size.columns; ++i)
      row[i] = static_cast<float>(i + j == 0 ? first : words.number("a height"));
    sink.samples(row.data(), row.size() * sizeof(float));
  }
  words.checkEnd({size.columns, size.rows});
}

// An array in Fortran's order is a grid whose rows and columns have changed places.
void readNumpy(const ModelFile& file, HeightSink& sink) {
  ByteFile in(file.path);
  std::array<unsigned char, 12> start{};
  in.read(start.data(), 8);
  if (std::memcmp(start.data(), "\x93NUMPY", 6) != 0) throw Error("is not a NumPy file");
  const std::size_t length_bytes = start[6] == 1 ? 2 : 4;
  in.read(&start[8], length_bytes);
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i) length |= std::size_t{start[8 + i]} << (8 * i);
  constexpr std::size_t kLongest = 1 << 16;
  if (length > kLongest) throw Error("is not a sound NumPy file: its header is too long");
  std::string text(length, ' ');
  in.read(text.data(), length);
  const NumpyHeader header = numpyHeaderOf(text);
  const std::string type = header.type.size() < 2 ? "" : header.type.substr(1);
  GridSize size{header.columns, header.rows, SampleKind::kFloat32};
  if (type == "i2") size.kind = SampleKind::kInt16;
  if (type == "u2") size.kind = SampleKind::kUint16;
  GridFrame frame = uprightFrame(size, 1, 1, 1);
  if (header.fortran) {
    std::swap(size.columns, size.rows);
    frame.axes.col(0).swap(frame.axes.col(1));
  }
  const bool swap = header.type.starts_with('>') == (std::endian::native == std::endian::little);
  constexpr std::array<std::string_view, 4> kTypes{"i2", "u2", "f4", "f8"};
  if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end())
    throw Error("has numbers of type '" + shown(header.type) + "': heights are int16, uint16, float32 or float64");
  sink.header({size, {}, frame});
  if (type == "i2") copySamples<std::int16_t>(in, size.samples(), swap, sink);
  if (type == "u2") copySamples<std::uint16_t>(in, size.samples(), swap, sink);
  if (type == "f4") copySamples<float>(in, size.samples(), swap, sink);
  if (type == "f8" && copySamples<double, float>(in, size.samples(), swap, sink) > 0)
    sink.warn("its numbers are kept in single precision");
}

}  // namespace hl

// GeoTIFF (OGC 19-008r4): the tags of TIFF that say where samples lie, and GDAL's tag for missing samples.
#include <fmt/core.h>
#include <tiffio.h>

#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "io/read_heights.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr ttag_t kPixelScaleTag = 33550, kTransformTag = 34264, kTiePointTag = 33922, kKeysTag = 34735,
                 kMissingTag = 42113;

thread_local std::string tiff_failure;

void keepFailure(const char*, const char* format, va_list values) {
  char text[300];
  std::vsnprintf(text, sizeof text, format, values);
  tiff_failure = text;
}

class TiffFile {
 public:
  explicit TiffFile(const std::string& path) {
    TIFFSetWarningHandler(nullptr);
    TIFFSetErrorHandler(keepFailure);
    tiff_failure.clear();
    file_.reset(TIFFOpen(path.c_str(), "rm"));  // m: not mapped, as it may be larger than memory
    if (!file_) fail();
  }

  [[noreturn]] static void fail() {
    // Of a row that lacks libtiff gives a number that is none.
    if (tiff_failure.starts_with("Read error")) throw Error("is cut or corrupt: it ends before its last samples");
    throw Error("is not a sound TIFF file" + (tiff_failure.empty() ? "" : ": " + shown(tiff_failure)));
  }
  TIFF* get() const { return file_.get(); }
  template <typename Value>
  Value number(ttag_t tag) const {
    Value value{};
    if (TIFFGetFieldDefaulted(get(), tag, &value) != 1) fail();
    return value;
  }
  /// Numbers of a tag that libtiff does not know; empty: it is not there.
  template <typename Value>
  std::span<const Value> list(ttag_t tag) const {
    std::uint32_t count = 0;
    const void* values = nullptr;
    const TIFFField* const field = TIFFFindField(get(), tag, TIFF_ANY);
    if (field == nullptr || TIFFFieldReadCount(field) != TIFF_VARIABLE2) return {};
    if (TIFFGetField(get(), tag, &count, &values) != 1 || values == nullptr) return {};
    constexpr bool kDoubles = std::is_same_v<Value, double>;
    const TIFFDataType wanted = kDoubles ? TIFF_DOUBLE : std::is_same_v<Value, char> ? TIFF_ASCII : TIFF_SHORT;
    if (TIFFFieldDataType(field) != wanted) return {};
    return {static_cast<const Value*>(values), count};
  }

 private:
  struct Close {
    void operator()(TIFF* file) const { TIFFClose(file); }
  };
  std::unique_ptr<TIFF, Close> file_;
};

/// Samples as they lie in the file, and as they are kept.
struct TiffSamples {
  SampleKind kind = SampleKind::kFloat32;
  std::size_t bytes = 4;  ///< of one in the file
  /// Gives so many; returns how many are not the same number. Null: they are kept as they are.
  std::size_t (*give)(const std::byte* given, std::size_t count, HeightSink& sink) = nullptr;
};

template <typename Given, typename Kept>
std::size_t giveAs(const std::byte* given, std::size_t count, HeightSink& sink) {
  std::vector<Kept> kept(count);
  std::size_t rounded = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Given value{};
    std::memcpy(&value, given + i * sizeof value, sizeof value);
    kept[i] = static_cast<Kept>(static_cast<double>(value));
    rounded += value == value && static_cast<double>(kept[i]) != static_cast<double>(value) ? 1 : 0;
  }
  sink.samples(kept.data(), count * sizeof(Kept));
  return rounded;
}

TiffSamples samplesOf(const TiffFile& file) {
  const auto bits = file.number<std::uint16_t>(TIFFTAG_BITSPERSAMPLE);
  const auto format = file.number<std::uint16_t>(TIFFTAG_SAMPLEFORMAT);
  const auto channels = file.number<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL);
  if (channels != 1) throw Error(fmt::format("has {} values a sample: a file of heights has one", channels));
  const auto is = [&](unsigned wanted, unsigned form) { return bits == wanted && format == form; };
  if (is(8, SAMPLEFORMAT_UINT)) return {SampleKind::kUint16, 1, giveAs<std::uint8_t, std::uint16_t>};
  if (is(8, SAMPLEFORMAT_INT)) return {SampleKind::kInt16, 1, giveAs<std::int8_t, std::int16_t>};
  if (is(16, SAMPLEFORMAT_UINT)) return {SampleKind::kUint16, 2};
  if (is(16, SAMPLEFORMAT_INT)) return {SampleKind::kInt16, 2};
  if (is(32, SAMPLEFORMAT_UINT)) return {SampleKind::kFloat32, 4, giveAs<std::uint32_t, float>};
  if (is(32, SAMPLEFORMAT_INT)) return {SampleKind::kFloat32, 4, giveAs<std::int32_t, float>};
  if (is(32, SAMPLEFORMAT_IEEEFP)) return {SampleKind::kFloat32, 4};
  if (is(64, SAMPLEFORMAT_IEEEFP)) return {SampleKind::kFloat32, 8, giveAs<double, float>};
  throw Error(
      fmt::format("has samples of {} bits in TIFF's format {}: heights are integers of 8, 16 or 32 bits, float32 or "
                  "float64; convert it, as gdal_translate -ot Float32 does",
                  bits, format));
}

std::optional<double> missingOf(const TiffFile& file, HeightSink& sink) {
  const std::span<const char> text = file.list<char>(kMissingTag);
  std::string_view word(text.data(), strnlen(text.data() == nullptr ? "" : text.data(), text.size()));
  word = trimmed(word);
  double value = 0;
  if (word.empty()) return {};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && end == word.data() + word.size()) return value;
  sink.warn(fmt::format("its value for missing samples, '{}', is no number: none counts as missing", shown(word)));
  return {};
}

// Key 1024 of the key directory, four numbers a key: 2 means degrees.
bool inDegrees(const TiffFile& file) {
  constexpr std::uint16_t kModelKey = 1024, kGeographic = 2;
  const std::span<const std::uint16_t> keys = file.list<std::uint16_t>(kKeysTag);
  for (std::size_t i = 4; i + 3 < keys.size(); i += 4) {
    if (keys[i] == kModelKey && keys[i + 1] == 0) return keys[i + 3] == kGeographic;
  }
  return false;
}

// Units of the file for a step to the next column and row, and the latitude of the first row if it is in degrees.
struct Steps {
  double east = 1, south = 1, first_row = 0;
  bool given = false;
};

Steps stepsOf(const TiffFile& file, HeightSink& sink) {
  const std::span<const double> scale = file.list<double>(kPixelScaleTag), tie = file.list<double>(kTiePointTag),
                                map = file.list<double>(kTransformTag);
  Steps steps;
  if (scale.size() >= 2) {
    steps = {scale[0], scale[1], 0, true};
    if (tie.size() >= 6) steps.first_row = tie[4] + tie[1] * scale[1];
  } else if (map.size() >= 16) {
    if (map[1] != 0 || map[4] != 0) throw Error("lies turned in its map: a height field must not be");
    steps = {map[0], -map[5], map[7], true};
  }
  if (steps.east < 0 || steps.south < 0)
    sink.warn(fmt::format("its columns lead {} and its rows {} in its map: they are taken to lead east and south",
                          steps.east < 0 ? "west" : "east", steps.south < 0 ? "north" : "south"));
  steps.east = std::abs(steps.east);
  steps.south = std::abs(steps.south);
  const auto sound = [](double step) { return std::isfinite(step) && step > 0; };
  if (!sound(steps.east) || !sound(steps.south)) throw Error("says no distance between its samples that could be");
  return steps;
}

GridFrame frameOf(const TiffFile& file, const GridSize& size, HeightSink& sink) {
  Steps steps = stepsOf(file, sink);
  if (!steps.given) sink.warn("says nothing of the distance between its samples: 1 m");
  if (inDegrees(file)) {
    const double middle = steps.first_row - 0.5 * steps.south * (size.rows - 1.0);
    const DegreeLength spacing = spacingOfDegrees(steps.east, steps.south, middle, sink);
    steps.east = spacing.east_m;
    steps.south = spacing.north_m;
  }
  return uprightFrame(size, steps.east, steps.south, 1);
}

/// Samples of the file on their way to the sink.
class Giver {
 public:
  Giver(const TiffSamples& form, HeightSink& sink) : form_(form), sink_(sink) {}

  void give(const std::byte* given, std::size_t count) {
    if (form_.give == nullptr)
      sink_.samples(given, count * form_.bytes);
    else
      rounded_ += form_.give(given, count, sink_);
  }
  void reportRounding() const {
    if (rounded_ > 0) sink_.warn("its numbers are kept in single precision");
  }

 private:
  const TiffSamples& form_;
  HeightSink& sink_;
  std::size_t rounded_ = 0;
};

void readStrips(const TiffFile& file, const GridSize& size, std::size_t sample, Giver& giver) {
  std::vector<std::byte> row(
      std::max<std::size_t>(static_cast<std::size_t>(TIFFScanlineSize64(file.get())), size.columns * sample));
  for (std::uint32_t j = 0; j < size.rows; ++j) {
    if (TIFFReadScanline(file.get(), row.data(), j, 0) != 1) TiffFile::fail();
    giver.give(row.data(), size.columns);
  }
}

void readTiles(const TiffFile& file, const GridSize& size, std::size_t sample, Giver& giver) {
  const auto width = file.number<std::uint32_t>(TIFFTAG_TILEWIDTH),
             height = file.number<std::uint32_t>(TIFFTAG_TILELENGTH);
  const std::size_t tile_row = width * sample, whole_row = size.columns * sample;
  std::vector<std::byte> tile(static_cast<std::size_t>(TIFFTileSize64(file.get())));
  if (width == 0 || height == 0 || tile.size() < tile_row * height) TiffFile::fail();
  std::vector<std::byte> rows(whole_row * std::min(height, size.rows));
  for (std::uint32_t j = 0; j < size.rows; j += height) {
    const std::uint32_t used = std::min(height, size.rows - j);
    for (std::uint32_t i = 0; i < size.columns; i += width) {
      if (TIFFReadTile(file.get(), tile.data(), i, j, 0, 0) < 0) TiffFile::fail();
      const std::size_t bytes = std::min<std::size_t>(width, size.columns - i) * sample;
      for (std::uint32_t n = 0; n < used; ++n)
        std::memcpy(&rows[n * whole_row + i * sample], &tile[n * tile_row], bytes);
      if (size.columns - i <= width) break;
    }
    giver.give(rows.data(), std::size_t{used} * size.columns);
    if (size.rows - j <= height) break;
  }
}

}  // namespace

void readGeoTiff(const ModelFile& path, HeightSink& sink) {
  const TiffFile file(path.path);
  const TiffSamples samples = samplesOf(file);
  const GridSize size{file.number<std::uint32_t>(TIFFTAG_IMAGEWIDTH), file.number<std::uint32_t>(TIFFTAG_IMAGELENGTH),
                      samples.kind};
  checkGridSize(size);
  sink.header({size, missingOf(file, sink), frameOf(file, size, sink)});
  Giver giver(samples, sink);
  TIFFIsTiled(file.get()) != 0 ? readTiles(file, size, samples.bytes, giver)
                               : readStrips(file, size, samples.bytes, giver);
  giver.reportRounding();
}

}  // namespace hl

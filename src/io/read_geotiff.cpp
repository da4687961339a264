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

SampleKind kindOf(const TiffFile& file) {
  const auto bits = file.number<std::uint16_t>(TIFFTAG_BITSPERSAMPLE);
  const auto format = file.number<std::uint16_t>(TIFFTAG_SAMPLEFORMAT);
  const auto channels = file.number<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL);
  if (channels != 1) throw Error(fmt::format("has {} values a sample: a file of heights has one", channels));
  if (bits == 16 && format == SAMPLEFORMAT_INT) return SampleKind::kInt16;
  if (bits == 16 && format == SAMPLEFORMAT_UINT) return SampleKind::kUint16;
  if (bits == 32 && format == SAMPLEFORMAT_IEEEFP) return SampleKind::kFloat32;
  throw Error(fmt::format("has samples of {} bits in format {}: heights are int16, uint16 or float32", bits, format));
}

std::optional<double> missingOf(const TiffFile& file) {
  const std::span<const char> text = file.list<char>(kMissingTag);
  std::string_view word(text.data(), strnlen(text.data() == nullptr ? "" : text.data(), text.size()));
  while (word.starts_with(' ')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc()) return {};
  return value;
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
  bool told = false;
};

Steps stepsOf(const TiffFile& file) {
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
  steps.east = std::abs(steps.east);
  steps.south = std::abs(steps.south);
  const auto sound = [](double step) { return std::isfinite(step) && step > 0; };
  if (!sound(steps.east) || !sound(steps.south)) throw Error("says no distance between its samples that could be");
  return steps;
}

GridFrame frameOf(const TiffFile& file, const GridSize& size, HeightSink& sink) {
  Steps steps = stepsOf(file);
  if (!steps.told) sink.warn("says nothing of the distance between its samples: 1 m");
  if (inDegrees(file)) {
    const double middle = steps.first_row - 0.5 * steps.south * (size.rows - 1.0);
    const DegreeLength spacing = spacingOfDegrees(steps.east, steps.south, middle, sink);
    steps.east = spacing.east_m;
    steps.south = spacing.north_m;
  }
  return uprightFrame(size, steps.east, steps.south, 1);
}

void readStrips(const TiffFile& file, const GridSize& size, HeightSink& sink) {
  std::vector<std::byte> row(std::max<std::size_t>(static_cast<std::size_t>(TIFFScanlineSize64(file.get())),
                                                   size.columns * sizeOf(size.kind)));
  for (std::uint32_t j = 0; j < size.rows; ++j) {
    if (TIFFReadScanline(file.get(), row.data(), j, 0) != 1) TiffFile::fail();
    sink.samples(row.data(), size.columns * sizeOf(size.kind));
  }
}

void readTiles(const TiffFile& file, const GridSize& size, HeightSink& sink) {
  const auto width = file.number<std::uint32_t>(TIFFTAG_TILEWIDTH),
             height = file.number<std::uint32_t>(TIFFTAG_TILELENGTH);
  const std::size_t sample = sizeOf(size.kind), tile_row = width * sample, whole_row = size.columns * sample;
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
    sink.samples(rows.data(), used * whole_row);
    if (size.rows - j <= height) break;
  }
}

}  // namespace

void readGeoTiff(const ModelFile& path, HeightSink& sink) {
  const TiffFile file(path.path);
  const GridSize size{file.number<std::uint32_t>(TIFFTAG_IMAGEWIDTH), file.number<std::uint32_t>(TIFFTAG_IMAGELENGTH),
                      kindOf(file)};
  checkGridSize(size);
  sink.header({size, missingOf(file), frameOf(file, size, sink)});
  TIFFIsTiled(file.get()) != 0 ? readTiles(file, size, sink) : readStrips(file, size, sink);
}

}  // namespace hl

// The samples of a GeoTIFF, which say nothing of where they lie: geotiff_header.h does.
#include <fmt/core.h>

#include <cstring>
#include <vector>

#include "base/error.h"
#include "io/geotiff_header.h"
#include "io/read_heights.h"
#include "io/tiff_file.h"

namespace hl {

namespace {

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
  sink.header(geotiffHeader(file, size, sink));
  Giver giver(samples, sink);
  TIFFIsTiled(file.get()) != 0 ? readTiles(file, size, samples.bytes, giver)
                               : readStrips(file, size, samples.bytes, giver);
  giver.reportRounding();
}

}  // namespace hl

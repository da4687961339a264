// 16-bit grey PNG pictures as heights.
#include <spng.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/read_heights.h"

namespace hl {

namespace {

void checkSpng(int code) {
  if (code != 0) throw Error("is not a sound PNG file: " + std::string(spng_strerror(code)));
}

// A picture says nothing of heights: white is an eighth of its longer side above black.
constexpr double kReliefOfSide = 0.125;

}  // namespace

void readHeightPng(const ModelFile& path, HeightSink& sink) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.path.c_str(), "rb"), &std::fclose);
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> png(spng_ctx_new(0), &spng_ctx_free);
  if (!file || !png) throw Error("may not be read");
  checkSpng(spng_set_png_file(png.get(), file.get()));
  spng_ihdr header{};
  checkSpng(spng_get_ihdr(png.get(), &header));
  if (header.bit_depth != 16 || header.color_type != SPNG_COLOR_TYPE_GRAYSCALE)
    throw Error("is not a grey picture of 16 bits: heights need one channel of 16 bits");
  const GridSize size{header.width, header.height, SampleKind::kUint16};
  checkGridSize(size);
  const double white = kReliefOfSide * (std::max(size.columns, size.rows) - 1.0) / 65535;
  sink.warn(
      "a picture says nothing of distances: 1 m between samples, and white an eighth of the longer side above black");
  sink.header({size, {}, uprightFrame(size, 1, 1, white)});
  if (header.interlace_method != SPNG_INTERLACE_NONE) {
    std::vector<std::uint16_t> all(size.samples());
    checkSpng(spng_decode_image(png.get(), all.data(), size.bytes(), SPNG_FMT_PNG, 0));
    return sink.samples(all.data(), size.bytes());
  }
  checkSpng(spng_decode_image(png.get(), nullptr, 0, SPNG_FMT_PNG, SPNG_DECODE_PROGRESSIVE));
  std::vector<std::uint16_t> row(size.columns);
  for (std::uint32_t j = 0; j < size.rows; ++j) {
    const int code = spng_decode_row(png.get(), row.data(), row.size() * sizeof(std::uint16_t));
    checkSpng(j + 1 == size.rows && code == SPNG_EOI ? 0 : code);
    sink.samples(row.data(), row.size() * sizeof(std::uint16_t));
  }
}

}  // namespace hl

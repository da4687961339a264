#include "io/load_image.h"

#include <fmt/core.h>
#include <spng.h>
#include <turbojpeg.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/plain_file.h"
#include "io/file_ending.h"
#include "io/isolated.h"

namespace hl {

namespace {

constexpr std::size_t kMaxTexels = std::size_t{64} << 20;
constexpr const char* kNoPng = "is not a sound PNG file: ";
constexpr const char* kNoJpeg = "is not a sound JPEG file: ";

void checkSize(std::size_t width, std::size_t height) {
  if (width == 0 || height == 0) throw Error("has no pixels");
  if (width > kMaxTexels / height) throw Error("has more than " + std::to_string(kMaxTexels) + " pixels");
}

// ITU-R BT.601, as in a JPEG file. What is grey stays so to the bit.
float luminance(float red, float green, float blue) {
  if (red == green && green == blue) return red;
  return 0.299f * red + 0.587f * green + 0.114f * blue;
}

// Pictures run from the top row down, textures up. `level(i)`: of the picture's pixel i, 0..1.
template <typename Level>
Texture textureOf(std::size_t width, std::size_t height, const Level& level) {
  Texture texture;
  texture.width = width;
  texture.height = height;
  texture.texels.reserve(width * height);
  for (std::size_t row = height; row-- > 0;)
    for (std::size_t column = 0; column < width; ++column) texture.texels.push_back(level(row * width + column));
  return texture;
}

void checkPng(int code) {
  if (code != 0) throw Error(kNoPng + std::string(spng_strerror(code)));
}

using ImageProgress = std::function<void(double fraction)>;

// Row by row, as a large picture takes seconds. An interlaced one comes in passes, each over the whole picture; its
// first passes have few rows, so that the fraction is a rough one.
void decodeRows(spng_ctx& png, const spng_ihdr& header, spng_format format, void* pixels, std::size_t row_bytes,
                const ImageProgress& progress) {
  constexpr std::uint32_t kRowsPerReport = 256;
  checkPng(spng_decode_image(&png, nullptr, 0, format, SPNG_DECODE_PROGRESSIVE));
  for (int code = 0; code != SPNG_EOI;) {
    spng_row_info row{};
    checkPng(spng_get_row_info(&png, &row));
    code = spng_decode_row(&png, static_cast<char*>(pixels) + row_bytes * row.row_num, row_bytes);
    if (code != SPNG_EOI) checkPng(code);
    if (progress && row.row_num % kRowsPerReport == 0) progress(static_cast<double>(row.row_num) / header.height);
  }
}

// `Channel`: of what is decoded, RGBA.
template <typename Channel>
Texture decodeRgba(spng_ctx& png, const spng_ihdr& header, spng_format format, const ImageProgress& progress) {
  constexpr std::size_t kChannels = 4;
  constexpr auto kFull = static_cast<float>(static_cast<Channel>(-1));
  std::vector<Channel> rgba(kChannels * header.width * header.height);
  decodeRows(png, header, format, rgba.data(), rgba.size() * sizeof(Channel) / header.height, progress);
  checkPng(spng_decode_chunks(&png));  // up to the end of the file
  return textureOf(header.width, header.height, [&](std::size_t i) {
    const Channel* const pixel = &rgba[kChannels * i];
    return luminance(static_cast<float>(pixel[0]), static_cast<float>(pixel[1]), static_cast<float>(pixel[2])) / kFull;
  });
}

using Png = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

// Of a file in memory, which outlives it.
Png openPng(const std::string& bytes, spng_ihdr& header) {
  Png png(spng_ctx_new(0), &spng_ctx_free);
  if (!png) throw std::bad_alloc();
  checkPng(spng_set_png_buffer(png.get(), bytes.data(), bytes.size()));
  checkPng(spng_get_ihdr(png.get(), &header));
  return png;
}

Texture decodePng(const std::string& bytes, const ImageProgress& progress) {
  spng_ihdr header{};
  const Png png = openPng(bytes, header);
  checkSize(header.width, header.height);
  return header.bit_depth == 16 ? decodeRgba<std::uint16_t>(*png, header, SPNG_FMT_RGBA16, progress)
                                : decodeRgba<std::uint8_t>(*png, header, SPNG_FMT_RGBA8, progress);
}

class Jpeg {
 public:
  // A file in memory, which outlives it.
  explicit Jpeg(const std::string& bytes)
      : data_(reinterpret_cast<const unsigned char*>(bytes.data())), size_(static_cast<unsigned long>(bytes.size())) {
    if (!jpeg_) throw std::bad_alloc();
    int subsampling = 0, colours = 0;
    check(tjDecompressHeader3(jpeg_.get(), data_, size_, &width_, &height_, &subsampling, &colours));
  }
  std::size_t width() const { return static_cast<std::size_t>(width_); }
  std::size_t height() const { return static_cast<std::size_t>(height_); }
  // A torn file is no sound one, though the library would fill it up with grey: it says so by its return value.
  void decodeGrey(unsigned char* grey) const {
    check(tjDecompress2(jpeg_.get(), data_, size_, grey, width_, 0, height_, TJPF_GRAY, 0));
  }

 private:
  void check(int code) const {
    if (code != 0) throw Error(kNoJpeg + std::string(tjGetErrorStr2(jpeg_.get())));
  }

  const std::unique_ptr<void, decltype(&tjDestroy)> jpeg_{tjInitDecompress(), &tjDestroy};
  const unsigned char* const data_;
  const unsigned long size_;
  int width_ = 0, height_ = 0;
};

Texture decodeJpeg(const std::string& bytes) {
  const Jpeg jpeg(bytes);
  checkSize(jpeg.width(), jpeg.height());
  std::vector<unsigned char> grey(jpeg.width() * jpeg.height());
  jpeg.decodeGrey(grey.data());
  return textureOf(jpeg.width(), jpeg.height(), [&](std::size_t i) { return static_cast<float>(grey[i]) / 255.0f; });
}

void checkIsImage(const std::string& path) {
  const std::string ending = endingOf(path);
  if (ending != ".png" && ending != ".jpg" && ending != ".jpeg")
    throw Error(path + ": images must end in .png, .jpg or .jpeg");
  checkPlainFile(path);
}

// What a child process puts into a model.
template <typename Read>
Model readBeside(const std::string& path, const ImageProgress& progress, const Read& read) {
  const auto parse = [&](const auto& report) {
    Model carrier;
    read(carrier, report);
    return carrier;
  };
  return runIsolated(path, {}, parse, progress).model;
}

}  // namespace

ImageSize sizeOfImage(const std::string& bytes) {
  if (bytes.starts_with("\x89PNG")) {
    spng_ihdr header{};
    openPng(bytes, header);
    return {header.width, header.height};
  }
  if (!bytes.starts_with("\xff\xd8")) throw Error("is no PNG or JPEG file");
  const Jpeg jpeg(bytes);
  return {jpeg.width(), jpeg.height()};
}

std::shared_ptr<const std::string> checkedPicture(std::string bytes) {
  constexpr std::size_t kMaxPictureSide = 8192;  // what graphics processors take
  const ImageSize size = sizeOfImage(bytes);
  if (size.width > kMaxPictureSide || size.height > kMaxPictureSide)
    throw Error(
        fmt::format("has {} x {} pixels, and {} a side are the most", size.width, size.height, kMaxPictureSide));
  return std::make_shared<const std::string>(std::move(bytes));
}

std::shared_ptr<const std::string> loadPicture(const std::string& path) {
  checkIsImage(path);
  const Model read = readBeside(path, nullptr, [&](Model& carrier, const auto&) {
    carrier.appearance.pictures.push_back({checkedPicture(contentOf(path).value_or(""))});
  });
  if (read.appearance.pictures.size() != 1) throw Error(path + ": its reader gave no picture");
  return read.appearance.pictures.front().file;
}

Texture readImage(const std::string& path, const ImageProgress& progress) {
  checkIsImage(path);
  const std::string bytes = contentOf(path).value_or("");
  Texture texture = endingOf(path) == ".png" ? decodePng(bytes, progress) : decodeJpeg(bytes);
  texture.name = std::filesystem::path(path).filename().string();
  return texture;
}

Texture loadImage(const std::string& path, const ImageProgress& progress) {
  checkIsImage(path);
  Model model = readBeside(path, progress, [&](Model& carrier, const auto& report) {
    carrier.textures.push_back(readImage(path, [&](double fraction) { report(fraction); }));
  });
  if (model.textures.size() != 1) throw Error(path + ": its reader gave no picture");
  if (progress) progress(1);
  return std::move(model.textures.front());
}

}  // namespace hl

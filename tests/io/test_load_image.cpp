// Large pictures: decoded row by row, interlaced ones in passes, with progress.
#include "io/load_image.h"

#include <gtest/gtest.h>
#include <spng.h>

#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "temp_folder.h"

namespace hl::test_load_image {
namespace {

constexpr std::uint32_t kSide = 1200;

std::string greyPng(const std::vector<std::uint8_t>& grey, std::uint8_t interlaced) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> png(spng_ctx_new(SPNG_CTX_ENCODER), &spng_ctx_free);
  spng_ihdr header{kSide, kSide, 8, SPNG_COLOR_TYPE_GRAYSCALE, 0, 0, interlaced};
  EXPECT_EQ(spng_set_ihdr(png.get(), &header), 0);
  spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1);
  EXPECT_EQ(spng_encode_image(png.get(), grey.data(), grey.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
  std::size_t size = 0;
  int failed = 0;
  const std::unique_ptr<void, decltype(&std::free)> bytes(spng_get_png_buffer(png.get(), &size, &failed), &std::free);
  EXPECT_EQ(failed, 0);
  return {static_cast<const char*>(bytes.get()), size};
}

TEST(LoadImage, InterlacedOrNotItIsTheSameAndSaysHowFarItIs) {
  std::vector<std::uint8_t> grey(kSide * kSide);
  std::mt19937 random(5);
  for (std::uint8_t& level : grey) level = static_cast<std::uint8_t>(random());
  for (const std::uint8_t interlaced : {std::uint8_t{0}, std::uint8_t{1}}) {
    std::vector<double> said;
    const Texture texture = loadImage(test::fileWith("rows.png", greyPng(grey, interlaced)),
                                      [&](double fraction) { said.push_back(fraction); });
    ASSERT_EQ(texture.texels.size(), grey.size());
    for (std::size_t row = 0; row < kSide; ++row) {
      for (std::size_t i = 0; i < kSide; ++i)
        ASSERT_EQ(texture.texels[row * kSide + i], static_cast<float>(grey[(kSide - 1 - row) * kSide + i]) / 255.0f);
    }
    ASSERT_GE(said.size(), 5U);
    EXPECT_EQ(said.back(), 1);
  }
}

}  // namespace
}  // namespace hl::test_load_image

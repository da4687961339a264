// The loops over pixels against a plain one for each pixel, bit for bit, with each instruction set.
#include "surfaces/depth_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "geometry/scenes.h"
#include "instruction_sets.h"
#include "surfaces/depth_camera.h"

namespace hl::test_depth_rows {
namespace {

using test::Random;

constexpr float kNone = std::numeric_limits<float>::infinity();

template <typename Sample>
void expectRead(SampleKind kind, const std::vector<Sample>& in, std::optional<double> missing, double scale_m) {
  const Samples samples(kind, {std::shared_ptr<const void>(), in.data()}, missing);
  const std::size_t first = std::min<std::size_t>(3, in.size());
  test::withEachInstructionSet([&] {
    std::vector<float> depths(in.size() - first, -1);
    readDepths(samples, first, depths.size(), scale_m, depths.data());
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const auto depth = static_cast<float>(scale_m * samples[first + i]);
      ASSERT_EQ(depths[i], depth > 0 && std::isfinite(depth) ? depth : 0) << i << " of " << in.size();
    }
  });
}

TEST(DepthRows, SamplesBecomeDepths) {
  Random random(1);
  for (int length = 0; length < 80; ++length) {
    std::vector<std::uint16_t> plain;
    std::vector<std::int16_t> with_sign;
    std::vector<float> real;
    for (int i = 0; i < length; ++i) {
      plain.push_back(static_cast<std::uint16_t>(random.below(4) == 0 ? 7 : random.below(65536)));
      with_sign.push_back(static_cast<std::int16_t>(random.below(65536) - 32768));
      constexpr float kOdd[]{0, -0.0F, -1, NAN, kNone, -kNone, 1e38F, 1e-40F, 7};
      real.push_back(random.below(2) == 0 ? kOdd[random.below(9)] : static_cast<float>(random.uniform(0, 9)));
    }
    for (const double scale_m : {1e-3, 1.0, 1e9, 1e-12}) {
      expectRead(SampleKind::kUint16, plain, 7, scale_m);
      expectRead(SampleKind::kInt16, with_sign, {}, scale_m);
      expectRead(SampleKind::kFloat32, real, 7, scale_m);
    }
  }
}

std::vector<float> randomDepths(Random& random, std::size_t count) {
  std::vector<float> depths;
  for (std::size_t i = 0; i < count; ++i)
    depths.push_back(random.below(5) == 0 ? 0 : static_cast<float>(1 + 0.02 * random.below(3) * random.uniform(0, 1)));
  return depths;
}

TEST(DepthRows, EachPixelFollowsWhatItIs) {
  Random random(2);
  const DepthCamera camera{1, 1, 0, 0, 0.01};
  const FollowRule rule{static_cast<float>(camera.join), 0.1F, 8};
  for (std::size_t length = 0; length < 100; ++length) {
    const std::vector<float> now = randomDepths(random, length), before = randomDepths(random, length);
    std::vector<std::uint8_t> held_before;
    for (std::size_t i = 0; i < length; ++i) held_before.push_back(static_cast<std::uint8_t>(random.below(10)));
    test::withEachInstructionSet([&] {
      std::vector<float> depths(length);
      std::vector<std::uint8_t> held(length);
      followDepths({length, now.data(), before.data(), held_before.data(), depths.data(), held.data()}, rule);
      for (std::size_t i = 0; i < length; ++i) {
        const bool stays = now[i] == 0 && before[i] > 0 && held_before[i] < 8;
        float depth = stays ? before[i] : now[i];
        if (camera.joins(now[i], now[i], before[i])) depth = before[i] + 0.1F * (now[i] - before[i]);
        ASSERT_EQ(depths[i], depth) << i << " of " << length;
        ASSERT_EQ(held[i], stays ? held_before[i] + 1 : 0);
      }
    });
  }
}

// Of the cells of a band, each triangle by itself.
std::size_t boundSlowly(const CellBand& band, const DepthCamera& camera, std::size_t side,
                        std::vector<DepthRange>& tiles) {
  std::size_t triangles = 0;
  const auto add = [&](std::size_t tile, float a, float b, float c) {
    if (!camera.joins(a, b, c)) return;
    tiles[tile].low = std::min({tiles[tile].low, a, b, c});
    tiles[tile].high = std::max({tiles[tile].high, a, b, c});
    ++triangles;
  };
  for (std::size_t j = 0; j < band.rows; ++j) {
    const float *const row = band.first + j * band.pixels, *const below = row + band.pixels;
    for (std::size_t i = 0; i + 1 < band.pixels; ++i) {
      add(i / side, row[i], row[i + 1], below[i + 1]);
      add(i / side, row[i], below[i], below[i + 1]);
    }
  }
  return triangles;
}

TEST(DepthRows, TilesAreBoundedAsTheirTriangles) {
  Random random(3);
  const DepthCamera camera{1, 1, 0, 0, 0.015};
  for (const std::size_t side : {std::size_t{1}, std::size_t{8}, kMaxSide}) {
    for (std::size_t columns = 2; columns < 150; columns += columns < 40 ? 1 : 13) {
      const auto rows = static_cast<std::size_t>(1 + random.below(8));
      const std::vector<float> depths = randomDepths(random, columns * (rows + 1));
      const CellBand band{depths.data(), columns, rows};
      std::vector<DepthRange> slow((columns - 2) / side + 1, {kNone, -kNone});
      const std::size_t triangles = boundSlowly(band, camera, side, slow);
      test::withEachInstructionSet([&] {
        std::vector<DepthRange> tiles(slow.size());
        ASSERT_EQ(boundCells(band, static_cast<float>(camera.join), side, tiles.data()), triangles);
        for (std::size_t i = 0; i < tiles.size(); ++i) {
          ASSERT_EQ(tiles[i].low, slow[i].low) << i << " of " << columns;
          ASSERT_EQ(tiles[i].high, slow[i].high);
        }
      });
    }
  }
}

}  // namespace
}  // namespace hl::test_depth_rows

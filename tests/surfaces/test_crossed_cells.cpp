// The cells that comparisons of samples find, against the values at their corners.
#include "surfaces/crossed_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "volumes.h"

namespace hl::test_crossed_cells {
namespace {

using test::Random;
using Place = CrossedCells::Place;

// Whole numbers, so that many samples have the iso value; some of them as large as they can be, or missing.
template <typename Sample>
VoxelGrid randomGrid(Random& random, SampleKind kind, const Place& side) {
  const auto samples = std::make_shared<std::vector<Sample>>();
  const int spread = 1 + random.below(200);
  // With its scale none may be beyond a float.
  const bool whole = std::numeric_limits<Sample>::is_integer;
  const Sample most = whole ? std::numeric_limits<Sample>::max() : std::numeric_limits<Sample>::max() / 10'000;
  const Sample least = whole ? std::numeric_limits<Sample>::lowest() : -most;
  const std::size_t count = std::size_t{side[0]} * side[1] * side[2];
  for (std::size_t i = 0; i < count; ++i) {
    const bool extreme = random.below(20) == 0;
    samples->push_back(extreme ? (random.below(2) == 0 ? least : most) : static_cast<Sample>(random.below(spread)));
  }
  const std::shared_ptr<const void> data(samples, samples->data());
  const double scale = (random.below(2) == 0 ? 1 : -1) * std::pow(10.0, random.uniform(-3, 3));
  const std::optional<double> missing = random.below(2) == 0 ? std::optional<double>(3) : std::nullopt;
  return VoxelGrid(side, Samples(kind, data, missing), {scale, random.below(2) * random.uniform(-1e3, 1e3)});
}

VoxelGrid randomGrid(Random& random, const Place& side) {
  switch (random.below(3)) {
    case 0:
      return randomGrid<std::int16_t>(random, SampleKind::kInt16, side);
    case 1:
      return randomGrid<std::uint16_t>(random, SampleKind::kUint16, side);
    default:
      return randomGrid<float>(random, SampleKind::kFloat32, side);
  }
}

TEST(CrossedCells, AreThoseWhoseCornersLieOnBothSides) {
  Random random(1);
  std::size_t crossed = 0, others = 0;
  for (int i = 0; i < 20'000 * test::longer(); ++i) {
    Place side{}, first{}, end{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side[axis] = static_cast<std::uint32_t>(2 + random.below(8));
      first[axis] = static_cast<std::uint32_t>(random.below(static_cast<int>(side[axis]) - 1));
      end[axis] = std::min({side[axis] - 1, first[axis] + 1 + static_cast<std::uint32_t>(random.below(4))});
    }
    const auto volume = std::make_shared<const Volume>(randomGrid(random, side));
    const double at = volume->grid.at(side[0] / 2, side[1] / 2, side[2] / 2);
    const double value = std::isfinite(at) ? at + random.below(2) * random.uniform(-1, 1) : 0;
    const IsoCells cells(volume, test::cubicFrame(1),
                         {value, random.below(2) == 0 ? SolidSide::kAbove : SolidSide::kBelow});
    std::set<Place> found;
    CrossedCells(volume->grid, cells.bound(), first, end).forEach([&](const Place& cell) { found.insert(cell); });
    for (std::uint32_t z = first[2]; z < end[2]; ++z) {
      for (std::uint32_t y = first[1]; y < end[1]; ++y) {
        for (std::uint32_t x = first[0]; x < end[0]; ++x) {
          const IsoCell cell = cells.at({x, y, z});
          if (std::any_of(cell.value.begin(), cell.value.end(), [](double one) { return std::isnan(one); })) {
            found.erase({x, y, z});
            continue;
          }
          const bool crosses = cell.triangles != nullptr;
          ASSERT_EQ(found.erase({x, y, z}), crosses ? 1U : 0U) << i;
          ++(crosses ? crossed : others);
        }
      }
    }
    ASSERT_TRUE(found.empty()) << i;
  }
  EXPECT_GT(std::min(crossed, others), 10'000U);
}

}  // namespace
}  // namespace hl::test_crossed_cells

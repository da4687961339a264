// What a cloud keeps in few bits comes back to the bit: numbers, normals of blocks, and whole clouds, each held against
// a list of what was written.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <vector>

#include "clouds.h"
#include "surfaces/block_normals.h"
#include "surfaces/packed_bits.h"

namespace hl::test_packed_cloud {
namespace {

using test::Random;
using Steps = std::array<std::int32_t, 3>;

constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kLargest = std::numeric_limits<std::int32_t>::max();

std::uint64_t anyNumber(Random& random) {
  std::uint64_t number = 0;
  for (int i = 0; i < 4; ++i) number = number << 16 | static_cast<std::uint64_t>(random.below(1 << 16));
  return number;
}

// Bit by bit.
std::uint64_t bitsAt(const std::vector<std::uint8_t>& bytes, std::size_t first, unsigned width) {
  std::uint64_t number = 0;
  for (unsigned i = 0; i < width; ++i) number |= std::uint64_t{bytes[(first + i) / 8] >> (first + i) % 8 & 1U} << i;
  return number;
}

TEST(PackedBits, NumbersOfAllWidthsComeBack) {
  Random random(1);
  for (int list = 0; list < 200; ++list) {
    std::vector<unsigned> widths;
    std::vector<std::uint64_t> numbers;
    std::size_t bits = 0;
    for (int i = 0; i < 100; ++i) {
      widths.push_back(static_cast<unsigned>(random.below(kWidestBits + 1)));
      numbers.push_back(lowBits(anyNumber(random), widths.back()));
      bits += widths.back();
    }
    std::vector<std::uint8_t> bytes((bits + 7) / 8, 0);
    std::size_t at = 0;
    for (std::size_t i = 0; i < numbers.size(); at += widths[i++]) writeBits(bytes.data(), at, widths[i], numbers[i]);
    bytes.resize(bytes.size() + kReadBehind_bytes, 0xff);
    at = 0;
    for (std::size_t i = 0; i < numbers.size(); at += widths[i++]) {
      ASSERT_EQ(readBits(bytes.data(), at, widths[i]), numbers[i]);
      ASSERT_EQ(bitsAt(bytes, at, widths[i]), numbers[i]);
    }
  }
}

// At random, near one line, of one side or both, on the axes and between them, and what is no direction.
std::uint32_t anyNormal(Random& random, int form, const Vec3& line) {
  if (form == 0) return static_cast<std::uint32_t>(anyNumber(random));
  if (form == 1) return packNormal(random.direction());
  if (form == 2) return packNormal(Vec3(random.direction().array().round()));  // also kNoNormal
  const double sign = form == 3 || random.below(2) == 0 ? 1 : -1;
  if (form == 5) return packNormal(sign * line);
  return packNormal(sign * (line + std::pow(10.0, random.uniform(-5, -1)) * random.direction()));
}

TEST(BlockNormals, AllComeBack) {
  Random random(2);
  for (int block = 0; block < 20'000; ++block) {
    std::vector<std::uint32_t> normals;
    const Vec3 line = random.below(3) == 0 ? Vec3::Unit(random.below(3)) : random.direction();
    const int form = random.below(6), count = 1 + random.below(16);
    for (int i = 0; i < count; ++i) normals.push_back(anyNormal(random, form, line));
    const BlockNormals written(normals);
    const std::uint64_t first = static_cast<std::uint64_t>(random.below(100)), bits = written.bits(normals.size());
    ASSERT_LE(bits, BlockNormals(std::vector<std::uint32_t>(normals.size(), kNoNormal)).bits(normals.size()));
    std::vector<std::uint8_t> bytes((first + bits + 7) / 8, 0);
    written.write(normals, bytes.data(), first);
    bytes.resize(bytes.size() + kReadBehind_bytes, 0xff);
    const BlockNormals back(bytes.data(), first);
    ASSERT_EQ(back.bits(normals.size()), bits);
    for (std::size_t i = 0; i < normals.size(); ++i) ASSERT_EQ(back.read(bytes.data(), first, i), normals[i]) << form;
  }
}

TEST(BlockNormals, ThoseOfAPlaneTakeOneBitEach) {
  const Vec3 n = Vec3(1, 2, -3);
  std::vector<std::uint32_t> normals;
  for (int i = 0; i < 16; ++i) normals.push_back(packNormal(i % 3 == 0 ? n : Vec3(-n)));
  EXPECT_EQ(BlockNormals(normals).bits(32) - BlockNormals(normals).bits(16), 16U);
}

// Along one axis.
std::int32_t anyStep(Random& random, int form, std::int32_t middle, int width) {
  const int far = random.below(4);
  if (form == 0) return middle;
  if (form == 1) return far == 0 ? kLeast : far == 1 ? kLargest : static_cast<std::int32_t>(anyNumber(random));
  const std::int64_t step = std::int64_t{middle} + random.below(width) - width / 2;
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(step, kLeast, kLargest));
}

// All at one place along some axes, over all that 32 bits have along others, in 16 bits and a little more and less.
CloudInput anyInput(Random& random) {
  constexpr std::array<int, 8> kWidths{1, 2, 3, 1000, 65535, 65536, 65537, 1'000'000};
  CloudInput input;
  input.lattice = {Vec3(0.001, 0.002, 0.0005), Vec3(4e5, 100, -5e6)};
  input.exact = true;
  Steps middle{}, form{}, width{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    middle[axis] = static_cast<std::int32_t>(anyNumber(random));
    form[axis] = random.below(6);
    width[axis] = kWidths[static_cast<std::size_t>(random.below(kWidths.size()))];
  }
  const int count = 1 + random.below(random.below(2) == 0 ? 40 : 1000), normals = random.below(7);
  const Vec3 line = random.direction();
  for (int i = 0; i < count; ++i) {
    Steps at{};
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = anyStep(random, form[axis], middle[axis], width[axis]);
    input.points.push_back({at, normals == 6 ? kNoNormal : anyNormal(random, normals, line)});
    if (i % 7 == 0) input.points.push_back(input.points.back());
  }
  return input;
}

// Of several normals at one place the largest number counts; what has none gets one.
TEST(CloudPoints, PlacesAndNormalsComeBackFromBlocksOfAllSizes) {
  Random random(3);
  for (int cloud = 0; cloud < 500; ++cloud) {
    const CloudInput input = anyInput(random);
    std::map<Steps, std::uint32_t> given;
    for (const LatticePoint& point : input.points) given[point.at] = std::max(given[point.at], point.normal);
    const auto points = makeCloud(input);
    ASSERT_EQ(points->size(), given.size());
    ASSERT_EQ(points->error_m(), 0);
    for (std::size_t block = 0; block < points->blocks(); ++block) {
      const LatticeBox box = points->box(0, block);
      LatticeBox around{box.high, box.low};
      const CloudPoints::BlockReader reader(*points, block);
      for (std::size_t i = 0; i < points->countIn(block); ++i) {
        const std::size_t slot = CloudPoints::kPerBlock * block + i;
        const Steps at = points->stepsAt(slot);
        ASSERT_EQ(reader.at(i), Vec3(at[0], at[1], at[2]));
        ASSERT_EQ(reader.normal(i), points->normal(slot));
        const auto found = given.find(at);
        ASSERT_NE(found, given.end());
        ASSERT_EQ(points->normal(slot), found->second == kNoNormal ? points->normal(slot) : found->second);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          around.low[axis] = std::min(around.low[axis], at[axis]);
          around.high[axis] = std::max(around.high[axis], at[axis]);
        }
        given.erase(found);
      }
      ASSERT_EQ(around.low, box.low);
      ASSERT_EQ(around.high, box.high);
    }
    ASSERT_TRUE(given.empty());
  }
}

}  // namespace
}  // namespace hl::test_packed_cloud

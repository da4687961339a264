// Tremor: as large as it is asked for, between 8 and 12 Hz alone, another one for each seed and the same for one.
#include "tools/tremor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace hl::test_tremor {
namespace {

constexpr double kRms_m = 3e-4;
const Vec3 kPlace(0.1, -0.2, 0.3);
constexpr int kRows = 200'000;  // 200 s

std::vector<PathSample> restingHand() {
  std::vector<PathSample> path;
  for (int i = 0; i < kRows; ++i) path.push_back({1e-3 * i, kPlace});
  return path;
}

std::vector<PathSample> withTremor(std::uint64_t seed, double rms_m = kRms_m) {
  std::vector<PathSample> path = restingHand();
  addTremor(path, rms_m, seed);
  return path;
}

// Size of the wave of this frequency on one axis, m.
double partAt(const std::vector<PathSample>& path, int axis, double frequency_Hz) {
  std::complex<double> sum = 0;
  for (const PathSample& sample : path)
    sum += (sample.position[axis] - kPlace[axis]) * std::polar(1.0, -2 * std::numbers::pi * frequency_Hz * sample.t);
  return 2 * std::abs(sum) / kRows;
}

TEST(Tremor, IsAsLargeAsAskedForOnEachAxis) {
  const std::vector<PathSample> path = withTremor(7);
  for (int axis = 0; axis < 3; ++axis) {
    double squares = 0;
    for (const PathSample& sample : path) squares += std::pow(sample.position[axis] - kPlace[axis], 2);
    EXPECT_NEAR(std::sqrt(squares / kRows), kRms_m, 0.05 * kRms_m);
  }
}

TEST(Tremor, LiesBetweenEightAndTwelveHertz) {
  const std::vector<PathSample> path = withTremor(7);
  for (const double outside_Hz : {0.5, 3.0, 7.5, 12.5, 25.0, 100.0})
    EXPECT_LT(partAt(path, 0, outside_Hz), 0.01 * kRms_m) << outside_Hz;
  double most = 0;
  for (double f = kTremorLow_Hz; f <= kTremorHigh_Hz; f += 0.02) most = std::max(most, partAt(path, 0, f));
  EXPECT_GT(most, 0.25 * kRms_m);
}

TEST(Tremor, IsDrawnByTheSeedAlone) {
  const auto first = withTremor(1), again = withTremor(1), other = withTremor(2);
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].position, again[i].position);
  EXPECT_GT((first[500].position - other[500].position).norm(), 0.01 * kRms_m);
}

TEST(Tremor, OfNoSizeChangesNoBit) {
  const std::vector<PathSample> path = withTremor(1, 0);
  for (const PathSample& sample : path) EXPECT_EQ(sample.position, kPlace);
}

}  // namespace
}  // namespace hl::test_tremor

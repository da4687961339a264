// Histogram, FixedVector and FunctionRef: the small tools of the loops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "base/fixed_vector.h"
#include "base/function_ref.h"
#include "base/histogram.h"

namespace hl::test_containers {
namespace {

TEST(Histogram, PercentilesAreAtMostOneThirtySecondTooHigh) {
  std::mt19937_64 engine(1);
  std::lognormal_distribution<double> durations(8, 2);
  Histogram histogram;
  std::vector<std::uint64_t> all;
  for (int i = 0; i < 100'000; ++i) {
    all.push_back(static_cast<std::uint64_t>(durations(engine)));
    histogram.add(all.back());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(histogram.count(), all.size());
  EXPECT_EQ(histogram.max_ns(), all.back());
  for (const double fraction : {0.001, 0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(all.size()))) - 1;
    const double exact = static_cast<double>(all[rank]);
    const double given = static_cast<double>(histogram.percentile_ns(fraction));
    EXPECT_GE(given, exact);
    EXPECT_LE(given, exact * (1 + 1.0 / 32));
  }
}

TEST(Histogram, SmallDurationsAreExactAndTheWholeRangeFits) {
  Histogram histogram;
  EXPECT_EQ(histogram.percentile_ns(0.5), 0u);
  for (std::uint64_t i = 0; i < 32; ++i) histogram.add(i);
  EXPECT_EQ(histogram.percentile_ns(0.5), 15u);
  EXPECT_EQ(histogram.percentile_ns(1), 31u);
  histogram.add(~std::uint64_t{0});
  EXPECT_EQ(histogram.percentile_ns(1), ~std::uint64_t{0});
  histogram.clear();
  EXPECT_EQ(histogram.count(), 0u);
}

TEST(FixedVector, RefusesWhatDoesNotFit) {
  FixedVector<int, 3> vector;
  EXPECT_TRUE(vector.empty());
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(vector.push(i));
  EXPECT_FALSE(vector.push(3));
  EXPECT_EQ(vector.size(), 3u);
  EXPECT_EQ(std::vector<int>(vector.begin(), vector.end()), (std::vector<int>{0, 1, 2}));
  vector.resize(1);
  EXPECT_EQ(vector.size(), 1u);
  EXPECT_TRUE(vector.push(9));
  EXPECT_EQ(vector[1], 9);
  vector.clear();
  EXPECT_TRUE(vector.empty());
  EXPECT_EQ(decltype(vector)::capacity(), 3u);
}

int twice(FunctionRef<int(int)> f) { return f(f(3)); }

TEST(FunctionRef, CallsWhatItRefersToWithItsState) {
  int calls = 0;
  EXPECT_EQ(twice([&calls](int x) {
              ++calls;
              return x * x;
            }),
            81);
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace hl::test_containers

// Large vectors begin at a huge page; growing, copying and freeing them loses nothing.
#include "base/huge_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace hl::test_huge_pages {
namespace {

constexpr std::size_t kLarge = 3 * HugePages::kPage / sizeof(std::uint32_t) + 5;

bool beginsAtHugePage(const HugeVector<std::uint32_t>& numbers) {
  return reinterpret_cast<std::uintptr_t>(numbers.data()) % HugePages::kPage == 0;
}

TEST(HugeVector, LargeOnesBeginAtAHugePageWhereverTheyComeFrom) {
  HugeVector<std::uint32_t> first(kLarge);
  std::iota(first.begin(), first.end(), 0U);
  const HugeVector<std::uint32_t> copied = first;
  const HugeVector<std::uint32_t> moved = std::move(first);
  EXPECT_TRUE(beginsAtHugePage(copied));
  EXPECT_TRUE(beginsAtHugePage(moved));
  EXPECT_EQ(copied, moved);
  EXPECT_EQ(copied.back(), kLarge - 1);
}

TEST(HugeVector, KeepsWhatItHoldsWhileItGrowsFromSmallToLargeAndShrinksAgain) {
  HugeVector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < kLarge; ++i) numbers.push_back(i);
  numbers.resize(100);
  numbers.shrink_to_fit();
  for (std::uint32_t i = 0; i < 100; ++i) ASSERT_EQ(numbers[i], i);
}

TEST(HugeVector, IsFreedAndTakenAgainManyTimes) {
  for (int i = 0; i < 200; ++i) {
    HugeVector<std::uint32_t> numbers(kLarge);
    numbers.front() = numbers.back() = 7;
    ASSERT_TRUE(beginsAtHugePage(numbers));
  }
}

TEST(HugePages, WhatIsMovedIntoThemStaysWhereAndWhatItIs) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{10}, kLarge, 10 * kLarge}) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0U);
    const std::vector<std::uint32_t> before = numbers;
    const std::uint32_t* const at = numbers.data();
    HugePages::collapse(numbers.data(), count * sizeof(std::uint32_t));
    EXPECT_EQ(numbers.data(), at);
    EXPECT_EQ(numbers, before);
  }
}

TEST(HugeVector, MemoryThatIsNotThereIsBadAlloc) {
  EXPECT_THROW(HugePages::allocate(std::size_t{1} << 50), std::bad_alloc);
}

}  // namespace
}  // namespace hl::test_huge_pages

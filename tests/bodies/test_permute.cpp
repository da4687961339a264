// Things are brought into an order by as few moves as there can be.
#include "bodies/permute.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace hl::test_permute {
namespace {

int g_copies = 0;

struct Counted {
  explicit Counted(std::uint32_t of) : number(of) {}
  Counted(const Counted& other) : number(other.number) { ++g_copies; }
  Counted& operator=(const Counted& other) {
    number = other.number;
    ++g_copies;
    return *this;
  }
  std::uint32_t number;
};

// A cycle of k things costs k copies and one aside.
TEST(Permute, EachIsMovedOnce) {
  std::mt19937 random(1);
  for (const std::uint32_t count : {0U, 1U, 2U, 3U, 7U, 1000U}) {
    std::vector<std::uint32_t> from(count);
    std::iota(from.begin(), from.end(), 0U);
    std::shuffle(from.begin(), from.end(), random);
    const std::vector<std::uint32_t> order = from;
    std::vector<Counted> items;
    items.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) items.emplace_back(i);
    g_copies = 0;
    permute(items.data(), items.size(), [&](std::size_t i) -> std::uint32_t& { return from[i]; });
    EXPECT_LE(g_copies, static_cast<int>(count + count / 2));
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(items[i].number, order[i]);
  }
}

TEST(Permute, WhatIsInOrderStays) {
  std::vector<Counted> items(3, Counted(5));
  std::vector<int> from{0, 1, 2};
  g_copies = 0;
  permute(items.data(), items.size(), [&](std::size_t i) -> int& { return from[i]; });
  EXPECT_EQ(g_copies, 0);
}

}  // namespace
}  // namespace hl::test_permute

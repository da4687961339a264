// Ticks by why they ended.
#include "server/ending_counts.h"

#include <gtest/gtest.h>

#include <vector>

namespace hl {
namespace {

TEST(EndingCounts, EachTickCountsAsWhatEndedIt) {
  EndingCounts counts;
  for (const Ending ending : {Ending::kReached, Ending::kCapped, Ending::kReached, Ending::kCrowded})
    counts.add(ending);
  EXPECT_EQ(counts[Ending::kReached], 2u);
  EXPECT_EQ(counts[Ending::kCapped], 1u);
  EXPECT_EQ(counts[Ending::kOutOfWork], 0u);
  EXPECT_EQ(counts.capped(), 2u) << "as TickReport::capped()";
}

TEST(EndingCounts, AllAreVisitedInOrderEvenThoseThatDidNotOccur) {
  std::vector<Ending> visited;
  EndingCounts().each([&](Ending ending, std::uint64_t count) {
    visited.push_back(ending);
    EXPECT_EQ(count, 0u);
  });
  ASSERT_EQ(visited.size(), kEndings - 1);
  EXPECT_EQ(visited.front(), Ending::kReached);
  EXPECT_EQ(visited.back(), Ending::kInvalid);
}

}  // namespace
}  // namespace hl

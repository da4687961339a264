// Ticks by why they ended: the counts, and the message that gives them to pages and clients.
#include "touch/ending_counts.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "session/state_messages.h"

namespace hl::test_ending_counts {
namespace {

// Of each ending another count: 1 of the first one, 2 of the next, ...
EndingCounts someOfEach() {
  EndingCounts counts;
  for (std::size_t i = 1; i < kEndings; ++i) {
    for (std::size_t tick = 0; tick < i; ++tick) counts.add(static_cast<Ending>(i));
  }
  return counts;
}

TEST(EndingCounts, EachTickCountsAsWhatEndedIt) {
  EndingCounts counts;
  for (const Ending ending : {Ending::kReached, Ending::kCapped, Ending::kReached, Ending::kCrowded})
    counts.add(ending);
  EXPECT_EQ(counts[Ending::kReached], 2u);
  EXPECT_EQ(counts[Ending::kCapped], 1u);
  EXPECT_EQ(counts[Ending::kOutOfWork], 0u);
  EXPECT_EQ(counts.capped(), 1u) << "as TickReport::capped()";
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

TEST(EndingCounts, TheMessageHasAFieldOfItsNameAndNumberForEachEnding) {
  const EndingCounts counts = someOfEach();
  proto::TicksEnded message;
  toProto(counts, message);
  const auto& fields = *proto::TicksEnded::descriptor();
  EXPECT_EQ(static_cast<std::size_t>(fields.field_count()), kEndings - 1);
  counts.each([&](Ending ending, std::uint64_t count) {
    const auto* field = fields.FindFieldByNumber(static_cast<int>(ending));
    ASSERT_NE(field, nullptr) << nameOf(ending);
    EXPECT_EQ(std::string(field->name()), nameOf(ending));
    EXPECT_EQ(message.GetReflection()->GetUInt64(message, field), count) << nameOf(ending);
  });
}

}  // namespace
}  // namespace hl::test_ending_counts

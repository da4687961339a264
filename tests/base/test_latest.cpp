// Latest: the reader never sees a torn or an older value, and always gets the last one.
#include "base/latest.h"

#include <gtest/gtest.h>

#include <thread>
#include <type_traits>

#include "base/vec.h"

namespace hl::test_latest {
namespace {

// Large enough that a torn copy would show.
struct Message {
  std::array<std::uint64_t, 32> words{};
  static Message filledWith(std::uint64_t value) {
    Message message;
    message.words.fill(value);
    return message;
  }
};

// What nobody has written is never garbage: Eigen's vectors would be.
static_assert(!std::is_default_constructible_v<Latest<Vec3>>);

TEST(Latest, GivesItsInitialValueUntilOneIsWritten) {
  Latest<Vec3> latest(Vec3(1, 2, 3));
  Vec3 value = Vec3::Zero();
  EXPECT_FALSE(latest.read(value));
  EXPECT_EQ(value, Vec3(1, 2, 3));
}

TEST(Latest, GivesTheInitialValueUntilTheFirstWrite) {
  Latest<int> latest(7);
  int value = 0;
  EXPECT_FALSE(latest.read(value));
  EXPECT_EQ(value, 7);
}

TEST(Latest, OnlyTheNewestValueIsReadAndOnlyOnceFresh) {
  Latest<int> latest(0);
  for (int i = 1; i <= 5; ++i) latest.write(i);
  int value = 0;
  EXPECT_TRUE(latest.read(value));
  EXPECT_EQ(value, 5);
  EXPECT_FALSE(latest.read(value));
  EXPECT_EQ(value, 5);
}

TEST(Latest, TwoThreadsNeverSeeATornOrAnOlderValue) {
  constexpr std::uint64_t kWrites = 300'000;
  Latest<Message> latest(Message::filledWith(0));
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kWrites; ++i) latest.write(Message::filledWith(i));
  });
  std::uint64_t last = 0;
  bool torn = false, backward = false;
  while (last < kWrites && !torn && !backward) {
    Message message;
    const bool fresh = latest.read(message);
    for (const std::uint64_t word : message.words) torn = torn || word != message.words[0];
    backward = message.words[0] < last || (fresh && message.words[0] == last);
    last = message.words[0];
    if (!fresh) std::this_thread::yield();
  }
  writer.join();
  EXPECT_FALSE(torn);
  EXPECT_FALSE(backward);
}

}  // namespace
}  // namespace hl::test_latest

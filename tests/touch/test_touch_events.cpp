// When an object counts as touched and as left.
#include "touch/touch_events.h"

#include <gtest/gtest.h>

#include <vector>

namespace hl::test_touch_events {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

FixedVector<ObjectName, kMaxActive> touching(std::initializer_list<std::uint64_t> keys) {
  FixedVector<ObjectName, kMaxActive> touched;
  for (const std::uint64_t key : keys) touched.push({key, 1, 2, 3});
  return touched;
}

struct Reported {
  std::uint64_t key;
  bool touches;
  bool operator==(const Reported&) const = default;
};

std::vector<Reported> reported(TouchEvents& events) {
  std::vector<Reported> all;
  for (TouchEvent event; events.pop(event);) all.push_back({event.object.key, event.touches});
  return all;
}

TEST(TouchEvents, AContactThatFlickersIsOneTouch) {
  TouchEvents events;
  std::int64_t now_ns = 5;
  for (int i = 0; i < 100; ++i, now_ns += kMillisecond_ns) {
    events.follow(now_ns, i % 7 == 0 ? touching({4}) : touching({}), Vec3::Zero());
  }
  EXPECT_EQ(reported(events), (std::vector<Reported>{{4, true}}));
  for (int i = 0; i < 40; ++i, now_ns += kMillisecond_ns) events.follow(now_ns, touching({}), Vec3::Zero());
  EXPECT_EQ(reported(events), (std::vector<Reported>{{4, false}}));
}

// So that what a program counts as a touch lasts as long as its force.
TEST(TouchEvents, TheEndOfATouchHasTheTimeAndPlaceOfTheLastOne) {
  TouchEvents events;
  events.follow(1, touching({4}), {1, 0, 0});
  events.follow(kMillisecond_ns, touching({4}), {2, 0, 0});
  for (int i = 2; i < 40; ++i) events.follow(i * kMillisecond_ns, touching({}), {3, 0, 0});
  TouchEvent event;
  ASSERT_TRUE(events.pop(event) && events.pop(event));
  EXPECT_FALSE(event.touches);
  EXPECT_EQ(event.time_ns, kMillisecond_ns);
  EXPECT_EQ(event.position_W, Vec3(2, 0, 0));
}

TEST(TouchEvents, TwoTapsAreTwoTouches) {
  TouchEvents events;
  for (int tap = 0; tap < 2; ++tap) {
    const std::int64_t start_ns = tap * 100 * kMillisecond_ns;
    for (int i = 0; i < 60; ++i)
      events.follow(start_ns + i * kMillisecond_ns, i < 30 ? touching({9}) : touching({}), Vec3::Zero());
  }
  EXPECT_EQ(reported(events), (std::vector<Reported>{{9, true}, {9, false}, {9, true}, {9, false}}));
}

TEST(TouchEvents, TwoContactsOnOneObjectAreOneTouch) {
  TouchEvents events;
  events.follow(1, touching({4, 4, 5}), Vec3::Zero());
  EXPECT_EQ(reported(events), (std::vector<Reported>{{4, true}, {5, true}}));
}

// Whoever listens can count: each touch of an object is followed by its leaving before the next.
TEST(TouchEvents, WithManyObjectsInAFlashEveryTouchHasItsEnd) {
  TouchEvents events;
  for (std::uint64_t key = 1; key <= 50; ++key)
    events.follow(static_cast<std::int64_t>(key), touching({key}), Vec3::Zero());
  events.follow(10 * kLetGo_ns, touching({}), Vec3::Zero());
  std::vector<int> felt(51, 0);
  for (const Reported& event : reported(events)) {
    felt[event.key] += event.touches ? 1 : -1;
    EXPECT_TRUE(felt[event.key] == 0 || felt[event.key] == 1) << event.key;
  }
  for (const int left : felt) EXPECT_EQ(left, 0);
}

}  // namespace
}  // namespace hl::test_touch_events

// LogRing: the last values are there, older ones are reported as gone, and no reader ever sees half of one.
#include "base/log_ring.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "guard/realtime_guard.h"

namespace hl::test_log_ring {
namespace {

/// All numbers are the same in a value that is whole.
struct Value {
  std::uint64_t numbers[9];
  static Value of(std::uint64_t n) { return {{n, n, n, n, n, n, n, n, n}}; }
  bool whole() const {
    for (const std::uint64_t number : numbers) {
      if (number != numbers[0]) return false;
    }
    return true;
  }
};

TEST(LogRing, HoldsTheLastOnesAndReportsWhatIsGone) {
  LogRing<Value> ring(100);
  EXPECT_EQ(ring.room(), 128u);
  Value value{};
  EXPECT_FALSE(ring.read(0, value));
  for (std::uint64_t i = 0; i < 1000; ++i) ring.push(Value::of(i));
  EXPECT_EQ(ring.pushed(), 1000u);
  for (std::uint64_t i = 0; i < 1000 - ring.room(); ++i) EXPECT_FALSE(ring.read(i, value));
  for (std::uint64_t i = 1000 - ring.room(); i < 1000; ++i) {
    ASSERT_TRUE(ring.read(i, value));
    EXPECT_EQ(value.numbers[0], i);
  }
  EXPECT_FALSE(ring.read(1000, value));
}

TEST(LogRing, PushAndReadDoNotAllocate) {
  LogRing<Value> ring(8);
  Value value{};
  const RealtimeGuard guard;
  ring.push(Value::of(1));
  ring.read(0, value);
}

// A ring of two, so that the writer is always about to overwrite what is read.
TEST(LogRing, WhatIsReadWhileItIsWrittenIsWholeAndItsOwn) {
  LogRing<Value> ring(2);
  std::atomic<bool> done{false};
  std::thread reader([&] {
    Value value{};
    while (!done) {
      const std::uint64_t pushed = ring.pushed();
      if (pushed == 0 || !ring.read(pushed - 1, value)) continue;
      ASSERT_TRUE(value.whole());
      ASSERT_EQ(value.numbers[0], pushed - 1);
    }
  });
  std::uint64_t written = 0;
  for (; written < 300'000; ++written) ring.push(Value::of(written));
  done = true;
  reader.join();
  Value last{};
  EXPECT_TRUE(ring.read(written - 1, last));
}

}  // namespace
}  // namespace hl::test_log_ring

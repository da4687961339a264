// Numbers that one thread writes while others read: what is read was written at once.
#include "base/shared_numbers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace hl::test_shared_numbers {
namespace {

TEST(SharedNumbers, AreZeroAtFirstAndThenWhatWasWritten) {
  SharedNumbers<3> numbers;
  EXPECT_EQ(numbers.read(), (std::array<double, 3>{}));
  numbers.write({1, -2, 3});
  EXPECT_EQ(numbers.read(), (std::array<double, 3>{1, -2, 3}));
}

TEST(SharedNumbers, AreAllOfOneMoment) {
  SharedNumbers<3> numbers;
  std::atomic<bool> ends{false};
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&] {
      double last = 0;
      while (!ends) {
        const auto [a, b, c] = numbers.read();
        EXPECT_EQ(b, 2 * a);
        EXPECT_EQ(c, 3 * a);
        EXPECT_GE(a, last);
        last = a;
      }
    });
  }
  for (int i = 1; i <= 100'000; ++i) numbers.write({1. * i, 2. * i, 3. * i});
  ends = true;
  for (std::thread& reader : readers) reader.join();
}

}  // namespace
}  // namespace hl::test_shared_numbers

// Bytes through a pipe that takes less at once.
#include "base/descriptor_bytes.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <numeric>
#include <thread>
#include <vector>

namespace hl::test_descriptor_bytes {
namespace {

TEST(DescriptorBytes, GoThroughAPipeWhole) {
  int pipe[2];
  ASSERT_EQ(pipe2(pipe, O_CLOEXEC), 0);
  std::vector<char> sent(1 << 20), got(sent.size());
  std::iota(sent.begin(), sent.end(), '\0');
  std::thread sender([&] {
    EXPECT_TRUE(writeWhole(pipe[1], sent.data(), sent.size()));
    close(pipe[1]);
  });
  EXPECT_TRUE(readWhole(pipe[0], got.data(), got.size()));
  EXPECT_FALSE(readWhole(pipe[0], got.data(), 1)) << "it has ended";
  sender.join();
  close(pipe[0]);
  EXPECT_EQ(got, sent);
}

TEST(DescriptorBytes, FailWithoutADescriptor) {
  char byte = 0;
  EXPECT_FALSE(writeWhole(-1, &byte, 1));
  EXPECT_FALSE(readWhole(-1, &byte, 1));
  EXPECT_TRUE(writeWhole(-1, &byte, 0));
}

}  // namespace
}  // namespace hl::test_descriptor_bytes

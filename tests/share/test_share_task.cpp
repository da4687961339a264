// Names of shared worlds, the words that hl-share is started with, and its packets.
#include "share/share_task.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace hl::test_share_task {
namespace {

TEST(ShareTask, ItsWordsAreReadAgain) {
  const ShareTask task{"1.2.3", 42, "lab", 0xffff'ffff'ffff'ffff, {"lo", "my keys", {}}};
  const ShareTask again = shareTaskOf(wordsOf(task));
  EXPECT_EQ(again.version, task.version);
  EXPECT_EQ(again.domain, task.domain);
  EXPECT_EQ(again.world, task.world);
  EXPECT_EQ(again.server, task.server);
  EXPECT_EQ(again.reach.interface_name, "lo");
  EXPECT_EQ(again.reach.enclave, "my keys");
}

TEST(ShareTask, OtherWordsAreRefused) {
  const std::vector<std::string> good{"--serve", "1", "0", "lab", "7"};
  EXPECT_NO_THROW(shareTaskOf(good));
  EXPECT_THROW(shareTaskOf({}), Error);
  EXPECT_THROW(shareTaskOf({good.begin(), good.end() - 1}), Error);
  EXPECT_THROW(shareTaskOf({"--help"}), Error);
  for (const auto& [place, word] : std::vector<std::pair<std::size_t, std::string>>{{0, "--read"},
                                                                                    {2, "233"},
                                                                                    {2, ""},
                                                                                    {3, ""},
                                                                                    {3, "a/b"},
                                                                                    {3, "a b"},
                                                                                    {4, "0"},
                                                                                    {4, "-1"},
                                                                                    {4, "7x"},
                                                                                    {4, "18446744073709551616"}}) {
    std::vector<std::string> words = good;
    words[place] = word;
    EXPECT_THROW(shareTaskOf(words), Error) << word;
  }
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--interface"}, {"--interface", "eth0"}, {"--peer", "10.0.0.1"}, {"--other", "word"}, {"word"}}) {
    std::vector<std::string> words = good;
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_THROW(shareTaskOf(words), Error) << more[0];
  }
}

TEST(ShareTask, WithoutKeysTheRefusalNamesTheOption) {
  try {
    checkReach({"eth0", "", {}}, kShareUse);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--share-security FOLDER"), std::string::npos);
  }
}

TEST(ShareTask, NamesAreLettersDigitsAndLines) {
  for (const char* name : {"lab", "Lab_2", "2", "_"}) EXPECT_NO_THROW(checkShareName(name, "--share")) << name;
  EXPECT_NO_THROW(checkShareName(std::string(32, 'a'), "--share"));
  for (const char* name : {"", "a b", "a-b", "a/b", "lab\n", "l\xc3\xa4"})
    EXPECT_THROW(checkShareName(name, "--share"), Error) << name;
  EXPECT_THROW(checkShareName(std::string(33, 'a'), "--share"), Error);
}

TEST(ShareTask, EveryMachineHasANameThatIsAllowed) {
  EXPECT_EQ(shareNameLike("bench-3.lab.example"), "bench_3");
  EXPECT_EQ(shareNameLike(""), "server");
  EXPECT_EQ(shareNameLike(".local"), "server");
  EXPECT_EQ(shareNameLike(std::string(64, 'a')), std::string(32, 'a'));
}

TEST(ShareTask, PacketsAreReadAgain) {
  const SharePacket packet{Lane::kInbox, 0xffff'0000'0000'0001, std::string("a\0b", 3)};
  const auto again = sharePacketOf(bytesOf(packet));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->lane, packet.lane);
  EXPECT_EQ(again->key, packet.key);
  EXPECT_EQ(again->bytes, packet.bytes);
}

TEST(ShareTask, OtherBytesAreNoPacket) {
  const std::string good = bytesOf({Lane::kStream, 1, {}});
  EXPECT_TRUE(sharePacketOf(good));
  EXPECT_FALSE(sharePacketOf(std::span(good).first(good.size() - 1)));
  std::string lane = good;
  lane[0] = 3;
  EXPECT_FALSE(sharePacketOf(lane));
  EXPECT_TRUE(sharePacketOf(bytesOf({Lane::kItems, 1, std::string(kMaxPacket_bytes, 'x')})));
  EXPECT_FALSE(sharePacketOf(bytesOf({Lane::kItems, 1, std::string(kMaxPacket_bytes + 1, 'x')})));
}

}  // namespace
}  // namespace hl::test_share_task

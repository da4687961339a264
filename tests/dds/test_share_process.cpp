// hl-share between servers of a world: what each lane promises, on one machine and over a bad line with keys. And three
// whole servers on that line.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "base/clock.h"
#include "base/error.h"
#include "line/line.h"
#include "ros/keystore.h"
#include "share/share_process.h"
#include "temp_folder.h"
#include "wait_for.h"

namespace hl::test_share_process {
namespace {

using test::waitFor;

constexpr std::uint32_t kDomain = 41;

// Of this test alone, whatever else runs on the machine.
std::string worldOf(const std::string& name) { return name + "_" + std::to_string(getpid()); }

std::unique_ptr<ShareProcess> join(const std::string& world, ServerId id, const DdsReach& reach = {}) {
  return std::make_unique<ShareProcess>(ShareTask{HL_VERSION, kDomain, worldOf(world), id, reach});
}

/// What has come, in its order.
struct Heard {
  void take(ShareProcess& process) {
    while (const auto packet = process.receive()) {
      if (packet->lane == Lane::kItems) items[packet->key] = packet->bytes;
      if (packet->lane == Lane::kStream) stream[packet->key] = packet->bytes;
      if (packet->lane == Lane::kInbox) inbox.push_back(packet->bytes);
    }
  }
  std::map<std::uint64_t, std::string> items, stream;
  std::vector<std::string> inbox;
};

void sendSurely(ShareProcess& process, const SharePacket& packet) {
  waitFor([&] { return process.send(packet); });
}

// The stream is heard only by those that are there; so it is sent until it is.
void expectStream(ShareProcess& from, ShareProcess& to, std::uint64_t key) {
  Heard heard;
  waitFor([&] {
    from.send({Lane::kStream, key, "here"});
    to.wait(1'000'000);
    heard.take(to);
    return heard.stream.contains(key);
  });
  EXPECT_EQ(heard.stream[key], "here");
}

TEST(ShareProcessTest, TheLastItemOfEachKeyAndServerIsThereForThoseWhoComeLater) {
  const auto a = join("items", 1), b = join("items", 2);
  for (int i = 0; i < 100; ++i) sendSurely(*a, {Lane::kItems, 5, "older " + std::to_string(i)});
  sendSurely(*a, {Lane::kItems, 5, "of a"});
  sendSurely(*b, {Lane::kItems, 6, "of b"});
  sendSurely(*a, {Lane::kItems, 7, std::string(kMaxPacket_bytes, 'x')});
  const auto late = join("items", 3);
  Heard heard;
  waitFor([&] {
    late->wait(1'000'000);
    heard.take(*late);
    return heard.items.size() == 3 && heard.items[5] == "of a";
  });
  EXPECT_EQ(heard.items[6], "of b");
  EXPECT_EQ(heard.items[7].size(), kMaxPacket_bytes);
}

TEST(ShareProcessTest, AnInboxIsHeardByItsServerAloneInOrderAndWhole) {
  constexpr int kPackets = 600;
  const auto a = join("inbox", 1), b = join("inbox", 2), c = join("inbox", 3);
  expectStream(*a, *c, 9);
  Heard of_b, of_c;
  for (int i = 0; i < kPackets; ++i) {
    const std::string bytes = std::to_string(i) + std::string(16'000, '.');
    waitFor([&] {
      of_b.take(*b);
      of_c.take(*c);
      return a->send({Lane::kInbox, 2, bytes});
    });
  }
  waitFor([&] {
    of_b.take(*b);
    return of_b.inbox.size() == kPackets;
  });
  for (int i = 0; i < kPackets; ++i) EXPECT_EQ(std::stoi(of_b.inbox[static_cast<std::size_t>(i)]), i);
  of_c.take(*c);
  EXPECT_TRUE(of_c.inbox.empty());
}

TEST(ShareProcessTest, OfAnotherWorldNothingIsHeard) {
  const auto a = join("one", 1), b = join("one", 2), other = join("other", 3);
  sendSurely(*a, {Lane::kItems, 5, "of one"});
  expectStream(*a, *b, 8);
  expectStream(*b, *a, 7);
  Heard heard;
  heard.take(*other);
  EXPECT_TRUE(heard.items.empty() && heard.stream.empty() && heard.inbox.empty());
}

TEST(ShareProcessTest, AServerDoesNotHearItself) {
  const auto a = join("self", 1), b = join("self", 2);
  sendSurely(*a, {Lane::kItems, 5, "of a"});
  expectStream(*a, *b, 8);
  Heard heard;
  heard.take(*a);
  EXPECT_TRUE(heard.items.empty() && heard.stream.empty());
}

TEST(ShareProcessTest, AKilledProcessIsReported) {
  const auto a = join("killed", 1);
  const std::string own = "/proc/" + std::to_string(getpid()) + "/task/" + std::to_string(getpid()) + "/children";
  FILE* const children = fopen(own.c_str(), "r");
  ASSERT_NE(children, nullptr);
  int id = 0;
  ASSERT_EQ(fscanf(children, "%d", &id), 1);
  fclose(children);
  kill(id, SIGKILL);
  waitFor([&] {
    a->receive();
    return a->ended();
  });
  EXPECT_FALSE(a->send({Lane::kStream, 1, "nobody hears it"}));
}

class ShareOverALine : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = line::lineRefusal()) GTEST_SKIP() << *why;
    line_.emplace(3, "delay 50 jitter 5 loss 5");
    makeEnclaves(test::tempFile("share_keys"), {"anna", "bert"}, kDomain);
    makeEnclaves(test::tempFile("foreign_share_keys"), {"carl"}, kDomain);
  }
  void TearDown() override {
    std::filesystem::remove_all(test::tempFile("share_keys"));
    std::filesystem::remove_all(test::tempFile("foreign_share_keys"));
  }
  std::unique_ptr<ShareProcess> joinAt(int end, ServerId id, const std::string& enclave) {
    std::unique_ptr<ShareProcess> made;
    line_->inside(end, [&] { made = join("line", id, {"line0", test::tempFile(enclave), {}}); });
    return made;
  }
  std::optional<line::Line> line_;
};

TEST_F(ShareOverALine, NoItemAndNothingOfAnInboxIsLostAndWhoHasForeignKeysHearsNothing) {
  constexpr std::size_t kItems = 300, kParts = 100;
  const auto a = joinAt(1, 1, "share_keys/enclaves/anna"), b = joinAt(2, 2, "share_keys/enclaves/bert"),
             stranger = joinAt(3, 3, "foreign_share_keys/enclaves/carl");
  expectStream(*a, *b, 9);
  for (std::size_t i = 0; i < kItems; ++i) sendSurely(*a, {Lane::kItems, i + 1, "item " + std::to_string(i)});
  for (std::size_t i = 0; i < kParts; ++i)
    sendSurely(*a, {Lane::kInbox, 2, std::to_string(i) + std::string(16'000, '.')});
  Heard heard;
  waitFor([&] {
    b->wait(1'000'000);
    heard.take(*b);
    stranger->send({Lane::kItems, 1000, "from a stranger"});
    return heard.items.size() >= kItems && heard.inbox.size() >= kParts;
  });
  for (std::size_t i = 0; i < kParts; ++i) EXPECT_EQ(std::stoul(heard.inbox[i]), i);
  EXPECT_FALSE(heard.items.contains(1000));
  Heard of_stranger;
  of_stranger.take(*stranger);
  EXPECT_TRUE(of_stranger.items.empty() && of_stranger.stream.empty());
}

// On the way to one server is a line that would take minutes for what waits.
TEST_F(ShareOverALine, WhatWaitsForASlowServerHoldsUpNoStream) {
  line_->say("loss 0");
  const auto a = joinAt(1, 1, "share_keys/enclaves/anna"), b = joinAt(2, 2, "share_keys/enclaves/bert"),
             c = joinAt(3, 3, "share_keys/enclaves/bert");
  expectStream(*a, *b, 9);
  expectStream(*a, *c, 9);
  line_->say("from 1 to 2 rate 1");
  std::uint64_t sent = 0;
  const auto sendAll = [&] {
    while (a->send({Lane::kItems, sent + 1, std::string(kMaxPacket_bytes, 'x')})) ++sent;
    a->receive();
    return sent * kMaxPacket_bytes > ShareProcess::kMaxWaiting_bytes;
  };
  waitFor(sendAll);
  for (std::uint64_t key = 10; key < 20; ++key) {
    expectStream(*a, *c, key);
    sendAll();
  }
}

// As when a machine loses its network and its server is killed: nobody else would end the program.
TEST_F(ShareOverALine, ItsProgramEndsWithItsServerAlsoWhenTheNetworkHasGone) {
  ASSERT_EQ(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);  // the program comes to this process when the server has ended
  int ready[2];
  ASSERT_EQ(pipe2(ready, O_CLOEXEC), 0);
  pid_t server = 0;
  line_->inside(1, [&] {
    server = fork();
    if (server != 0) return;
    const DdsReach reach{"line0", test::tempFile("share_keys/enclaves/anna"), {}};
    const auto process = std::make_unique<ShareProcess>(ShareTask{HL_VERSION, kDomain, "gone", 1, reach});
    if (write(ready[1], "1", 1) == 1) pause();
    _exit(1);
  });
  close(ready[1]);
  char one = 0;
  EXPECT_EQ(read(ready[0], &one, 1), 1);
  close(ready[0]);
  line_.reset();
  kill(server, SIGKILL);
  waitFor([] { return waitpid(-1, nullptr, WNOHANG) < 0 && errno == ECHILD; });
  prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST_F(ShareOverALine, WithoutKeysNobodyGoesBeyondTheMachine) {
  line_->inside(1, [&] { EXPECT_THROW(join("line", 1, {"line0", "", {}}), Error); });
}

}  // namespace
}  // namespace hl::test_share_process

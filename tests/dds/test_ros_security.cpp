// Hands across a network, by DDS Security: who has keys of the same authority reads and moves them, and nobody else.
// The network is that of tests/line; Fast DDS, another implementation, is the other side.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "dds/fast_peer.h"
#include "dds/payloads.h"
#include "line/line.h"
#include "ros/keystore.h"
#include "ros/ros_bridge.h"
#include "ros/ros_process.h"
#include "temp_folder.h"
#include "touch/session_views.h"
#include "wait_for.h"

namespace hl::test_ros_security {
namespace {

using test::FastPeer;
using test::Reliability;
using test::waitFor;

constexpr std::uint32_t kDomain = 3;  // in namespaces of this test alone
constexpr const char* kHand = "lab/hand";
// Ends of the line.
constexpr int kServer = 1, kConsole = 2, kStranger = 3, kFriend = 4;

TouchSettings quietHand() {
  TouchSettings settings;
  settings.explore = false;
  return settings;
}

std::string enclaveOf(const std::string& keystore, const std::string& name) {
  return test::tempFile(keystore) + "/enclaves/" + name;
}

class RosSecurity : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = line::lineRefusal()) GTEST_SKIP() << *why;
    line_.emplace(4, "delay 10 jitter 2 loss 1");
    makeEnclaves(test::tempFile("keys"), {"hand", "console"}, kDomain);
    makeEnclaves(test::tempFile("foreign"), {"console"}, kDomain);
  }
  void TearDown() override {
    if (bridge_) bridge_->stop();
    std::filesystem::remove_all(test::tempFile("keys"));
    std::filesystem::remove_all(test::tempFile("foreign"));
  }
  // hl-ros at its end of the line, for a simulated hand.
  void serve(const std::vector<std::string>& peers = {}) {
    std::unique_ptr<RosProcess> process;
    line_->inside(kServer, [&] {
      process = std::make_unique<RosProcess>(
          RosTask{HL_VERSION, kDomain, {kHand}, {"line0", enclaveOf("keys", "hand"), peers}});
    });
    session_.start();
    bridge_.emplace(std::move(process), std::vector<TouchSession*>{&session_}, 250, [](const std::string&) {});
    bridge_->start();
  }
  // A participant of ROS 2 there; without an enclave it has no keys.
  std::unique_ptr<FastPeer> peer(int end, const std::string& enclave) {
    std::unique_ptr<FastPeer> made;
    line_->inside(end, [&] { made = std::make_unique<FastPeer>(kDomain, test::Reach::kUdp, enclave); });
    return made;
  }
  static std::unique_ptr<test::FastReader> places(FastPeer& peer) {
    return peer.reader(ddsTopic(kHand, "measured_cp"), test::kPoseType, Reliability::kBestEffort);
  }
  static std::unique_ptr<test::FastWriter> forces(FastPeer& peer) {
    return peer.writer(ddsTopic(kHand, "servo_cf"), test::kWrenchType, Reliability::kReliable);
  }
  // How far to the right the hand is, as published.
  static std::optional<double> newestOf(test::FastReader& reader) {
    std::optional<double> x_m;
    while (const auto payload = reader.take()) {
      test::PayloadReader in(*payload);
      in.number<std::int32_t>();
      in.number<std::uint32_t>();
      in.text();
      x_m = in.numbers<3>()[0];
    }
    return x_m;
  }
  // A busy machine may hold the servo up, which is a fault: then a person arms again.
  void keepOn() {
    if (test::servoOf(session_).safety == SafetyState::kFault) session_.live().rearm();
  }
  std::uint64_t taken() const { return bridge_->counts().verdicts[static_cast<std::size_t>(CommandVerdict::kTaken)]; }
  // The console reads the hand, and its force moves it.
  void expectConsoleMovesTheHand() {
    const auto console = peer(kConsole, enclaveOf("keys", "console"));
    const auto reader = places(*console);
    const auto writer = forces(*console);
    // The force only then: a hand that has moved before its first place is read rests already.
    std::optional<double> first_m;
    waitFor([&] {
      keepOn();
      first_m = newestOf(*reader);
      return first_m.has_value();
    });
    waitFor([&] {
      keepOn();
      writer->write(test::wrenchOf(rosFrame(kHand), {1.5, 0, 0}));
      const auto x_m = newestOf(*reader);
      return x_m && *x_m > *first_m + 1e-3;
    });
    EXPECT_GT(taken(), 0u);
  }

  std::optional<line::Line> line_;
  TouchSession session_{makeSnapshot(std::vector<Instance>{}, "nothing"), quietHand()};
  std::optional<RosBridge> bridge_;
};

TEST_F(RosSecurity, WhoHasKeysReadsAndMovesTheHandOverABadLine) {
  serve();
  expectConsoleMovesTheHand();
}

TEST_F(RosSecurity, PeersAreFoundWithoutMulticast) {
  line_->say("multicast off");
  serve({line::addressOf(kConsole)});
  expectConsoleMovesTheHand();
}

// The friend has no keys either: that the stranger hears and is heard by it shows that it is not deaf. The hand is sent
// 250 times a second to the console meanwhile, so that there is something to hear.
TEST_F(RosSecurity, WhoHasNoKeysOrForeignOnesReadsAndMovesNothing) {
  serve();
  for (const std::string& enclave : {std::string(), enclaveOf("foreign", "console")}) {
    const auto stranger = peer(kStranger, enclave), comrade = peer(kFriend, enclave);
    const auto stranger_reads = places(*stranger),
               friend_hears = comrade->reader(ddsTopic(kHand, "servo_cf"), test::kWrenchType, Reliability::kBestEffort);
    const auto stranger_writes = forces(*stranger),
               friend_sends =
                   comrade->writer(ddsTopic(kHand, "measured_cp"), test::kPoseType, Reliability::kBestEffort);
    const auto console = peer(kConsole, enclaveOf("keys", "console"));
    const auto console_reads = places(*console);
    int of_friend = 0, of_stranger = 0, of_hand = 0;
    waitFor([&] {
      stranger_writes->write(test::wrenchOf("", {1.5, 0, 0}));
      friend_sends->write(test::poseOf("", {1000, 0, 0}));
      while (const auto x_m = newestOf(*stranger_reads)) {
        EXPECT_EQ(*x_m, 1000);
        ++of_friend;
      }
      while (friend_hears->take()) ++of_stranger;
      if (newestOf(*console_reads)) ++of_hand;
      keepOn();
      return of_friend > 100 && of_stranger > 100 && of_hand > 100;
    });
    EXPECT_EQ(taken(), 0u);
    EXPECT_TRUE(test::servoOf(session_).force_N.isZero(0));
  }
}

TEST_F(RosSecurity, AnEnclaveThatDoesNotFitIsRefusedBeforeAnybodyCouldReachTheHand) {
  const auto fails = [&](const DdsReach& reach) {
    line_->inside(kServer, [&] {
      EXPECT_THROW(RosProcess(RosTask{HL_VERSION, kDomain, {kHand}, reach}), Error) << reach.enclave;
    });
  };
  fails({"line0", "", {}});
  fails({"line0", test::tempFile("nowhere"), {}});
  fails({"line0", test::tempFile("keys"), {}});
  std::filesystem::copy_file(enclaveOf("foreign", "console") + "/cert.pem", enclaveOf("keys", "hand") + "/cert.pem",
                             std::filesystem::copy_options::overwrite_existing);
  fails({"line0", enclaveOf("keys", "hand"), {}});
  // What fits, of permissions for another enclave: this DDS finds out.
  std::filesystem::copy_file(enclaveOf("keys", "console") + "/cert.pem", enclaveOf("keys", "hand") + "/cert.pem",
                             std::filesystem::copy_options::overwrite_existing);
  std::filesystem::copy_file(enclaveOf("keys", "console") + "/key.pem", enclaveOf("keys", "hand") + "/key.pem",
                             std::filesystem::copy_options::overwrite_existing);
  fails({"line0", enclaveOf("keys", "hand"), {}});
}

}  // namespace
}  // namespace hl::test_ros_security

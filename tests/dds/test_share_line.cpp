// A shared world on a bad line: what moves far away is touched and ends at the same place to the bit, and a server that
// is killed again and again loses nothing, while a hand lies on what it had.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/clock.h"
#include "dds/share_lab.h"
#include "ros/keystore.h"
#include "temp_folder.h"
#include "wait_for.h"

namespace hl::test::test_share_line {
namespace {

TEST(SharedWorldOnALine, WhatMovesFarAwayIsFeltWithinTheTankAndEndsAtTheSamePlace) {
  if (const auto why = line::lineRefusal()) GTEST_SKIP() << *why;
  const LabResult result = ShareLab({50, 5, 1}).run(8);
  EXPECT_GT(result.staleness_p50_ms, 50);
  EXPECT_GT(result.playout_ms, 45);
  EXPECT_GT(result.force_mean_N, 0.1);
  EXPECT_GE(result.least_tank_J, 0);
}

constexpr std::uint32_t kDomain = 44;

/// hld with a scene of its own, at an end of the line.
class Hld {
 public:
  Hld(const line::Line& line, int end, const std::string& name, const std::string& keys) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "hld";
    const std::vector<std::string> words{program,
                                         "--scene",
                                         HL_SCENES "/examples/blocks.hl.json",
                                         "--port",
                                         "0",
                                         "--share",
                                         "lab",
                                         "--share-name",
                                         name,
                                         "--share-interface",
                                         "line0",
                                         "--share-security",
                                         keys};
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    setenv("ROS_DOMAIN_ID", std::to_string(kDomain).c_str(), 1);
    line.inside(end, [&] { posix_spawn(&id_, program.c_str(), &files, nullptr, arguments.data(), environ); });
    posix_spawn_file_actions_destroy(&files);
  }
  ~Hld() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  Hld(const Hld&) = delete;
  Hld& operator=(const Hld&) = delete;

 private:
  pid_t id_ = 0;
};

class KilledServer : public testing::Test {
 protected:
  static constexpr std::size_t kObjects = 3;
  static constexpr double kStill_m = 0.002;

  void SetUp() override {
    if (const auto why = line::lineRefusal()) GTEST_SKIP() << *why;
    line_.emplace(2, "delay 10 jitter 1 loss 1");
    std::filesystem::remove_all(tempFile("killed_keys"));
    makeEnclaves(tempFile("killed_keys"), {"anna", "bert"}, kDomain);
    std::unique_ptr<ShareProcess> process;
    line_->inside(2, [&] {
      process = std::make_unique<ShareProcess>(ShareTask{HL_VERSION, kDomain, "lab", 1, {"line0", keysOf("bert"), {}}});
    });
    bert_ = std::make_unique<SharedServer>(std::move(process), 1, "bert", nothing());
  }
  static std::string keysOf(const std::string& name) { return tempFile("killed_keys") + "/enclaves/" + name; }
  std::unique_ptr<Hld> anna() { return std::make_unique<Hld>(*line_, 1, "anna", keysOf("anna")); }
  // Watches the hand meanwhile: it lies on the floor of the other server, which stays where it is.
  template <typename Condition>
  void watchUntil(const Condition& condition) {
    waitFor([&] {
      EXPECT_EQ(bert_->scene()->instances.size(), kObjects);
      ServoView servo;
      ProxyView proxy;
      bert_->touch.device().views(servo, proxy);
      if (servo.safety == SafetyState::kFault)
        bert_->touch.device().live().rearm();  // a busy machine holds the servo up
      EXPECT_GT(proxy.proxy.y(), -kStill_m);
      EXPECT_LT((proxy.proxy - kPlace).norm(), 2 * kStill_m);
      return condition();
    });
  }
  ShareCounts counts() { return bert_->bridge.view().counts; }

  const Vec3 kPlace{-0.07, 0, 0.07};
  std::optional<line::Line> line_;
  std::unique_ptr<SharedServer> bert_;
};

TEST_F(KilledServer, LosesNothingHoweverOftenItIsKilledAndNoHandMoves) {
  const char* const said = std::getenv("HL_KILLS");
  const int kills = said == nullptr ? 3 : std::atoi(said);
  auto killed = anna();
  waitFor([this] { return bert_->scene()->instances.size() == kObjects; });
  bert_->touch.device().live().setWorkspace({});
  waitFor([this] {
    // It is let go a moment after the objects have come.
    bert_->touch.device().hand().setGoal(kPlace - Vec3(0, kStill_m, 0));
    ServoView servo;
    ProxyView proxy;
    bert_->touch.device().views(servo, proxy);
    return (proxy.proxy - kPlace).norm() < 1.5 * kStill_m && servo.force_N.norm() > 0.1;
  });
  for (int i = 0; i < kills; ++i) {
    killed.reset();
    watchUntil([&] { return counts().own_items == kObjects; });
    killed = anna();
    watchUntil([&] { return counts().own_items == 0 && !bert_->bridge.view().peers.empty(); });
  }
  EXPECT_TRUE(bert_->hasReported("server anna is lost"));
}

}  // namespace
}  // namespace hl::test::test_share_line

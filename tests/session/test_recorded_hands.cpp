// Recordings of the hands of several devices at the same bodies, replayed together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "record/recorder.h"
#include "record/recording_file.h"
#include "record/replay.h"
#include "session/bodies_client.h"
#include "temp_folder.h"

namespace hl::test_recorded_hands {
namespace {

constexpr std::size_t kHands = 3;

class RecordedHands : public testing::Test {
 protected:
  // A session of hands that go round about blocks, which clients draw, push and take away.
  static void record(const std::string& file) {
    TouchServerSettings settings = test::settingsOf();
    settings.devices.clear();
    for (std::size_t i = 0; i < kHands; ++i) settings.devices.push_back({nameOf(i), "sim"});
    RecorderSettings recorder;
    recorder.file = file;
    recorder.several = true;
    settings.touch.sink = recorderWith(recorder);
    TouchServer server(makeSnapshot(std::vector<Instance>{}), settings);
    server.start();
    test::BodiesClient client(server);
    ASSERT_EQ(client.show(test::blocksFrame(1, {Vec3(0, 0.05, 0), Vec3(0.05, 0.03, 0)})), "");
    stir(server, client, 150);
    proto::BodyCommand push;
    push.set_object(2);
    test::set(*push.mutable_push()->mutable_impulse_n_s(), Vec3(0.02, 0.03, 0));
    ASSERT_EQ(client.act(push), "");
    stir(server, client, 150);
    ASSERT_EQ(client.show(test::blocksFrame(2, {})), "");  // each servo ticks for its hand
    stir(server, client, 50);
    ASSERT_EQ(client.show(test::blocksFrame(3, {Vec3(0, 0.08, 0)})), "");
    stir(server, client, 150);
    server.stop();
  }
  static std::string nameOf(std::size_t hand) { return "hand" + std::to_string(hand); }
  std::vector<std::string> files() const {
    std::vector<std::string> files;
    for (std::size_t i = 0; i < kHands; ++i) files.push_back(recordingOf(path_, nameOf(i)));
    return files;
  }

  test::TempFolder folder_;
  std::string path_ = (folder_.path() / "session.hlr").string();

 private:
  // So many states of the client.
  static void stir(TouchServer& server, test::BodiesClient& client, int states) {
    EXPECT_TRUE(client.until([&] {
      for (std::size_t i = 0; i < kHands; ++i) {
        if (server.device(i).servoTotals().steps % 50 == 0) server.device(i).live().rearm();  // a busy machine
        const double angle = 0.04 * states + 2 * static_cast<double>(i);
        server.device(i).hand().setGoal(Vec3(0.05 * std::cos(angle), 0.02, 0.02 * std::sin(angle)));
      }
      return --states < 0;
    }));
  }
};

// The same recording but for its block of ticks with this number, among those that have any.
void writeWithout(const std::string& from, const std::string& to, int block_of_ticks) {
  RecordingReader reader(from);
  RecordingWriter writer(to);
  for (proto::RecordingBlock block; reader.next(block);) {
    if (!block.has_ticks() || block_of_ticks-- != 0) writer.write(block);
  }
}

std::string refusalOf(const std::vector<std::string>& files) {
  try {
    replayTogether(files);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(RecordedHands, AreReplayedTogetherBitForBit) {
  record(path_);
  std::vector<std::string> together = files();
  std::reverse(together.begin(), together.end());  // in any order
  std::uint64_t hashes = 0;
  for (const ReplayReport& report : replayTogether(together)) {
    EXPECT_FALSE(report.difference) << report.label << ' ' << report.difference->what << ' '
                                    << report.difference->number << ": " << report.difference->text;
    EXPECT_EQ(report.ticks_among_hands + report.unchecked_ticks + report.lost_ticks, 0U);
    hashes += report.world_hashes;
  }
  EXPECT_GT(hashes, 10U);

  // One alone lacks what the others did.
  const ReplayReport alone = replay(files()[0]);
  EXPECT_FALSE(alone.difference);
  EXPECT_GT(alone.ticks_among_hands, 10U);
  EXPECT_LT(alone.ticks_among_hands, alone.ticks);
  EXPECT_GT(replayTogether({files()[0], files()[2]})[1].ticks_among_hands, 10U);
  EXPECT_NE(refusalOf({files()[0], files()[0]}).find("of the same device"), std::string::npos);

  // Without some ticks of one hand nothing is known of the bodies after them, and of no hand that touches them.
  const std::string less = (folder_.path() / "less.hlr").string();
  writeWithout(files()[1], less, 0);
  for (const ReplayReport& report : replayTogether({files()[0], less, files()[2]})) {
    EXPECT_FALSE(report.difference) << report.label;
    EXPECT_GT(report.ticks_among_hands, 0U);
  }
}

TEST_F(RecordedHands, AreOfOneSession) {
  record(path_);
  const std::string other = (folder_.path() / "other.hlr").string();
  RecordingReader reader(files()[1]);
  RecordingWriter writer(other);
  for (proto::RecordingBlock block; reader.next(block); writer.write(block)) {
    if (block.has_start()) block.mutable_start()->set_begin_unix_ms(block.start().begin_unix_ms() + 60'000);
  }
  EXPECT_NE(refusalOf({files()[0], other}).find("of another session"), std::string::npos);
  EXPECT_EQ(refusalOf({files()[0], path_}), path_ + ": there is no such file");
}

}  // namespace
}  // namespace hl::test_recorded_hands

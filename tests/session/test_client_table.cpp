// What passes between those who submit, builders and the publisher: without threads, in any order that they may come
// in.
#include "session/client_table.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace hl::test_client_table {
namespace {

FrameCallbacks silent() {
  return {[](std::uint64_t, double) {}, [](std::uint64_t, std::size_t, const std::vector<std::string>&) {},
          [](std::uint64_t, const std::string&) {}};
}

class ClientTableTest : public testing::Test {
 protected:
  ClientTableTest() { table.start(); }

  std::shared_ptr<ClientScene> join(std::uint32_t session) { return table.join(session, {}, {}, silent()); }
  void submit(const std::shared_ptr<ClientScene>& client, std::uint64_t number) {
    proto::Frame frame;
    frame.set_number(number);
    table.submit(client, std::move(frame), {}, {});
  }
  /// There is some.
  void expectWork(const std::shared_ptr<ClientScene>& client, std::uint64_t frame) {
    const std::optional<BuilderWork> work = table.awaitWork();
    ASSERT_TRUE(work && work->frame);
    EXPECT_EQ(work->client, client);
    EXPECT_EQ(work->frame->frame.number(), frame);
  }
  /// Of the only client.
  PlacedShapes takePlaced() { return table.take().of_clients.at(0).placed; }

  ClientTable table{{}, 1};
};

TEST_F(ClientTableTest, AClientIsWithOneBuilderAtATimeAndTheOldestFrameIsBuiltFirst) {
  const auto first = join(1), second = join(2);
  submit(first, 1);
  submit(first, 2);
  submit(second, 7);
  submit(second, 8);
  expectWork(first, 1);
  EXPECT_EQ(table.waiting(first), 2U);
  expectWork(second, 7);
  table.done(*second);
  table.done(*first);
  expectWork(first, 2);
  expectWork(second, 8);
  table.done(*first);
  EXPECT_EQ(table.waiting(first), 0U) << "its builder has neither applied nor kept them";
}

TEST_F(ClientTableTest, WhatCouldNotBeShownComesAgainUnlessThereIsSomethingNewer) {
  const auto client = join(1);
  const auto older = std::make_shared<const PlacedList>(), newer = std::make_shared<const PlacedList>();
  table.place(client, older, 0);
  EXPECT_TRUE(table.awaitChange());
  SceneParts parts = table.take();
  EXPECT_EQ(parts.of_clients.at(0).placed, older);
  EXPECT_EQ(takePlaced(), nullptr) << "it is as it was";
  table.giveBack(parts);
  EXPECT_TRUE(table.awaitChange());
  EXPECT_EQ(takePlaced(), older);
  parts.of_clients.at(0).placed = older;
  table.place(client, newer, 0);
  table.giveBack(parts);
  EXPECT_EQ(takePlaced(), newer);
}

TEST_F(ClientTableTest, WhoIsWithABuilderGoesWhenThatIsDone) {
  const auto client = join(1);
  submit(client, 1);
  expectWork(client, 1);
  table.remove(client);
  SceneParts parts = table.take();
  EXPECT_TRUE(parts.of_clients.at(0).gone);
  table.eraseGone(parts);
  parts = table.take();
  EXPECT_EQ(parts.of_clients.size(), 1U);
  table.done(*client);
  EXPECT_TRUE(table.awaitChange());
  table.eraseGone(parts);
  EXPECT_TRUE(table.take().of_clients.empty());
}

TEST(BodyAdmission, ABaseThatIsToComeKeepsItsRoom) {
  BodyAdmission admission({}, 1);
  const SceneLimits limits;
  EXPECT_NO_THROW(admission.check({200, 0}, {}, limits));
  admission.reserve({kMaxBodies - 100, 0});
  EXPECT_THROW(admission.check({200, 0}, {}, limits), Error);
  EXPECT_NO_THROW(admission.check({100, 0}, {}, limits));
  admission.setBase({100, 0});
  EXPECT_NO_THROW(admission.check({200, 0}, {}, limits));
}

TEST_F(ClientTableTest, NobodyWaitsWhereItHasStopped) {
  submit(join(1), 1);
  table.stop();
  EXPECT_FALSE(table.awaitWork());
  EXPECT_FALSE(table.awaitChange());
}

}  // namespace
}  // namespace hl::test_client_table

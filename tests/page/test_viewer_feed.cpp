// What pages are sent of a world that several servers share.
#include "page/viewer_feed.h"

#include <gtest/gtest.h>
#include <hl.pb.h>

namespace hl::test_viewer_feed {
namespace {

proto::OtherDevice handOf(const std::string& server, const std::string& label) {
  proto::OtherDevice hand;
  hand.set_server(server);
  hand.set_label(label);
  hand.mutable_force_n()->set_y(3);
  hand.set_contacts(2);
  return hand;
}

class SharedWorldOfAPage : public testing::Test {
 protected:
  SharedWorldOfAPage() {
    view_.counts.items = 12;
    view_.counts.own_items = 5;
    view_.counts.fetching = 2;
    view_.peers = {{"bert", 100.5, 75}, {"carl", 1, 4}};
    view_.hands = {handOf("bert", "left"), handOf("bert", "right"), handOf("carl", "")};
  }
  proto::State stateWith(ReadShare share) {
    ViewerFeedSettings settings;
    settings.share = std::move(share);
    proto::ServerMessage message;
    EXPECT_TRUE(message.ParseFromString(makeViewerFeed(session_, "test", std::move(settings)).state()));
    return message.state();
  }

  TouchSession session_{makeSnapshot(std::vector<Instance>{}), {}};
  ShareView view_{"lab", "anna", {}};
};

TEST_F(SharedWorldOfAPage, IsNotThereWhereAServerSharesNone) {
  const proto::State state = stateWith({});
  EXPECT_FALSE(state.has_shared());
  EXPECT_EQ(state.remote_size(), 0);
}

TEST_F(SharedWorldOfAPage, HasItsNamesItsObjectsAndTheOtherServers) {
  const proto::SharedWorld shared = stateWith([this] { return view_; }).shared();
  EXPECT_EQ(shared.world(), "lab");
  EXPECT_EQ(shared.name(), "anna");
  EXPECT_EQ(shared.ended(), "");
  EXPECT_EQ(shared.objects(), 7U);
  EXPECT_EQ(shared.own(), 5U);
  EXPECT_EQ(shared.fetching(), 2U);
  ASSERT_EQ(shared.peers_size(), 2);
  EXPECT_EQ(shared.peers(0).name(), "bert");
  EXPECT_EQ(shared.peers(0).round_trip_ms(), 100.5);
  EXPECT_EQ(shared.peers(0).playout_ms(), 75);
  EXPECT_EQ(shared.peers(1).name(), "carl");
}

TEST_F(SharedWorldOfAPage, HasTheHandsOfTheOtherServersApartFromItsOwnDevices) {
  const proto::State state = stateWith([this] { return view_; });
  ASSERT_EQ(state.remote_size(), 3);
  EXPECT_EQ(state.remote(1).server(), "bert");
  EXPECT_EQ(state.remote(1).label(), "right");
  EXPECT_EQ(state.remote(1).force_n().y(), 3);
  EXPECT_EQ(state.remote(1).contacts(), 2U);
  EXPECT_EQ(state.remote(2).server(), "carl");
  EXPECT_EQ(state.others_size(), 0);
}

TEST_F(SharedWorldOfAPage, SaysWhyItIsSharedNoMore) {
  view_.ended = "hl-share has ended";
  view_.peers.clear();
  view_.hands.clear();
  const proto::State state = stateWith([this] { return view_; });
  EXPECT_EQ(state.shared().ended(), "hl-share has ended");
  EXPECT_EQ(state.shared().own(), 5U);
  EXPECT_EQ(state.remote_size(), 0);
}

}  // namespace
}  // namespace hl::test_viewer_feed

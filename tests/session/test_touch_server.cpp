// Sessions of HL clients on a running server, without sockets: what may come when, what is shown, touched and reported.
#include "session/touch_server.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <barrier>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

#include "base/error.h"
#include "take_replies.h"

namespace hl::test_touch_server {
namespace {

TouchServerSettings settingsOf() {
  TouchServerSettings settings;
  settings.touch.explore = false;
  settings.touch.world_per_device = 1;
  settings.version = "test";
  return settings;
}

std::shared_ptr<const Snapshot> nothing() { return makeSnapshot(std::vector<Instance>{}); }

// A square floor of 2 m at the height y, two triangles.
void addFloor(proto::Item& item, double y) {
  for (const double v : {-1.0, y, 1.0, 1.0, y, 1.0, 1.0, y, -1.0, -1.0, y, -1.0})
    item.mutable_primitives()->add_vertices(v);
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) item.mutable_primitives()->add_triangles(i);
}

// A client that holds one session and keeps what it was sent.
class Client {
 public:
  explicit Client(TouchServer& server) : session_(server.connect([this] { ++wakes_; })) {}

  void open(const std::string& name = "test", bool master = true, bool keep = false, double state_rate_Hz = 1000) {
    proto::ClientMessage message;
    message.mutable_open()->set_protocol_version(1);
    message.mutable_open()->set_client_name(name);
    message.mutable_open()->set_master(master);
    message.mutable_open()->set_keep_objects(keep);
    message.mutable_open()->set_state_rate_hz(state_rate_Hz);
    session_->receive(message);
    ASSERT_TRUE(until([this] { return welcome_.protocol_version() == 1; }));
  }

  // World: one object with a floor at this height.
  proto::Frame floorFrame(double y) {
    proto::Frame frame;
    frame.set_number(++number_);
    proto::ObjectDefinition& object = *frame.add_objects();
    object.set_id(4);
    addFloor(*object.add_items(), y);
    proto::Item& call = *frame.mutable_world()->add_items();
    call.set_call(4);
    call.set_name(17);
    return frame;
  }

  void send(const proto::Frame& frame) {
    proto::ClientMessage message;
    *message.mutable_frame() = frame;
    session_->receive(message);
  }
  bool show(const proto::Frame& frame) {
    send(frame);
    return until([&] { return shown_ == frame.number(); });
  }

  void handTo(const Vec3& goal) {
    proto::ClientMessage message;
    proto::Vec3& p = *message.mutable_device()->mutable_hand_goal()->mutable_position();
    p.set_x(goal.x());
    p.set_y(goal.y());
    p.set_z(goal.z());
    session_->receive(message);
  }

  bool until(const std::function<bool()>& reached) {
    return test::takeUntil(
        *session_, [this](const proto::ServerReply& reply) { remember(reply); }, reached);
  }

  void remember(const proto::ServerReply& reply) {
    if (reply.has_welcome()) welcome_ = reply.welcome();
    if (reply.has_state()) state_ = reply.state();
    if (reply.has_frame_shown()) shown_ = reply.frame_shown().number();
    if (reply.has_frame_shown()) shown_message_ = reply.frame_shown();
    if (reply.has_refusal()) refusal_ = reply.refusal();
    if (reply.has_progress()) ++progress_;
    if (reply.has_event()) events_.push_back(reply.event());
  }

  std::atomic<int> wakes_{0};
  std::unique_ptr<ClientSession> session_;
  proto::Welcome welcome_;
  proto::ClientState state_;
  proto::Refusal refusal_;
  proto::FrameShown shown_message_;
  std::vector<proto::Event> events_;
  std::uint64_t shown_ = 0, number_ = 0;
  int progress_ = 0;
};

class TouchServerTest : public testing::Test {
 protected:
  TouchServerTest() : server_(nothing(), settingsOf()) { server_.start(); }
  TouchServer server_;
};

// Without states nobody asks for what is there but when woken.
std::shared_ptr<const Snapshot> boxScene(const std::string& name, double half) {
  Model model;
  for (int i = 0; i < 8; ++i)
    model.positions.emplace_back((i & 1 ? half : -half), (i & 2 ? half : -half), (i & 4 ? half : -half));
  for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},
                                   {0, 4, 6, 2},
                                   {1, 3, 7, 5}}) {
    model.triangles.push_back({a, b, c});
    model.triangles.push_back({a, c, d});
  }
  model.name = name;
  return makeSnapshot(std::move(model));
}

// The finger of the simulated hand, in the scene.
Vec3 fingerOf(TouchSession& session) {
  ServoView servo;
  ProxyView proxy;
  session.views(servo, proxy);
  return session.live().workspace().toWorld(servo.finger_D);
}

TEST(ReplaceScene, ShowsAnotherFittedToTheHandWhichIsAboveItThen) {
  TouchServerSettings settings = settingsOf();
  settings.touch.world_per_device.reset();
  TouchServer server(boxScene("small", 1), settings);
  server.start();
  TouchSession& session = server.device();
  const double scale = session.live().workspace().world_per_device;
  session.hand().setGoal({0, 0, 0});  // onto the box
  const std::uint64_t key = session.snapshot()->instances.at(0).key;
  server.replaceScene(boxScene("large", 10));
  EXPECT_EQ(session.snapshot()->name, "large");
  EXPECT_NE(session.snapshot()->instances.at(0).key, key);
  EXPECT_NEAR(session.live().workspace().world_per_device, 10 * scale, 1e-9);
  EXPECT_GT(fingerOf(session).y(), 10);
  server.replaceScene(boxScene("small again", 1));
  EXPECT_NEAR(session.live().workspace().world_per_device, scale, 1e-12);
}

TEST(ReplaceScene, FreesAHandThatTheSceneBeforeHolds) {
  TouchServerSettings settings = settingsOf();
  settings.touch.world_per_device.reset();
  TouchServer server(nothing(), settings);
  server.start();
  TouchSession& session = server.device();
  ASSERT_TRUE(session.moveHandAside({}, 10));  // 2 cm above the origin, and then a box closes around it
  session.publishAnew(SnapshotSlot::prepare(boxScene("around", 1)));
  server.replaceScene(boxScene("next", 1));
  EXPECT_EQ(session.snapshot()->name, "next");
  EXPECT_GT(fingerOf(session).y(), 1);
}

TEST(ReplaceScene, IsRefusedWhileAClientHasItsObjectsThere) {
  TouchServer server(boxScene("small", 1), settingsOf());
  server.start();
  Client client(server);
  EXPECT_THROW(server.replaceScene(boxScene("large", 10)), Error);
  EXPECT_EQ(server.device().snapshot()->name, "small");
}

TEST_F(TouchServerTest, ProgressWakesAClientThatAsksForNoStates) {
  Client client(server_);
  client.open("test", true, false, 0);
  const int welcomed = client.wakes_;
  proto::Frame frame = client.floorFrame(0);
  addFloor(*frame.mutable_objects(0)->add_items(), 1);  // when the first of the two is built, half of the frame is
  ASSERT_TRUE(client.show(frame));
  EXPECT_GE(client.progress_, 1);
  EXPECT_GE(client.wakes_, welcomed + 2) << "one for the progress, one for the frame";
}

TEST_F(TouchServerTest, OpenComesFirst) {
  Client client(server_);
  client.send(client.floorFrame(0));
  EXPECT_NE(client.session_->end().find("open"), std::string::npos);
}

TEST_F(TouchServerTest, AnotherVersionOrDeviceIsRefusedWithAReason) {
  proto::ClientMessage message;
  message.mutable_open()->set_protocol_version(99);
  Client old(server_);
  old.session_->receive(message);
  EXPECT_NE(old.session_->end().find("99"), std::string::npos);
  message.mutable_open()->set_protocol_version(1);
  message.mutable_open()->set_device(3);
  Client lost(server_);
  lost.session_->receive(message);
  EXPECT_NE(lost.session_->end().find("device 3"), std::string::npos);
}

TEST_F(TouchServerTest, WelcomeDescribesDevicesAndLimits) {
  Client client(server_);
  client.open();
  EXPECT_EQ(client.welcome_.server_version(), "test");
  EXPECT_TRUE(client.welcome_.master());
  ASSERT_EQ(client.welcome_.devices_size(), 1);
  EXPECT_GT(client.welcome_.devices(0).force_max_n(), 1);
  EXPECT_GT(client.welcome_.limits().scene_bytes(), 100'000'000u);
}

TEST_F(TouchServerTest, AFrameIsShownTouchedAndReportedByItsNames) {
  Client client(server_);
  client.open();
  ASSERT_TRUE(client.show(client.floorFrame(0)));
  EXPECT_EQ(client.shown_message_.primitives(), 2u);
  client.handTo({0, -0.01, 0});
  ASSERT_TRUE(client.until([&] { return client.state_.touched_size() == 1 && client.state_.force_n().y() > 0.3; }));
  EXPECT_EQ(client.state_.touched(0).object(), 4u);
  EXPECT_EQ(client.state_.touched(0).name(), 17u);
  EXPECT_GE(client.state_.proxy().y(), 0.002 * (1 - 1e-9));
  client.handTo({0, 0.05, 0});
  ASSERT_TRUE(client.until([&] { return client.events_.size() >= 2; }));
  EXPECT_EQ(client.events_[0].kind(), proto::TOUCH);
  EXPECT_EQ(client.events_[0].name(), 17u);
  EXPECT_EQ(client.events_[1].kind(), proto::UNTOUCH);
}

// A row of points; `step` sends neighbours apart, so that a hierarchy made for a step of 1 is worn.
proto::Frame rowFrame(Client& client, int step) {
  constexpr int kPoints = 2003;  // a prime
  proto::Frame frame;
  frame.set_number(++client.number_);
  proto::ObjectDefinition& object = *frame.add_objects();
  object.set_id(4);
  proto::Primitives& row = *object.add_items()->mutable_primitives();
  for (int i = 0; i < kPoints; ++i) {
    for (const double v : {0.001 * (i * step % kPoints), -0.3, 0.0}) row.add_vertices(v);
    row.add_points(static_cast<std::uint32_t>(i));
  }
  frame.mutable_world()->add_items()->set_call(4);
  return frame;
}

TEST_F(TouchServerTest, ARedefinedObjectIsRefittedAndRebuiltInTheBackgroundWhenItIsWorn) {
  Client client(server_);
  client.open();
  ASSERT_TRUE(client.show(rowFrame(client, 1)));
  const auto built = server_.device().snapshot();
  EXPECT_EQ(server_.hierarchyCounts().refits, 0u);
  ASSERT_TRUE(client.show(rowFrame(client, 1)));
  EXPECT_EQ(server_.hierarchyCounts().refits, 1u);
  EXPECT_EQ(server_.device().snapshot()->shape().before, built->shape().geometry);
  ASSERT_TRUE(client.show(rowFrame(client, 700)));
  EXPECT_EQ(server_.hierarchyCounts().refits, 2u);
  const std::uint64_t geometry = server_.device().snapshot()->shape().geometry;
  ASSERT_TRUE(client.until([&] { return server_.device().snapshot()->shape().before == 0; }));
  EXPECT_EQ(server_.hierarchyCounts().rebuilds, 1u);
  const auto rebuilt = server_.device().snapshot();
  EXPECT_EQ(rebuilt->shape().geometry, geometry);
  EXPECT_EQ(rebuilt->shape().cost_ratio, 1);
  EXPECT_EQ(rebuilt->blend_ns, 0);
  ASSERT_TRUE(client.show(rowFrame(client, 700)));
  EXPECT_EQ(server_.device().snapshot()->shape().before, geometry) << "from the one that was rebuilt";
  EXPECT_EQ(server_.hierarchyCounts().rebuilds, 1u);
}

TEST_F(TouchServerTest, AnObjectWithOtherListsIsBuilt) {
  Client client(server_);
  client.open();
  ASSERT_TRUE(client.show(client.floorFrame(-0.2)));
  ASSERT_TRUE(client.show(rowFrame(client, 1)));
  EXPECT_EQ(server_.hierarchyCounts().refits, 0u);
  EXPECT_EQ(server_.device().snapshot()->shape().before, 0u);
}

// Moves vertices of item 0 of object 4 from `first` on to the height y.
proto::Frame movingFrame(Client& client, std::uint32_t first, int count, double y) {
  proto::Frame frame;
  frame.set_number(++client.number_);
  proto::VertexUpdate& update = *frame.add_moved();
  update.set_object(4);
  update.set_first(first);
  for (int i = 0; i < count; ++i) {
    for (const double v : {0.001 * i, y, 0.0}) update.mutable_primitives()->add_vertices(v);
  }
  return frame;
}

TEST_F(TouchServerTest, VerticesAreMovedWithoutTheRestOfTheirMesh) {
  Client client(server_);
  client.open();
  ASSERT_TRUE(client.show(rowFrame(client, 1)));
  ASSERT_TRUE(client.show(movingFrame(client, 3, 20, -0.4)));
  const Model& model = server_.device().snapshot()->shape().model;
  EXPECT_EQ(server_.hierarchyCounts().refits, 1u);
  EXPECT_EQ(model.positions[2], Vec3(0.002, -0.3, 0));
  EXPECT_EQ(model.positions[3], Vec3(0, -0.4, 0));
  EXPECT_EQ(model.positions[22], Vec3(0.019, -0.4, 0));
  EXPECT_EQ(model.positions[23], Vec3(0.023, -0.3, 0));
  proto::Frame both = rowFrame(client, 1);  // defined and moved in one frame, twice
  *both.add_moved() = movingFrame(client, 0, 2, -0.5).moved(0);
  *both.add_moved() = movingFrame(client, 1, 1, -0.6).moved(0);
  both.set_number(++client.number_);
  ASSERT_TRUE(client.show(both));
  const auto snapshot = server_.device().snapshot();
  EXPECT_EQ(snapshot->shape().model.positions[0].y(), -0.5);
  EXPECT_EQ(snapshot->shape().model.positions[1].y(), -0.6);
  EXPECT_EQ(snapshot->shape().model.positions[3].y(), -0.3);
}

TEST_F(TouchServerTest, AnUploadMovesVerticesToo) {
  Client client(server_);
  client.open();
  ASSERT_TRUE(client.show(rowFrame(client, 1)));
  proto::Frame frame = movingFrame(client, 100, 2, -0.4);
  proto::ClientMessage message;
  message.mutable_upload()->set_id(9);
  *message.mutable_upload()->mutable_part() = frame.moved(0).primitives();
  client.session_->receive(message);
  frame.mutable_moved(0)->set_upload(9);
  ASSERT_TRUE(client.show(frame));
  EXPECT_EQ(server_.device().snapshot()->shape().model.positions[101].y(), -0.4);
}

TEST_F(TouchServerTest, VerticesThatCannotBeMovedAreRefusedInOneLine) {
  Client client(server_);
  client.open();
  proto::Frame row = rowFrame(client, 1);
  row.mutable_objects(0)->add_items()->set_call(5);
  ASSERT_TRUE(client.show(row));
  const std::uint64_t shown = server_.device().snapshot()->shape().geometry;
  const auto refusalOf = [&](const std::function<void(proto::VertexUpdate&)>& change, std::uint32_t first = 0) {
    proto::Frame frame = movingFrame(client, first, 3, -0.4);
    change(*frame.mutable_moved(0));
    client.send(frame);
    EXPECT_TRUE(client.until([&] { return client.refusal_.frame() == frame.number(); }));
    return client.refusal_.text();
  };
  EXPECT_EQ(refusalOf([](auto& update) { update.set_object(7); }), "moved[0]: there is no object 7");
  EXPECT_EQ(refusalOf([](auto& update) { update.set_object(0); }), "moved[0]: there is no object 0");
  EXPECT_EQ(refusalOf([](auto& update) { update.set_item(1); }), "moved[0]: item 1 of object 4 has no vertices");
  EXPECT_EQ(refusalOf([](auto& update) { update.set_item(2); }), "moved[0]: item 2 of object 4 has no vertices");
  EXPECT_EQ(refusalOf([](auto&) {}, 2001), "moved[0]: the item has 2003 vertices, no more");
  EXPECT_EQ(refusalOf([](auto&) {}, 4'000'000'000), "moved[0]: the item has 2003 vertices, no more");
  EXPECT_EQ(refusalOf([](auto& update) { update.mutable_primitives()->set_vertices(4, NAN); }),
            "moved[0] must hold finite numbers");
  EXPECT_EQ(refusalOf([](auto& update) { update.mutable_primitives()->add_points(0); }),
            "moved[0] must hold vertices and normals alone");
  EXPECT_EQ(
      refusalOf([](auto& update) { *update.mutable_primitives()->mutable_normals() = update.primitives().vertices(); }),
      "moved[0]: the item's vertices have no normals");
  EXPECT_EQ(refusalOf([](auto& update) { update.clear_what(); }), "moved[0] needs primitives or an upload");
  EXPECT_EQ(refusalOf([](auto& update) { update.set_upload(77); }), "moved[0]: there is no upload 77");
  EXPECT_EQ(server_.device().snapshot()->shape().geometry, shown);
  proto::Frame gone = movingFrame(client, 0, 1, -0.4);
  gone.add_deleted_objects(4);
  client.send(gone);
  ASSERT_TRUE(client.until([&] { return client.refusal_.frame() == gone.number(); }));
}

TEST_F(TouchServerTest, ARefusedFrameChangesNothingAndTheNextIsShown) {
  Client client(server_);
  client.open();
  ASSERT_TRUE(client.show(client.floorFrame(0)));
  proto::Frame bad = client.floorFrame(-0.5);
  bad.mutable_objects(0)->mutable_items(0)->mutable_primitives()->set_triangles(2, 77);
  client.send(bad);
  ASSERT_TRUE(client.until([&] { return client.refusal_.frame() == bad.number(); }));
  EXPECT_EQ(client.refusal_.text(),
            "object 4, items[0].primitives.triangles: there is no vertex 77: there are 4, from 0");
  EXPECT_FALSE(client.refusal_.fatal());
  EXPECT_EQ(server_.device().snapshot()->bounds.max.y(), 0);
  client.send(bad);
  ASSERT_TRUE(client.until([&] { return client.refusal_.text().find("rising") != std::string::npos; }));
  ASSERT_TRUE(client.show(client.floorFrame(-0.25)));
  EXPECT_EQ(server_.device().snapshot()->bounds.max.y(), -0.25);
}

TEST_F(TouchServerTest, UploadsInPartsAreOneMesh) {
  Client client(server_);
  client.open();
  proto::Item whole;
  addFloor(whole, 0.125);
  for (int part = 0; part < 4; ++part) {
    proto::ClientMessage message;
    message.mutable_upload()->set_id(9);
    proto::Primitives& p = *message.mutable_upload()->mutable_part();
    for (int i = 0; i < 3; ++i) p.add_vertices(whole.primitives().vertices(3 * part + i));
    if (part == 3) *p.mutable_triangles() = whole.primitives().triangles();
    client.session_->receive(message);
  }
  proto::Frame frame;
  frame.set_number(++client.number_);
  frame.mutable_world()->add_items()->set_upload(9);
  ASSERT_TRUE(client.show(frame));
  EXPECT_EQ(server_.device().snapshot()->primitives, 2u);
  frame.set_number(++client.number_);
  client.send(frame);
  ASSERT_TRUE(client.until([&] { return client.refusal_.frame() == frame.number(); })) << "gone once it was used";
}

TEST_F(TouchServerTest, AWorkspaceThatNobodyCanComputeWithIsRefused) {
  Client client(server_);
  client.open();
  const double before = server_.device().live().workspace().world_per_device;
  for (const double scale : {0.0, -1.0, 1e300, 1e-300, std::numeric_limits<double>::quiet_NaN()}) {
    proto::ClientMessage message;
    message.mutable_device()->mutable_workspace()->set_world_per_device(scale);
    client.refusal_.Clear();
    client.session_->receive(message);
    ASSERT_TRUE(client.until([&] { return !client.refusal_.text().empty(); })) << scale;
  }
  proto::ClientMessage message;
  message.mutable_device()->set_proxy_radius(1e300);
  client.refusal_.Clear();
  client.session_->receive(message);
  ASSERT_TRUE(client.until([&] { return !client.refusal_.text().empty(); }));
  EXPECT_EQ(server_.device().live().workspace().world_per_device, before);
}

// An empty polygon is two bytes on the wire and fifty in memory: the limit is of memory.
TEST(TouchServer, UploadsCountAsTheMemoryThatTheyTake) {
  TouchServerSettings settings = settingsOf();
  settings.limits.upload_bytes = 1'000'000;
  TouchServer server(nothing(), settings);
  server.start();
  Client client(server);
  client.open();
  proto::ClientMessage message;
  message.mutable_upload()->set_id(1);
  for (int i = 0; i < 10'000; ++i) message.mutable_upload()->mutable_part()->add_polygons();
  int parts = 0;
  for (; client.session_->end().empty() && parts < 20; ++parts) client.session_->receive(message);
  EXPECT_GT(parts, 1);
  EXPECT_LT(parts, 10) << "on the wire they are 20 kB each";
  EXPECT_NE(client.session_->end().find("memory"), std::string::npos) << client.session_->end();
}

TEST_F(TouchServerTest, UploadsOfOneMessageAreThoseOfSeveral) {
  Client client(server_);
  client.open();
  proto::Item whole;
  addFloor(whole, 0.125);
  proto::ClientMessage message;
  proto::Frame frame;
  frame.set_number(++client.number_);
  for (const std::uint64_t id : {7U, 8U}) {
    proto::Upload& vertices = *message.mutable_uploads()->add_parts();
    vertices.set_id(id);
    *vertices.mutable_part()->mutable_vertices() = whole.primitives().vertices();
    proto::Upload& triangles = *message.mutable_uploads()->add_parts();
    triangles.set_id(id);
    *triangles.mutable_part()->mutable_triangles() = whole.primitives().triangles();
    frame.mutable_world()->add_items()->set_upload(id);
  }
  client.session_->receive(message);
  ASSERT_TRUE(client.show(frame));
  EXPECT_EQ(server_.device().snapshot()->primitives, 4U);
}

// An upload with nothing in it is two bytes on the wire, and a refusal a hundred.
TEST_F(TouchServerTest, OneMessageOfUploadsIsNotAnsweredWithoutEnd) {
  Client client(server_);
  client.open();
  proto::ClientMessage message;
  for (int i = 0; i < 100'000; ++i) message.mutable_uploads()->add_parts();
  client.session_->receive(message);
  EXPECT_NE(client.session_->end(), "");
  int replies = 0;
  for (proto::ServerReply reply; client.session_->take(reply);) ++replies;
  EXPECT_LT(replies, 5000);
}

// A server with memory for two rows of points, and for what it takes to make one.
class SmallServerTest : public testing::Test {
 protected:
  static constexpr std::uint64_t kMax_bytes = 820'000;  // half of it for whoever comes first

  static TouchServerSettings small() {
    TouchServerSettings settings = settingsOf();
    settings.limits.memory_bytes = kMax_bytes;
    return settings;
  }
  SmallServerTest() : server_(nothing(), small()), empty_bytes_(server_.memory().used_bytes()) { server_.start(); }

  std::uint64_t used() const { return server_.memory().used_bytes() - empty_bytes_; }
  /// What is shown is a shape, in the world, and what is said about it; no message waits any more.
  bool isOneRow() {
    const std::uint64_t shape = server_.device().snapshot()->shape().bytes();
    return used() > shape && used() < shape + bytesInWorld() + 10'000;
  }

  TouchServer server_;
  const std::uint64_t empty_bytes_;
};

TEST_F(SmallServerTest, ASceneThatDoesNotFitIsRefusedAndWhatIsThereStays) {
  Client first(server_), second(server_), third(server_);
  for (Client* client : {&first, &second, &third}) client->open();
  EXPECT_EQ(first.welcome_.limits().memory_bytes(), kMax_bytes);
  ASSERT_TRUE(first.show(rowFrame(first, 1)));
  ASSERT_TRUE(first.until([&] { return isOneRow(); }));
  ASSERT_TRUE(second.show(rowFrame(second, 1)));
  const proto::Frame too_much = rowFrame(third, 1);
  third.send(too_much);
  ASSERT_TRUE(third.until([&] { return third.refusal_.frame() == too_much.number(); }));
  EXPECT_NE(third.refusal_.text().find("the scenes of all clients"), std::string::npos) << third.refusal_.text();
  EXPECT_EQ(server_.device().snapshot()->instances.size(), 2u);
  first.session_.reset();
  ASSERT_TRUE(third.until([&] { return server_.device().snapshot()->instances.size() == 1; }));
  ASSERT_TRUE(third.until([&] { return isOneRow(); }));
  EXPECT_TRUE(third.show(rowFrame(third, 1))) << third.refusal_.text();
}

TEST_F(SmallServerTest, WhatIsBentCountsTwiceUntilTheNextFrame) {
  Client client(server_);
  client.open();
  ASSERT_TRUE(client.show(rowFrame(client, 1)));
  ASSERT_TRUE(client.until([&] { return isOneRow(); }));
  const std::uint64_t once = used();
  proto::Frame bent = rowFrame(client, 1);
  bent.mutable_objects(0)->mutable_items(0)->mutable_primitives()->set_vertices(1, -0.31);
  bent.set_interval_s(0.05);  // however long the frame before was ago
  ASSERT_TRUE(client.show(bent));
  const double twice = 2.0 * static_cast<double>(once);
  ASSERT_TRUE(client.until([&] { return std::abs(static_cast<double>(used()) - twice) < 0.05 * twice; }));
  proto::Frame same;
  EXPECT_TRUE(client.until([&] {  // until it has got there
    same.set_number(++client.number_);
    return client.show(same) && used() <= once;
  }));
}

TEST_F(SmallServerTest, AnUploadThatDoesNotFitIsRefusedWithTheFrameThatNeedsIt) {
  Client client(server_);
  client.open();
  ASSERT_TRUE(client.show(client.floorFrame(0)));
  const std::uint64_t before = used();
  proto::ClientMessage part;
  part.mutable_upload()->set_id(7);
  for (int i = 0; i < 30'000; ++i) part.mutable_upload()->mutable_part()->add_vertices(i);
  for (int i = 0; i < 5; ++i) client.session_->receive(part);
  ASSERT_TRUE(client.until([&] { return !client.refusal_.text().empty(); }));
  EXPECT_EQ(client.refusal_.text().find("upload 7: there is no room"), 0u) << client.refusal_.text();
  EXPECT_EQ(used(), before) << "no part of it is kept";
  const auto frameOf = [&] {
    proto::Frame frame;
    frame.set_number(++client.number_);
    proto::Item& item = *frame.mutable_world()->add_items();
    item.set_upload(7);
    return frame;
  };
  client.send(frameOf());
  ASSERT_TRUE(client.until([&] { return client.refusal_.frame() == 2; }));
  EXPECT_NE(client.refusal_.text().find("there is no upload 7"), std::string::npos) << client.refusal_.text();
  EXPECT_EQ(server_.device().snapshot()->primitives, 2u);
  part.mutable_upload()->mutable_part()->mutable_vertices()->Truncate(9);
  for (const std::uint32_t i : {0U, 1U, 2U}) part.mutable_upload()->mutable_part()->add_points(i);
  client.session_->receive(part);
  EXPECT_TRUE(client.show(frameOf())) << client.refusal_.text();
}

TEST_F(TouchServerTest, OneClientIsTheDevicesMasterUntilItLeaves) {
  auto first = std::make_unique<Client>(server_);
  first->open();
  Client second(server_);
  second.open("second");
  EXPECT_FALSE(second.welcome_.master());
  second.handTo({0, 0, 0});
  ASSERT_TRUE(second.until([&] { return !second.refusal_.text().empty(); }));
  EXPECT_EQ(second.refusal_.text(), "another client is the device's master");
  first.reset();
  second.refusal_.Clear();
  second.handTo({0, 0, 0});
  ASSERT_TRUE(second.until([&] { return !second.refusal_.text().empty(); }));
  EXPECT_NE(second.refusal_.text().find("there is none"), std::string::npos) << second.refusal_.text();
  Client third(server_);
  third.open("third");
  EXPECT_TRUE(third.welcome_.master());
}

TEST_F(TouchServerTest, SettingsThatAreNoneAreRefusedAndNothingOfThemIsSet) {
  Client client(server_);
  client.open();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusalOf = [&](const std::function<void(proto::ClientMessage&)>& set) {
    proto::ClientMessage message;
    set(message);
    if (message.has_device()) message.mutable_device()->set_hand_firm(true);
    client.refusal_.Clear();
    client.session_->receive(message);
    EXPECT_TRUE(client.until([&] { return !client.refusal_.text().empty(); }));
    return client.refusal_.text();
  };
  for (const double bad : {-1.0, nan}) {
    EXPECT_EQ(refusalOf([&](auto& m) { m.mutable_device()->set_stiffness_n_m(bad); }),
              "stiffness_N_m must not be below 0");
    EXPECT_EQ(refusalOf([&](auto& m) { m.mutable_state_rate()->set_rate_hz(bad); }),
              "state_rate_Hz must not be below 0");
  }
  EXPECT_EQ(refusalOf([](auto& m) { m.mutable_device()->set_ledger(static_cast<proto::LedgerMode>(9)); }),
            "ledger must be TANK, STRICT or REPORT");
  EXPECT_EQ(refusalOf([&](auto& m) { m.mutable_device()->mutable_hand_turn()->mutable_rotation(); }),
            "hand_turn.rotation must hold finite numbers, not all of them 0");
  EXPECT_EQ(refusalOf([&](auto& m) { m.mutable_device()->mutable_hand_turn()->set_gripper_rad(nan); }),
            "hand_turn.gripper_rad must be finite");
  EXPECT_EQ(refusalOf([&](auto& m) { m.mutable_device()->mutable_hand_goal()->mutable_position()->set_x(nan); }),
            "hand_goal.position must hold finite numbers");
  EXPECT_FALSE(server_.device().hand().firm());
  proto::ClientMessage message;
  message.mutable_device()->set_hand_firm(true);
  client.session_->receive(message);
  EXPECT_TRUE(client.until([&] { return client.state_.hand_firm(); }));
}

// However seldom states come, each step of the servo is sent, once.
TEST_F(TouchServerTest, SamplesHoldAllThatTheDeviceDidBetweenTwoStates) {
  Client client(server_);
  client.open("test", true, false, 50);
  ASSERT_TRUE(client.until([&] { return client.state_.time_s() > 0; }));
  EXPECT_EQ(client.state_.samples_size(), 0) << "nobody has asked";
  proto::ClientMessage message;
  message.mutable_sample_request()->set_wanted(true);
  const std::uint64_t first = server_.device().moments().pushed();
  client.session_->receive(message);
  std::vector<double> times_s;
  int states = 0;
  while (states < 10 || times_s.size() < 100) {
    proto::ServerReply reply;
    if (!client.session_->take(reply)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!reply.has_state()) continue;
    ++states;
    for (const proto::DeviceSample& sample : reply.state().samples()) times_s.push_back(sample.time_s());
  }
  EXPECT_TRUE(std::is_sorted(times_s.begin(), times_s.end()));
  EXPECT_EQ(std::adjacent_find(times_s.begin(), times_s.end()), times_s.end()) << "none comes twice";
  EXPECT_LE(times_s.size(), server_.device().moments().pushed() - first);
  message.mutable_sample_request()->set_wanted(false);
  client.session_->receive(message);
  const double asked_s = server_.time_s();
  ASSERT_TRUE(client.until([&] { return client.state_.time_s() > asked_s; }));
  EXPECT_EQ(client.state_.samples_size(), 0);
}

// Each step of the servo is in one report, and the forces of the contacts add up to what the hand felt.
TEST_F(TouchServerTest, ContactReportsHoldAllThatWasPressed) {
  Client client(server_);
  client.open("test", true, false, 50);
  ASSERT_TRUE(client.show(client.floorFrame(-0.02)));
  proto::ClientMessage message;
  message.mutable_contact_report_request()->set_wanted(true);
  client.session_->receive(message);
  server_.device().hand().setGoal(server_.device().live().workspace().toWorld({0, -0.05, 0}));
  double last_s = 0;
  int states = 0, pressed = 0;
  for (int reports = 0; reports < 400 && pressed < 5;) {
    proto::ServerReply reply;
    if (!client.session_->take(reply)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (reply.has_state()) ++states;
    if (!reply.has_contact_report()) continue;
    ++reports;
    const proto::ContactReport& report = reply.contact_report();
    EXPECT_GE(report.time_s(), last_s);
    last_s = report.time_s();
    EXPECT_LE(std::abs(states + 1 - reports), 1) << "one before each state";
    proto::Vec3 sum;
    for (const proto::PressedPoint& point : report.contacts()) {
      sum.set_y(sum.y() + point.force_n().y());
      ASSERT_EQ(point.vertices_size(), 3);
      EXPECT_NEAR(point.weights(0) + point.weights(1) + point.weights(2), 1, 1e-9);
      EXPECT_EQ(point.session(), client.welcome_.session());
    }
    if (report.contacts_size() == 0 || report.force_n().y() < 0.1) continue;
    ++pressed;
    EXPECT_NEAR(sum.y(), report.force_n().y(), 0.2 * report.force_n().y());
  }
  EXPECT_GE(pressed, 5);
}

TEST_F(TouchServerTest, ClientsOwnTheirObjectsAndTakeThemAlong) {
  auto first = std::make_unique<Client>(server_);
  first->open();
  Client second(server_);
  second.open("second", false);
  ASSERT_TRUE(first->show(first->floorFrame(-0.2)));
  ASSERT_TRUE(second.show(second.floorFrame(-0.3)));
  EXPECT_EQ(server_.device().snapshot()->instances.size(), 2u);
  first.reset();
  ASSERT_TRUE(second.until([&] { return server_.device().snapshot()->instances.size() == 1; }));
  EXPECT_EQ(server_.device().snapshot()->bounds.max.y(), -0.3);
}

void leaveFloor(TouchServer& server, const std::string& name, double y) {
  Client client(server);
  client.open(name, false, true);
  ASSERT_TRUE(client.show(client.floorFrame(y)));
}

// One object each.
std::size_t shownBeside(TouchServer& server, double y) {
  Client other(server);
  other.open("other", false);
  EXPECT_TRUE(other.show(other.floorFrame(y)));
  return server.device().snapshot()->instances.size() - 1;
}

TEST_F(TouchServerTest, ObjectsThatStayGoWhenTheirNameShowsItsFirstFrame) {
  leaveFloor(server_, "keeper", -0.2);
  EXPECT_EQ(shownBeside(server_, -0.3), 1u);
  Client again(server_);
  again.open("keeper", false);
  EXPECT_EQ(shownBeside(server_, -0.3), 1u) << "it has shown nothing yet";
  ASSERT_TRUE(again.show(again.floorFrame(-0.4)));
  ASSERT_EQ(server_.device().snapshot()->instances.size(), 1u);
  EXPECT_EQ(server_.device().snapshot()->bounds.max.y(), -0.4);
}

TEST_F(TouchServerTest, ObjectsStayWhenTheirNameComesAgainAndShowsNothing) {
  leaveFloor(server_, "keeper", -0.2);
  for (const bool keep : {false, true, false}) {
    Client again(server_);
    again.open("keeper", false, keep);
  }
  EXPECT_EQ(shownBeside(server_, -0.3), 1u);
  Client last(server_);
  last.open("keeper", false);
  ASSERT_TRUE(last.show(last.floorFrame(-0.4)));
  EXPECT_EQ(server_.device().snapshot()->instances.size(), 1u);
}

TEST_F(TouchServerTest, OfTwoThatEndAtOnceUnderOneNameOneStays) {
  for (int round = 0; round < 50; ++round) {
    std::array<Client, 2> twins{Client(server_), Client(server_)};
    for (Client& twin : twins) {
      twin.open("twin", false, true);
      ASSERT_TRUE(twin.show(twin.floorFrame(-0.2)));
    }
    std::barrier both(2);
    std::thread other([&] {
      both.arrive_and_wait();
      twins[0].session_.reset();
    });
    both.arrive_and_wait();
    twins[1].session_.reset();
    other.join();
  }
  EXPECT_EQ(shownBeside(server_, -0.3), 1u);
}

TEST(TouchServer, OfTooManyThatStayTheOldestGo) {
  TouchServerSettings settings = settingsOf();
  settings.limits.kept = 3;
  TouchServer server(nothing(), settings);
  server.start();
  for (int i = 0; i < 10; ++i) leaveFloor(server, "keeper " + std::to_string(i), -0.2 - 0.01 * i);
  EXPECT_EQ(shownBeside(server, -0.5), 3u);
  EXPECT_EQ(server.device().snapshot()->bounds.max.y(), -0.27);
}

// Names of textures are quoted in refusals.
TEST_F(TouchServerTest, ARefusalIsShortWhateverItQuotes) {
  Client client(server_);
  client.open();
  proto::Frame frame;
  frame.set_number(1);
  proto::TextureImage& texture = *frame.add_textures();
  texture.set_name("a");
  texture.mutable_procedural()->set_kind(std::string(1'000'000, 'x'));
  client.send(frame);
  ASSERT_TRUE(client.until([&] { return client.refusal_.frame() == 1; }));
  EXPECT_LT(client.refusal_.text().size(), 400u);
}

TEST_F(TouchServerTest, FramesThatMoveAnObjectAreAllShownInOrder) {
  Client client(server_);
  client.open();
  ASSERT_TRUE(client.show(client.floorFrame(-0.5)));
  for (int i = 0; i < 100; ++i) {
    proto::Frame frame;
    frame.set_number(++client.number_);
    proto::Item& call = *frame.mutable_world()->add_items();
    call.set_call(4);
    for (const double m : {1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0.001 * i, 0., 1.}) call.add_matrix(m);
    client.send(frame);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(client.until([&] { return client.shown_ == client.number_; }));
  EXPECT_TRUE(client.refusal_.text().empty()) << client.refusal_.text();
  EXPECT_NEAR(server_.device().snapshot()->bounds.max.y(), -0.5 + 0.099, 1e-12);
}

TEST_F(TouchServerTest, AThousandClientsComeAndGo) {
  for (int i = 0; i < 1000; ++i) {
    Client client(server_);
    client.open("visitor");
    client.send(client.floorFrame(-1));
  }
  EXPECT_EQ(server_.sessions(), 0u);
  Client last(server_);
  last.open("last");
  EXPECT_TRUE(last.welcome_.master());
  ASSERT_TRUE(last.show(last.floorFrame(-0.4)));
  EXPECT_EQ(server_.device().snapshot()->instances.size(), 1u);
}

TEST_F(TouchServerTest, TooManyClientsAreTurnedAway) {
  std::vector<std::unique_ptr<ClientSession>> sessions;
  const std::uint32_t most = settingsOf().limits.sessions;
  for (std::uint32_t i = 0; i < most; ++i) sessions.push_back(server_.connect([] {}));
  EXPECT_THROW(server_.connect([] {}), Error);
}

TEST_F(TouchServerTest, EachDeviceHasAProxyOfItsOwn) {
  TouchServerSettings settings = settingsOf();
  settings.devices = {{"left", "sim"}, {"right", "sim"}};
  TouchServer server(nothing(), settings);
  server.start();
  Client client(server);
  client.open();
  ASSERT_TRUE(client.show(client.floorFrame(-0.02)));
  EXPECT_EQ(client.welcome_.devices_size(), 2);
  EXPECT_EQ(server.device(0).snapshot(), server.device(1).snapshot());
  server.device(1).hand().setGoal({0, -0.03, 0});
  ASSERT_TRUE(client.until([&] { return !client.events_.empty(); })) << "its objects are felt on both";
}

TEST(TouchServer, TheFirstWorldIsFittedToTheHand) {
  TouchServerSettings settings = settingsOf();
  settings.touch.world_per_device.reset();
  TouchServer server(nothing(), settings);
  server.start();
  Client client(server);
  client.open();
  ASSERT_TRUE(client.show(client.floorFrame(0)));
  EXPECT_NEAR(server.device().live().workspace().world_per_device, 2 / settings.touch.side_D, 1e-9);
  EXPECT_NEAR(server.device().live().radius_W(), settings.touch.radius_D * 2 / settings.touch.side_D, 1e-12);
  ASSERT_TRUE(client.show(client.floorFrame(1)));
  EXPECT_NEAR(server.device().live().workspace().origin_W.y(), 0, 1e-12) << "only the first";
}

// In metres of the world, whatever comes first: the world, the workspace or the radius.
TEST(TouchServer, ARadiusThatIsSetBeforeTheFirstWorldHolds) {
  for (const bool workspace : {false, true}) {
    TouchServerSettings settings = settingsOf();
    settings.touch.world_per_device.reset();
    TouchServer server(nothing(), settings);
    server.start();
    server.device().live().setRadius(0.003);
    if (workspace) server.device().live().setWorkspace({Vec3::Zero(), 5});
    EXPECT_EQ(server.device().live().radius_W(), 0.003);
    Client client(server);
    client.open();
    ASSERT_TRUE(client.show(client.floorFrame(0)));
    EXPECT_NEAR(server.device().live().workspace().world_per_device, workspace ? 5 : 2 / settings.touch.side_D, 1e-9);
    EXPECT_EQ(server.device().live().radius_W(), 0.003);
    server.device().live().setWorkspace({Vec3::Zero(), 2 * server.device().live().workspace().world_per_device});
    EXPECT_DOUBLE_EQ(server.device().live().radius_W(), 0.006) << "then it stays as it is at the hand";
  }
}

TEST(TouchServer, AClosedServerNotifiesItsClients) {
  auto server = std::make_unique<TouchServer>(nothing(), settingsOf());
  server->start();
  Client client(*server);
  client.open();
  server->stop();
  EXPECT_EQ(client.session_->end(), "the server is closing");
  client.session_.reset();
}

}  // namespace
}  // namespace hl::test_touch_server

// What several clients show at once: each in the order of its own frames, and nothing of one is changed by another.
#include "session/scene_publisher.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <new>

#include "base/clock.h"
#include "device/open_device.h"
#include "wait_for.h"

namespace hl::test_scene_publisher {
namespace {

proto::Frame frameOf(std::uint64_t number) {
  proto::Frame frame;
  frame.set_number(number);
  frame.mutable_world();
  frame.set_interval_s(0.01);
  return frame;
}

void define(proto::Frame& frame, double size) {
  proto::ObjectDefinition& object = *frame.add_objects();
  object.set_id(1);
  proto::Primitives& triangle = *object.add_items()->mutable_primitives();
  for (const double x : {0.0, 0.0, 0.0, size, 0.0, 0.0, 0.0, size, 0.0}) triangle.add_vertices(x);
  for (const std::uint32_t i : {0u, 1u, 2u}) triangle.add_triangles(i);
}

void call(proto::Frame& frame, double x) {
  proto::Item& item = *frame.mutable_world()->add_items();
  item.set_call(1);
  for (const double element : {1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., x, 0., 0., 1.}) item.add_matrix(element);
}

/// A client of a publisher, and what has been reported to it.
class Client {
 public:
  Client(
      ScenePublisher& publisher, std::uint32_t session, const MemoryBudget& memory = {},
      std::function<void(std::uint64_t)> on_progress = [](std::uint64_t) {}, std::shared_ptr<ClientScene> replaced = {})
      : clients_(publisher.clients()) {
    FrameCallbacks callbacks;
    callbacks.progress = [on_progress](std::uint64_t number, double) { on_progress(number); };
    callbacks.shown = [this](std::uint64_t number, std::size_t primitives, const std::vector<std::string>& warnings) {
      keep(number, primitives, warnings.size());
    };
    callbacks.refused = [this](std::uint64_t number, const std::string&) { keep(number, kRefused, 0); };
    place = clients_.join(session, {}, memory, std::move(callbacks), std::move(replaced));
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() {
    clients_.detach(place);
    clients_.remove(place);
  }

  static constexpr std::size_t kRefused = 1'000'000;
  struct Reported {
    std::uint64_t frame;
    std::size_t primitives;
    bool operator==(const Reported&) const = default;
  };

  void submit(proto::Frame frame) { clients_.submit(place, std::move(frame), {}, {}); }
  /// Waits for so many.
  std::vector<Reported> reported(std::size_t count) {
    const auto all = [&] {
      const std::lock_guard lock(mutex_);
      return reported_;
    };
    test::waitFor([&] { return all().size() >= count; });
    return all();
  }

  /// With the last frame.
  std::size_t warnings() {
    const std::lock_guard lock(mutex_);
    return warnings_;
  }

  std::shared_ptr<ClientScene> place;

 private:
  void keep(std::uint64_t number, std::size_t primitives, std::size_t warnings) {
    const std::lock_guard lock(mutex_);
    warnings_ = warnings;
    reported_.push_back({number, primitives});
  }

  ClientTable& clients_;
  std::mutex mutex_;
  std::vector<Reported> reported_;
  std::size_t warnings_ = 0;
};

// The loops of the session do not run, so that each scene is shown at once.
class ScenePublisherTest : public testing::Test {
 protected:
  ScenePublisherTest() { publisher.start(); }

  std::vector<const Instance*> shownOf(std::uint32_t client) {
    shown = session.snapshot();
    std::vector<const Instance*> instances;
    for (const Instance& instance : shown->instances) {
      if (instance.session == client) instances.push_back(&instance);
    }
    return instances;
  }

  std::shared_ptr<const Snapshot> shown = makeSnapshot(std::vector<Instance>{}, "nothing");
  TouchSession session{shown, {}};
  ScenePublisher publisher{shown, {&session}};
};

TEST_F(ScenePublisherTest, EachFrameIsReportedOnceAndInOrder) {
  Client client(publisher, 1);
  constexpr std::uint64_t kFrames = 200;
  for (std::uint64_t i = 1; i <= kFrames; ++i) {
    proto::Frame frame = frameOf(i);
    if (i == 1) define(frame, 1);
    call(frame, 0.001 * static_cast<double>(i));
    if (i % 10 == 0) frame.mutable_world()->add_items()->set_upload(7);  // there is no such one
    client.submit(std::move(frame));
  }
  const auto reported = client.reported(kFrames);
  ASSERT_EQ(reported.size(), kFrames);
  std::vector<std::uint64_t> accepted, refused;
  for (const auto& [number, primitives] : reported) {
    EXPECT_TRUE(primitives == 1 || primitives == Client::kRefused) << primitives;
    (primitives == 1 ? accepted : refused).push_back(number);
  }
  EXPECT_TRUE(std::is_sorted(accepted.begin(), accepted.end()));
  EXPECT_EQ(accepted.size(), kFrames - kFrames / 10);
  EXPECT_EQ(refused.size(), kFrames / 10);
  test::waitFor(
      [&] { return publisher.clients().waiting(client.place) == 0; });  // the last one is reported a little before
  EXPECT_DOUBLE_EQ(shownOf(1).at(0)->motion.to().origin.x(), 0.199);
}

TEST_F(ScenePublisherTest, OneClientMovesComesAndGoesBesideAnother) {
  Client still(publisher, 1);
  proto::Frame frame = frameOf(1);
  define(frame, 1);
  for (const double x : {5.0, 6.0, 7.0}) call(frame, x);
  still.submit(frame);
  EXPECT_EQ(still.reported(1), (std::vector<Client::Reported>{{1, 3}}));
  const std::vector<const Instance*> before = shownOf(1);
  const auto kept = shown;  // so that `before` stays
  ASSERT_EQ(before.size(), 3U);
  {
    Client moving(publisher, 2);
    frame = frameOf(1);
    define(frame, 2);
    call(frame, 0);
    moving.submit(frame);
    EXPECT_EQ(moving.reported(1), (std::vector<Client::Reported>{{1, 1}}));
    EXPECT_FALSE(shownOf(2).at(0)->motion.moves());
    EXPECT_EQ(shown->blend_ns, kAbruptBlend_ns) << "it is new";
    frame = frameOf(2);
    call(frame, 1);
    moving.submit(frame);
    EXPECT_EQ(moving.reported(2).back(), (Client::Reported{2, 1}));
    EXPECT_TRUE(shownOf(2).at(0)->motion.moves());
    EXPECT_EQ(shownOf(2).at(0)->motion.last().from().origin.x(), 0);
    EXPECT_EQ(shown->blend_ns, 0);
    EXPECT_EQ(shown->primitives, 4U);
  }
  frame = frameOf(2);
  for (const double x : {5.0, 6.0, 7.0}) call(frame, x);
  still.submit(frame);
  EXPECT_EQ(still.reported(2).back(), (Client::Reported{2, 3}));
  const std::vector<const Instance*> after = shownOf(1);
  EXPECT_EQ(shown->instances.size(), 3U) << "the other has gone";
  ASSERT_EQ(after.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(after[i]->key, before[i]->key);
    EXPECT_EQ(after[i]->shape, before[i]->shape);
    EXPECT_EQ(after[i]->motion.to(), before[i]->motion.to());
    EXPECT_FALSE(after[i]->motion.moves());
  }
}

TEST_F(ScenePublisherTest, WhatHasBeenBentIsAShapeAloneInAFrameOfAnotherClient) {
  const MemoryBudget memory(1'000'000'000);
  Client mesh_motion(publisher, 1, memory), other(publisher, 2);
  proto::Frame frame = frameOf(1);
  define(frame, 1);
  call(frame, 0);
  mesh_motion.submit(frame);
  mesh_motion.reported(1);
  frame.clear_objects();
  frame.set_number(2);
  define(frame, 1.1);
  mesh_motion.submit(frame);
  mesh_motion.reported(2);
  EXPECT_TRUE(shownOf(1).at(0)->mesh_motion);
  EXPECT_GT(memory.used_bytes(), 2 * shownOf(1).at(0)->shape->bytes()) << "the shape that it comes from is still there";
  std::uint64_t frames = 0;
  test::waitFor([&] {  // until it has got there
    other.submit(frameOf(++frames));
    other.reported(frames);
    return !shownOf(1).at(0)->mesh_motion;
  });
  EXPECT_EQ(shownOf(1).at(0)->shape->extent, 1.1);
  const std::uint64_t two_shapes = 2 * shownOf(1).at(0)->shape->bytes();
  shown.reset();
  test::waitFor([&] { return memory.used_bytes() < two_shapes + 2 * bytesInWorld(); });
}

// Two of these, one of them with a triangle that has shrunk to nothing, do not fit together as they are.
proto::Frame frameOfStrip(std::uint64_t number, double last_triangle) {
  constexpr int kTriangles = 1000;
  proto::Frame frame = frameOf(number);
  frame.set_interval_s(0.1);
  proto::ObjectDefinition& object = *frame.add_objects();
  object.set_id(1);
  proto::Primitives& strip = *object.add_items()->mutable_primitives();
  for (int i = 0; i < kTriangles; ++i) {
    const double size = i + 1 == kTriangles ? last_triangle : 1;
    for (const double v : {2. * i, 0., 0., 2. * i + size, 0., 0.1, 2. * i, size, 0.}) strip.add_vertices(v);
    for (int corner = 0; corner < 3; ++corner) strip.add_triangles(static_cast<std::uint32_t>(3 * i + corner));
  }
  call(frame, 0);
  return frame;
}

TEST_F(ScenePublisherTest, WhatBendsIsCounted) {
  const MemoryBudget memory(1'000'000'000);
  Client client(publisher, 1, memory);
  client.submit(frameOfStrip(1, 0));
  client.reported(1);
  client.submit(frameOfStrip(2, 1));
  client.reported(2);
  shownOf(1);
  const auto& mesh_motion = shown->instances.at(0).mesh_motion;
  ASSERT_TRUE(mesh_motion);
  ASSERT_NE(mesh_motion->last().from(), mesh_motion->last().given_from()) << "they are copies";
  ASSERT_NE(mesh_motion->last().to(), mesh_motion->last().given_to());
  std::uint64_t bytes = 0;
  mesh_motion->forEachShape([&](const std::shared_ptr<const Shape>& shape) { bytes += shape->bytes(); });
  EXPECT_GT(memory.used_bytes(), bytes);
  EXPECT_EQ(client.warnings(), 0U);
}

TEST_F(ScenePublisherTest, WhatHasNoRoomToBendIsThereAtOnceAndTheFrameSaysSo) {
  const std::uint64_t one_shape = [this] {
    const MemoryBudget memory(1'000'000'000);
    Client client(publisher, 2, memory);
    client.submit(frameOfStrip(1, 0));
    client.reported(1);
    return shownOf(2).at(0)->shape->bytes();
  }();
  shown.reset();
  const MemoryBudget memory(3 * one_shape);  // what is built needs more while it is
  Client client(publisher, 1, memory);
  client.submit(frameOfStrip(1, 0));
  EXPECT_EQ(client.reported(1).back().primitives, 999U);
  client.submit(frameOfStrip(2, 1));
  EXPECT_EQ(client.reported(2).back().primitives, 1000U);
  EXPECT_FALSE(shownOf(1).at(0)->mesh_motion);
  EXPECT_EQ(shown->blend_ns, kAbruptBlend_ns);
  EXPECT_EQ(client.warnings(), 1U);
  shown.reset();
  test::waitFor([&] { return memory.used_bytes() < 2 * one_shape; });
}

TEST_F(ScenePublisherTest, AClientThatHasGoneLeavesNothing) {
  const MemoryBudget memory(1'000'000'000);
  {
    Client client(publisher, 1, memory);
    proto::Frame frame = frameOf(1);
    define(frame, 1);
    call(frame, 0);
    client.submit(frame);
    client.reported(1);
    EXPECT_GT(memory.used_bytes(), 0U);
  }
  shown.reset();
  test::waitFor([&] { return memory.used_bytes() == 0; });
}

TEST_F(ScenePublisherTest, AReplacedClientGoesInTheSceneThatShowsTheFirstFrame) {
  Client before(publisher, 1);
  proto::Frame frame = frameOf(1);
  define(frame, 1);
  call(frame, 0);
  before.submit(frame);
  before.reported(1);
  Client after(
      publisher, 2, {}, [](std::uint64_t) {}, before.place);
  Client other(publisher, 3);
  other.submit(frameOf(1));
  other.reported(1);
  EXPECT_EQ(shownOf(1).size(), 1U) << "until there is something in its place";
  const std::uint64_t number = shown->number;
  after.submit(frame);
  after.reported(1);
  EXPECT_EQ(shownOf(2).size(), 1U);
  EXPECT_EQ(shownOf(1).size(), 0U);
  EXPECT_EQ(shown->number, number + 1) << "there was no scene with both, or with none";
}

// ---- Memory that is not there --------------------------------------------------------------------------------------

// Fails the n-th allocation from now on of the thread that asked for it, once.
std::atomic<int> order{0};  // what was asked for in an older one counts no more
thread_local int fails_in = 0, fails_for = 0;

void failIn(int allocations) {
  fails_in = allocations;
  fails_for = order;
}

bool failsNow() { return fails_in > 0 && fails_for == order && --fails_in == 0; }

// A frame is reported as shown, or it is refused and nothing of it ever is, whichever allocation of its builder fails.
TEST_F(ScenePublisherTest, AFrameHappensAsAWholeOrNotAtAllWhereverMemoryEnds) {
  int fails = 0;
  std::atomic<std::uint64_t> failing{0};
  Client client(publisher, 1, MemoryBudget(1'000'000'000), [&](std::uint64_t number) {
    if (number == failing) failIn(fails);
  });
  std::uint64_t number = 0;
  std::size_t reported = 0;
  double size = 1;
  proto::Frame frame = frameOf(++number);
  define(frame, size);
  call(frame, 0);
  client.submit(frame);
  client.reported(++reported);
  bool refused = true;
  for (fails = 1; refused; ++fails) {
    frame = frameOf(++number);
    define(frame, size + 1);
    call(frame, 0);
    failing = number;
    client.submit(frame);
    refused = client.reported(++reported).back().primitives == Client::kRefused;
    ++order;
    if (!refused) size += 1;
    proto::Frame same;
    same.set_number(++number);
    client.submit(same);
    ASSERT_EQ(client.reported(++reported).back().primitives, 1U);
    ASSERT_EQ(shownOf(1).at(0)->shape->extent, size) << "after allocation " << fails << " failed";
  }
  EXPECT_GT(fails, 5) << "some did fail";
}

// A device whose driver may keep its caller.
class KeepingDevice final : public Device {
 public:
  void open() override { own_->open(); }
  void close() override { own_->close(); }
  const DeviceInfo& info() const override { return own_->info(); }
  void write(const Vec3& force_N) override { own_->write(force_N); }
  DeviceSample read(std::int64_t now_ns) override {
    test::waitFor([this] { return !keeps.load(); });
    return own_->read(now_ns);
  }
  std::atomic<bool> keeps{false};

 private:
  std::unique_ptr<Device> own_ = openDevice("sim");
};

// More than one: the loop takes none of them.
void showWhileTheServoStands(bool from_its_first_step) {
  auto device = std::make_unique<KeepingDevice>();
  std::atomic<bool>& keeps = device->keeps;
  const auto nothing = makeSnapshot(std::vector<Instance>{}, "nothing");
  TouchSession session(nothing, {}, std::move(device));
  ScenePublisher publisher(nothing, {&session});
  keeps = from_its_first_step;
  session.start();
  publisher.start();
  if (!from_its_first_step) test::waitFor([&] { return session.servoTotals().steps > 100; });
  keeps = true;
  {
    Client client(publisher, 1);
    constexpr std::uint64_t kFrames = 20;
    for (std::uint64_t i = 1; i <= kFrames; ++i) {
      proto::Frame frame = frameOf(i);
      if (i == 1) define(frame, 1);
      call(frame, 0.001 * static_cast<double>(i));
      client.submit(std::move(frame));
      EXPECT_EQ(client.reported(i).back().primitives, 1U);
    }
    keeps = false;
    test::waitFor(
        [&] { return session.ready(monotonicNow_ns() - 1'000'000'000) && session.servoTotals().steps > 200; });
  }
  publisher.stop();
  session.stop();
}

TEST(StalledServo, ScenesOfAllClientsGoOnAndTheNewestIsTakenAfterwards) { showWhileTheServoStands(false); }
TEST(StalledServo, ADeviceThatKeepsItsFirstReadHoldsNoScene) { showWhileTheServoStands(true); }

}  // namespace
}  // namespace hl::test_scene_publisher

namespace {

void* allocated(std::size_t size, std::size_t alignment) {
  if (hl::test_scene_publisher::failsNow()) throw std::bad_alloc();
  void* const memory = std::aligned_alloc(alignment, (size + alignment) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return allocated(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocated(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

// Servers that share a world, in one process: each with its threads, its device and its own replica of what the others
// have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bodies_client.h"
#include "memory_hub.h"
#include "share/share_bridge.h"
#include "wait_for.h"

namespace hl::test {
namespace {

constexpr std::uint64_t kFloor = 1, kBlock = 2;

Instance boxInstance(std::uint64_t key, const Vec3& half, const Vec3& centre) {
  Model model;
  model.name = "box";
  proto::Primitives box;
  addBox(box, half);
  for (int i = 0; i < box.vertices_size(); i += 3)
    model.positions.emplace_back(box.vertices(i), box.vertices(i + 1), box.vertices(i + 2));
  for (int i = 0; i < box.triangles_size(); i += 3)
    model.triangles.push_back({box.triangles(i), box.triangles(i + 1), box.triangles(i + 2)});
  model.materials.resize(1);
  Instance instance;
  instance.shape = makeShape(std::move(model));
  instance.surfaces = surfacesOf(instance.shape);
  instance.motion = Motion(Pose{Mat3::Identity(), centre});
  instance.key = key;
  return instance;
}

// A floor whose top is at y = 0, and a block of 100 g that falls on it: out of reach of the hands, or near them.
const Vec3 kFar(0.5, 0.15, 0), kNear(0, 0.021, 0);
std::shared_ptr<const Snapshot> floorAndBlock(const Vec3& place = kFar) {
  std::vector<Instance> instances;
  instances.push_back(boxInstance(kFloor, Vec3(1, 0.05, 1), Vec3(0, -0.05, 0)));
  instances.push_back(boxInstance(kBlock, Vec3::Constant(kHalf_m), place));
  BodySpec spec;
  spec.mass_kg = 0.1;
  spec.shape = BodyShape::kBox;
  const Pose start{Mat3::Identity(), place};
  const Box scene{Vec3::Constant(-1), Vec3::Constant(1)};
  setBody(instances.back(), makeRigidBody("block", spec, start, instances.back().shape->bounds, roomAround(scene)));
  return makeSnapshot(std::move(instances), "table");
}
std::shared_ptr<const Snapshot> nothing() { return makeSnapshot(std::vector<Instance>{}, "nothing"); }

class Server {
 public:
  Server(MemoryHub& hub, ServerId id, const std::string& name, std::shared_ptr<const Snapshot> scene)
      : touch(std::move(scene), settingsOf()),
        bridge(std::make_unique<MemoryHub::Link>(hub, id), "lab", {id, name, true, "test"}, touch,
               [this](const std::string& line) {
                 const std::lock_guard lock(mutex_);
                 told_.push_back(line);
               }) {
    touch.start();
    bridge.start();
  }
  ~Server() {
    bridge.stop();
    touch.stop();
  }
  std::shared_ptr<const Snapshot> scene() { return touch.device().snapshot(); }
  /// Of those that are not of this server's own scene: the widest first.
  std::optional<Instance> other(std::size_t number = 0) {
    std::vector<Instance> others;
    for (const Instance& instance : scene()->instances) {
      if (instance.session != 0) others.push_back(instance);
    }
    std::sort(others.begin(), others.end(),
              [](const Instance& a, const Instance& b) { return a.shape->bounds.max.x() > b.shape->bounds.max.x(); });
    return number < others.size() ? std::optional(others[number]) : std::nullopt;
  }
  Instance own(std::uint64_t key) {
    const auto now = scene();
    std::uint32_t number = 0;
    EXPECT_TRUE(now->find(key, number));
    return now->instances[number];
  }
  bool hasTold(const std::string& text) {
    const std::lock_guard lock(mutex_);
    return std::any_of(told_.begin(), told_.end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> told_;

 public:
  TouchServer touch;
  ShareBridge bridge;
};

Vec3 placeOf(const Instance& instance) { return instance.shownAt(monotonicNow_ns()).origin; }

constexpr std::size_t kBoth = 2, kFloorThere = 0, kBlockThere = 1;

struct SharedServers : testing::Test {
  std::unique_ptr<Server> add(ServerId id, const std::string& name, std::shared_ptr<const Snapshot> scene) {
    return std::make_unique<Server>(hub, id, name, std::move(scene));
  }
  static void waitForBoth(Server& there) {
    waitFor([&] { return there.other(kBoth - 1).has_value(); });
  }
  MemoryHub hub;
};

TEST_F(SharedServers, HaveTheObjectsOfEachOther) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "bert", nothing());
  waitForBoth(*b);
  EXPECT_EQ(b->other(kFloorThere)->shape->model.positions, a->own(kFloor).shape->model.positions);
  EXPECT_EQ(placeOf(*b->other(kFloorThere)), Vec3(0, -0.05, 0));
  EXPECT_EQ(a->scene()->instances.size(), kBoth);
}

TEST_F(SharedServers, SeeEachOthersHands) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "bert", nothing());
  waitFor([&] { return a->bridge.view().hands.size() == 1 && b->bridge.view().hands.size() == 1; });
  waitFor([&] { return b->bridge.view().peers.size() == 1 && b->bridge.view().peers[0].name == "anna"; });
  EXPECT_EQ(b->bridge.view().hands[0].server(), "anna");
  EXPECT_TRUE(b->hasTold("server anna is in the world"));
}

TEST_F(SharedServers, ABodyThatHasComeToRestIsAtTheSamePlaceToTheBit) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "bert", nothing());
  waitForBoth(*b);
  waitFor([&] { return std::abs(placeOf(a->own(kBlock)).y() - kHalf_m) < 1e-3; });
  waitFor([&] {
    const Pose here = a->own(kBlock).shownAt(0), there = b->other(kBlockThere)->shownAt(monotonicNow_ns());
    return here == there && std::abs(here.origin.y() - kHalf_m) < 1e-3;
  });
}

TEST_F(SharedServers, WhatAHandPressesOnABodyOfAnotherMovesIt) {
  const auto a = add(1, "anna", floorAndBlock(kNear)), b = add(2, "bert", nothing());
  waitForBoth(*b);
  waitFor([&] { return std::abs(placeOf(*b->other(kBlockThere)).y() - kHalf_m) < 1e-3; });
  // From the left, at the height of its centre, and through it.
  b->touch.device().setWorkspace({});
  b->touch.device().setHandGoal(Vec3(-0.08, 0.1, 0));
  waitFor([&] { return b->bridge.view().counts.items == kBoth; });
  for (double x = -0.08; placeOf(a->own(kBlock)).x() < 0.01; x = std::min(x + 1e-4, 0.05)) {
    b->touch.device().setHandGoal(Vec3(x, x < -0.06 ? 0.1 : 0.015, 0));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_GT(b->bridge.view().counts.pushes_sent, 0);
  EXPECT_GT(a->bridge.view().counts.pushes_taken, 0);
  waitFor([&] { return placeOf(*b->other(kBlockThere)).x() > 0.009; });
}

TEST_F(SharedServers, WhatAKilledServerHadStaysAndItsBodiesGoOnAndComeBackWithIt) {
  const auto c = add(3, "carl", nothing());
  auto a = add(1, "anna", floorAndBlock());
  const auto b = add(2, "bert", nothing());
  waitForBoth(*b);
  waitForBoth(*c);
  hub.cut(1);
  a.reset();
  waitFor([&] { return b->other(kBlockThere)->movesAsBody(); });  // of all that are left it has the lowest number
  EXPECT_TRUE(b->hasTold("server anna is lost"));
  EXPECT_EQ(b->bridge.view().counts.adopted, kBoth);
  // It can be lifted from then on by a program of any server, as it could before.
  waitFor([&] { return c->other(kBlockThere)->shownAt(monotonicNow_ns()) == b->other(kBlockThere)->shownAt(0); });
  a = add(7, "anna", floorAndBlock());
  waitFor([&] { return b->other(kBlockThere) && !b->other(kBlockThere)->movesAsBody(); });
  waitFor([&] { return a->own(kBlock).shownAt(0) == b->other(kBlockThere)->shownAt(monotonicNow_ns()); });
  EXPECT_EQ(b->scene()->instances.size(), kBoth);
  EXPECT_EQ(a->scene()->instances.size(), kBoth);
}

TEST_F(SharedServers, OfOneNameTheSecondSharesNothing) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "anna", nothing());
  waitFor([&] { return !b->bridge.view().ended.empty() || !a->bridge.view().ended.empty(); });
  EXPECT_TRUE(a->hasTold("--share-name") || b->hasTold("--share-name"));
}

TEST_F(SharedServers, WhatIsThereStaysWhenTheLinkHasEnded) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "bert", nothing());
  waitForBoth(*b);
  hub.end(2);
  waitFor([&] { return !b->bridge.view().ended.empty(); });
  EXPECT_TRUE(b->hasTold("hl-share has ended"));
  EXPECT_TRUE(b->other(kBlockThere).has_value());
}

TEST_F(SharedServers, ObjectsOfAClientComeAndGo) {
  const auto a = add(1, "anna", nothing()), b = add(2, "bert", nothing());
  {
    BodiesClient client(a->touch);
    EXPECT_EQ(client.show(blocksFrame(1, {Vec3(0.3, 0.021, 0.3)})), "");
    waitForBoth(*b);
    EXPECT_EQ(client.show(blocksFrame(2, {})), "");
    waitFor([&] { return !b->other(kBlockThere).has_value(); });
    EXPECT_TRUE(b->other(kFloorThere).has_value());
  }
  waitFor([&] { return b->scene()->instances.empty(); });
}

}  // namespace
}  // namespace hl::test

// What pages are sent of a scene that changes: each mesh once, layouts only when something comes or goes, what moves in
// the states, and what may be forgotten.
#include "page/page_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <thread>

#include "builtin.h"
#include "surfaces/iso_surface.h"

namespace hl::test_page_scene {
namespace {

constexpr std::int64_t kMs = 1'000'000;
const PageScale kScale{0.002, 1.5};

std::shared_ptr<const Shape> plane(int triangles) {
  return makeShape(makeBuiltinScene("plane:" + std::to_string(triangles)), HierarchyKind::kNone);
}

Instance instanceOf(std::uint64_t key, const std::shared_ptr<const Shape>& shape, const Motion& motion = Motion()) {
  return {shape, surfacesOf(shape), motion, key, 1, static_cast<std::uint32_t>(10 * key), 0};
}

// A ball of more triangles than a page draws at first of a surface that has replaced another one.
std::shared_ptr<const Shape> largeBall(double radius) {
  constexpr std::uint32_t kSide = 160;
  const auto samples = std::make_shared<std::vector<float>>();
  for (std::uint32_t z = 0; z < kSide; ++z) {
    for (std::uint32_t y = 0; y < kSide; ++y) {
      for (std::uint32_t x = 0; x < kSide; ++x)
        samples->push_back(static_cast<float>(radius - (Vec3(x, y, z) - Vec3::Constant(kSide / 2.0)).norm()));
    }
  }
  const std::shared_ptr<const void> data(samples, samples->data());
  const auto volume =
      std::make_shared<const Volume>(VoxelGrid({kSide, kSide, kSide}, Samples(SampleKind::kFloat32, data)));
  return makeShape(std::make_shared<const IsoSurface>(volume, GridFrame{1e-3 * Mat3::Identity(), Vec3::Zero()},
                                                      IsoValue{0, SolidSide::kAbove}));
}

Pose at(double x, double y = 0, double z = 0) { return {Mat3::Identity(), {x, y, z}}; }

class PageSceneTest : public testing::Test {
 protected:
  std::vector<proto::ServerMessage> drain(PageMemory& page) const {
    std::vector<proto::ServerMessage> messages;
    while (const PageMessage bytes = scene_.next(page)) EXPECT_TRUE(messages.emplace_back().ParseFromString(*bytes));
    return messages;
  }
  /// Shows a snapshot with meshes that may have to be made first, on their own thread.
  std::vector<proto::ServerMessage> show(const std::shared_ptr<const Snapshot>& snapshot, std::int64_t now_ns = 0) {
    while (true) {
      scene_.follow(snapshot, kScale, now_ns);
      if (auto messages = drain(page_); !messages.empty()) return messages;
      std::this_thread::yield();
    }
  }
  proto::State stateAt(std::int64_t now_ns, std::vector<ObjectName> touched = {}, const HoldingSnap& snap = {}) const {
    proto::State state;
    scene_.describe(state, touched, snap, now_ns);
    return state;
  }
  static float poseNumber(const std::string& poses, std::size_t instance, std::size_t i) {
    float number = 0;
    std::memcpy(&number, poses.data() + sizeof number * (12 * instance + i), sizeof number);
    return number;
  }

  PageScene scene_;
  PageMemory page_ = scene_.open();
  const std::shared_ptr<const Shape> small_ = plane(8), large_ = plane(200);
};

TEST_F(PageSceneTest, ObjectsHaveTheNamesAndColoursOfTheirFiles) {
  std::vector<Instance> instances{instanceOf(1, small_), instanceOf(2, small_)};
  instances[1].label = std::make_shared<const Label>(Label{"bolt", Rgb{1, 2, 250}});
  const proto::SceneLayout first = show(makeSnapshot(instances)).back().layout();
  EXPECT_TRUE(first.placed(0).label().empty() && first.placed(0).colour().empty());
  EXPECT_EQ(first.placed(1).label(), "bolt");
  EXPECT_EQ(first.placed(1).colour(), "\x01\x02\xfa");
  instances[1].label = std::make_shared<const Label>(Label{"nut"});
  const proto::SceneLayout second = show(makeSnapshot(instances)).back().layout();
  EXPECT_EQ(second.placed(1).label(), "nut");
  EXPECT_TRUE(second.placed(1).colour().empty());
}

TEST_F(PageSceneTest, BodiesHaveTheNamesOfTheirFilesToo) {
  const Box room{Vec3::Constant(-1), Vec3::Constant(1)};
  std::vector<Instance> instances{instanceOf(1, small_), instanceOf(2, small_)};
  for (Instance& instance : instances) {
    BodySpec fixed;
    fixed.fixed = true;
    setBody(instance, makeRigidBody("door", fixed, Pose{}, instance.shape->bounds, room));
  }
  instances[0].session = 0;
  const proto::SceneLayout layout = show(makeSnapshot(instances)).back().layout();
  EXPECT_EQ(layout.placed(0).label(), "door");
  EXPECT_EQ(layout.placed(1).label(), "") << "of a client";
}

TEST_F(PageSceneTest, AMeshIsSentOnceHoweverOftenItIsPlaced) {
  const auto snapshot = makeSnapshot(
      {instanceOf(1, small_), instanceOf(2, large_, Motion(at(0.5))), instanceOf(3, small_, Motion(at(0, 0, 3)))},
      "three");
  const auto messages = show(snapshot);
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[0].mesh().triangles().size(), 8u * 3 * sizeof(std::uint32_t));
  EXPECT_EQ(messages[1].mesh().triangles().size(), 200u * 3 * sizeof(std::uint32_t));
  const proto::SceneLayout& layout = messages[2].layout();
  EXPECT_EQ(layout.name(), "three");
  EXPECT_EQ(layout.proxy_radius(), kScale.radius_W);
  EXPECT_EQ(layout.world_per_device(), kScale.world_per_device);
  EXPECT_EQ(layout.bounds_max().z(), snapshot->bounds.max.z());
  ASSERT_EQ(layout.placed_size(), 3);
  EXPECT_EQ(layout.placed(0).mesh(), messages[0].mesh().number());
  EXPECT_EQ(layout.placed(1).mesh(), messages[1].mesh().number());
  EXPECT_EQ(layout.placed(2).mesh(), messages[0].mesh().number());
  EXPECT_EQ(layout.placed(1).object(), 20u);
  EXPECT_EQ(poseNumber(layout.poses(), 1, 3), 0.5f);
  EXPECT_EQ(poseNumber(layout.poses(), 2, 11), 3.0f);
  EXPECT_EQ(poseNumber(layout.poses(), 2, 10), 1.0f);
  EXPECT_EQ(stateAt(0).layout(), layout.number());
}

TEST_F(PageSceneTest, ASurfaceAtAnotherValueIsDrawnInFullWhenTheValueIsStill) {
  const auto trianglesOf = [](const proto::ServerMessage& message) {
    return message.mesh().triangles().size() / (3 * sizeof(std::uint32_t));
  };
  const std::shared_ptr<const Shape> first = largeBall(75), second = largeBall(74);
  const auto as_read = show(makeSnapshot({instanceOf(1, first)}));
  std::vector<Instance> instances{instanceOf(1, second)};
  instances[0].replaced_in = 2;
  const auto changed = makeSnapshot(instances);
  const auto soon = show(changed, 100 * kMs);
  EXPECT_LT(trianglesOf(soon[0]), trianglesOf(as_read[0]) / 2) << "it may change again at once";
  scene_.follow(changed, kScale, 100 * kMs + PageMeshes::kStill_ns - 1);
  EXPECT_TRUE(drain(page_).empty());

  const auto still = show(changed, 100 * kMs + PageMeshes::kStill_ns);
  ASSERT_GE(still.size(), 2U);
  EXPECT_GT(trianglesOf(still[0]), 9 * trianglesOf(as_read[0]) / 10);
  EXPECT_EQ(still[1].layout().placed(0).mesh(), still[0].mesh().number());
  scene_.follow(changed, kScale, 10'000 * kMs);
  EXPECT_TRUE(drain(page_).empty()) << "once";
}

TEST_F(PageSceneTest, ASecondPageGetsTheSameBytes) {
  show(makeSnapshot({instanceOf(1, small_)}));
  PageMemory first = scene_.open(), second = scene_.open();
  while (const PageMessage bytes = scene_.next(first)) EXPECT_EQ(scene_.next(second).get(), bytes.get());
  EXPECT_EQ(scene_.next(second), nullptr);
}

TEST_F(PageSceneTest, WhatMovesIsInTheStatesAndNoLayoutIsSent) {
  show(makeSnapshot({instanceOf(1, small_), instanceOf(2, small_)}));
  const Motion moving = Motion().then(at(2), 100 * kMs, 300 * kMs);
  const auto snapshot = makeSnapshot({instanceOf(1, small_), instanceOf(2, small_, moving)});
  for (std::int64_t t = 100; t < 900; t += 50) {
    scene_.follow(snapshot, kScale, t * kMs);
    EXPECT_TRUE(drain(page_).empty()) << t;
  }
  EXPECT_EQ(stateAt(100 * kMs).moved_size(), 0);
  for (const auto& [ms, x] : {std::pair{200, 1.0f}, {300, 2.0f}, {800, 2.0f}}) {
    const proto::State state = stateAt(ms * kMs);
    ASSERT_EQ(state.moved_size(), 1) << "where it has come to rest it is still elsewhere than in the layout";
    EXPECT_EQ(state.moved(0), 1u);
    EXPECT_NEAR(poseNumber(state.moved_poses(), 0, 3), x, 1e-6f);
  }
}

TEST_F(PageSceneTest, WhatHasComeToRestGetsANewLayoutAfterAWhile) {
  show(makeSnapshot({instanceOf(1, small_)}));
  const auto snapshot = makeSnapshot({instanceOf(1, small_, Motion().then(at(2), 0, 1500 * kMs))});
  scene_.follow(snapshot, kScale, 1200 * kMs);
  EXPECT_TRUE(drain(page_).empty()) << "still moving";
  scene_.follow(snapshot, kScale, 2400 * kMs);
  EXPECT_TRUE(drain(page_).empty()) << "it may move on with its client's next frame";
  scene_.follow(snapshot, kScale, 2500 * kMs);
  const auto messages = drain(page_);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(poseNumber(messages[0].layout().poses(), 0, 3), 2.0f);
  EXPECT_EQ(messages[0].layout().bounds_max().x(), snapshot->bounds.max.x());
  EXPECT_EQ(stateAt(2600 * kMs).moved_size(), 0);
  scene_.follow(snapshot, kScale, 9000 * kMs);
  EXPECT_TRUE(drain(page_).empty());
}

TEST_F(PageSceneTest, WhatJumpsIsThereAtOnceAndGetsALayoutOnceASecond) {
  show(makeSnapshot({instanceOf(1, small_)}));
  int layouts = 0;
  for (std::int64_t t = 0; t <= 3000; t += 20) {
    scene_.follow(makeSnapshot({instanceOf(1, small_, Motion(at(1 + static_cast<double>(t))))}), kScale, t * kMs);
    layouts += static_cast<int>(drain(page_).size());
    const proto::State state = stateAt(t * kMs);
    EXPECT_EQ(state.moved_size(), layouts > 0 && t % 1000 == 0 ? 0 : 1) << t;
  }
  EXPECT_EQ(layouts, 3);
}

TEST_F(PageSceneTest, ALayoutComesWhenSomethingComesOrIsRenamedOrScaled) {
  show(makeSnapshot({instanceOf(1, small_)}));
  const auto more = makeSnapshot({instanceOf(1, small_), instanceOf(4, small_)});
  EXPECT_EQ(show(more).size(), 1u);
  scene_.follow(more, {kScale.radius_W, 3}, 0);
  EXPECT_EQ(drain(page_).at(0).layout().world_per_device(), 3);
  EXPECT_EQ(show(makeSnapshot({instanceOf(1, small_), instanceOf(4, small_)}, "other")).at(0).layout().name(), "other");
}

TEST_F(PageSceneTest, MeshesThatAreGoneMayBeForgottenAndComeBackUnderANewNumber) {
  const auto both = makeSnapshot({instanceOf(1, small_), instanceOf(2, large_)});
  const auto first = show(both);
  const auto without = show(makeSnapshot({instanceOf(1, small_)}));
  ASSERT_EQ(without.size(), 2u);
  EXPECT_EQ(without[0].layout().placed_size(), 1);
  ASSERT_EQ(without[1].forget().meshes_size(), 1);
  EXPECT_EQ(without[1].forget().meshes(0), first[1].mesh().number());
  const auto again = show(makeSnapshot({instanceOf(1, small_), instanceOf(2, large_)}));
  ASSERT_EQ(again.size(), 2u);
  EXPECT_GT(again[0].mesh().number(), first[1].mesh().number());
}

TEST_F(PageSceneTest, APageThatReadsSlowlyGetsOnlyTheNewest) {
  PageMemory slow = scene_.open();
  for (std::uint64_t count = 1; count <= 5; ++count) {
    std::vector<Instance> instances;
    for (std::uint64_t key = 1; key <= count; ++key) instances.push_back(instanceOf(key, small_));
    show(makeSnapshot(std::move(instances)));
  }
  const auto messages = drain(slow);
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[1].layout().placed_size(), 5);
}

/// A block of 100 g that started at x = 0.1 m, on a slider to the world.
std::shared_ptr<const Snapshot> withBody(const Instance& instance, double gravity_m_s2, double low) {
  BodySpec spec;
  spec.mass_kg = 0.1;
  spec.shape = BodyShape::kBox;
  Instance block = instance;
  setBody(block, makeRigidBody("block", spec, at(0.1), Box{{0, 0, 0}, {1, 1, 1}}, Box{{-9, -9, -9}, {9, 9, 9}}));
  Mechanics mechanics;
  mechanics.gravity_m_s2 = {0, 0, gravity_m_s2};
  mechanics.joints.push_back({"rail", JointKind::kSlider, block.key, 0, {0.1, 0, 0}, {}, {1, 0, 0}, {}});
  mechanics.joints.front().along.low = low;
  return makeSnapshot({block}, {}, 1, 0, mechanics);
}

TEST_F(PageSceneTest, BodiesAndJointsAreInTheLayoutAsTheSceneHasThem) {
  const auto messages = show(withBody(instanceOf(4, small_), -3, -0.5));
  const proto::SceneLayout& layout = messages.back().layout();
  EXPECT_EQ(layout.gravity_m_s2().z(), -3);
  EXPECT_EQ(layout.placed(0).body().mass_kg(), 0.1);
  EXPECT_FALSE(layout.placed(0).body().has_density_kg_m3()) << "it has no effect beside the mass";
  EXPECT_EQ(layout.placed(0).body().shape(), proto::BOX);
  EXPECT_EQ(poseNumber(layout.placed(0).start(), 0, 3), 0.1f);
  ASSERT_EQ(layout.joints_size(), 1);
  EXPECT_EQ(layout.joints(0).joint().kind(), proto::SLIDER);
  EXPECT_EQ(layout.joints(0).joint().low(), -0.5);
  EXPECT_FALSE(layout.joints(0).joint().has_high());
  EXPECT_EQ(layout.joints(0).body_a(), 0u);
  EXPECT_FALSE(layout.joints(0).has_body_b());
}

TEST_F(PageSceneTest, OtherGravityAndJointsGetALayoutOnceASecond) {
  show(withBody(instanceOf(4, small_), -3, -0.5));
  const Instance same = instanceOf(4, small_);
  const auto lighter = withBody(same, -1, -0.5);
  scene_.follow(lighter, kScale, 500 * kMs);
  EXPECT_TRUE(drain(page_).empty());
  scene_.follow(lighter, kScale, 1000 * kMs);
  EXPECT_EQ(drain(page_).at(0).layout().gravity_m_s2().z(), -1);
  scene_.follow(withBody(same, -1, -0.5), kScale, 3000 * kMs);
  EXPECT_TRUE(drain(page_).empty()) << "the same in another snapshot";
  scene_.follow(withBody(same, -1, -0.2), kScale, 3100 * kMs);
  EXPECT_EQ(drain(page_).at(0).layout().joints(0).joint().low(), -0.2);
}

/// With two snaps, a point and a plane, and a push.
Instance withPlaces(Instance instance, double release_N) {
  const SnapSpec socket{"socket", {{0, 0, 1}}, std::nullopt, 0.002, release_N};
  const SnapSpec sheet{"sheet", {{1, 0, 0}}, Vec3::UnitX(), 0.001, 1};
  FieldSpec wind{"wind", FieldKind::kConstant, {{0, 1, 0}, {0, 2, 0}}, std::nullopt, 0.03, 1.5};
  wind.direction = Vec3::UnitZ();
  instance.snaps = std::make_shared<const SnapList>(SnapList{socket, sheet});
  instance.fields = std::make_shared<const FieldList>(FieldList{wind});
  return instance;
}

TEST_F(PageSceneTest, SnapsAndFieldsAreInTheLayoutAsTheSceneHasThem) {
  const auto messages = show(makeSnapshot({instanceOf(4, small_), withPlaces(instanceOf(5, small_), 3)}));
  const proto::SceneLayout& layout = messages.back().layout();
  ASSERT_EQ(layout.snaps_size(), 2);
  const proto::Snap& socket = layout.snaps(0).snap();
  EXPECT_EQ(socket.name(), "socket");
  EXPECT_EQ(std::vector<double>(socket.points().begin(), socket.points().end()), (std::vector<double>{0, 0, 1}));
  EXPECT_FALSE(socket.has_normal());
  EXPECT_EQ(socket.capture(), 0.002);
  EXPECT_EQ(socket.release_n(), 3);
  EXPECT_EQ(layout.snaps(1).snap().normal().x(), 1);
  EXPECT_EQ(layout.snaps(1).placed(), 1u);
  ASSERT_EQ(layout.fields_size(), 1);
  const proto::Field& wind = layout.fields(0).field();
  EXPECT_EQ(wind.kind(), proto::CONSTANT);
  EXPECT_EQ(wind.points_size(), 6);
  EXPECT_EQ(wind.reach(), 0.03);
  EXPECT_EQ(wind.force_n(), 1.5);
  EXPECT_EQ(wind.direction().z(), 1);
  EXPECT_EQ(layout.fields(0).placed(), 1u);
}

TEST_F(PageSceneTest, TheSnapThatHoldsIsInTheState) {
  show(makeSnapshot({withPlaces(instanceOf(4, small_), 3), withPlaces(instanceOf(5, small_), 3)}));
  EXPECT_EQ(stateAt(0, {}, {{5, 1, 50, 0}, 1}).snap(), 3u);
  EXPECT_FALSE(stateAt(0).has_snap());
  EXPECT_FALSE(stateAt(0, {}, {{5, 1, 50, 0}, 2}).has_snap()) << "a snap that the layout does not have";
  EXPECT_FALSE(stateAt(0, {}, {{6, 1, 60, 0}, 0}).has_snap()) << "an object that the layout does not have";
}

TEST_F(PageSceneTest, OtherSnapsGetALayoutOnceASecond) {
  const Instance bare = instanceOf(4, small_);
  show(makeSnapshot({withPlaces(bare, 3)}));
  scene_.follow(makeSnapshot({withPlaces(bare, 2)}), kScale, 500 * kMs);
  EXPECT_TRUE(drain(page_).empty());
  scene_.follow(makeSnapshot({withPlaces(bare, 2)}), kScale, 1000 * kMs);
  EXPECT_EQ(drain(page_).at(0).layout().snaps(0).snap().release_n(), 2);
  scene_.follow(makeSnapshot({withPlaces(bare, 2)}), kScale, 3000 * kMs);
  EXPECT_TRUE(drain(page_).empty()) << "the same in another snapshot";
}

TEST_F(PageSceneTest, AnEmptySceneIsALayoutWithNothingInIt) {
  const auto messages = show(makeSnapshot(std::vector<Instance>{}));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].layout().placed_size(), 0);
  EXPECT_FALSE(messages[0].layout().has_bounds_min());
}

TEST_F(PageSceneTest, WhatIsTouchedIsReported) {
  show(makeSnapshot({instanceOf(3, small_), instanceOf(7, small_)}));
  const proto::State state = stateAt(0, {{7, 1, 70, 0}, {5, 1, 50, 0}, {7, 1, 70, 0}});
  ASSERT_EQ(state.touched_size(), 1) << "once each, and only what is in the layout";
  EXPECT_EQ(state.touched(0), 1u);
}

TEST_F(PageSceneTest, TheSameShapeWithAnotherTextureIsAnotherMesh) {
  Model model = makeBuiltinScene("plane:8");
  model.texcoords.assign(model.positions.size(), Vec2::Zero());
  const auto shape = makeShape(std::move(model), HierarchyKind::kNone);
  const auto look = [&](const char* kind) {
    auto surfaces = std::make_shared<Surfaces>();
    surfaces->materials.resize(shape->model.materials.size());
    surfaces->materials[0].textureOf(Quantity::kHeight) = {0, 0, 0.001};
    surfaces->textures.push_back(std::make_shared<const Texture>(makeTexture(kind, 4)));
    return surfaces;
  };
  std::vector<Instance> instances{instanceOf(1, shape), instanceOf(2, shape), instanceOf(3, shape),
                                  instanceOf(4, shape)};
  instances[0].surfaces = look("checker");
  instances[1].surfaces = look("sine");
  instances[2].surfaces = std::make_shared<const Surfaces>(*instances[1].surfaces);
  const auto messages = show(makeSnapshot(std::move(instances)));
  ASSERT_EQ(messages.size(), 4u) << "checker, sine, plain and the layout";
  const proto::SceneLayout& layout = messages[3].layout();
  EXPECT_NE(layout.placed(0).mesh(), layout.placed(1).mesh());
  EXPECT_EQ(layout.placed(1).mesh(), layout.placed(2).mesh());
  EXPECT_NE(layout.placed(0).mesh(), layout.placed(3).mesh());
}

TEST_F(PageSceneTest, MaterialsAreSentByNumberAndAgainWhenTheyChange) {
  Model model = makeBuiltinScene("plane:8");
  model.materials.resize(2);
  model.materials[1].static_friction = 0.5;
  model.triangle_materials.assign(8, 1);
  const auto shape = makeShape(model, HierarchyKind::kNone);
  const auto messages = show(makeSnapshot({instanceOf(1, shape)}));
  EXPECT_EQ(messages[0].mesh().triangle_materials().size(), 8u * sizeof(std::uint16_t));
  const proto::PlacedMesh& placed = messages[1].layout().placed(0);
  ASSERT_EQ(placed.materials_size(), 2);
  EXPECT_EQ(placed.materials(0).static_friction(), 0);
  EXPECT_EQ(placed.materials(1).static_friction(), 0.5);
  EXPECT_EQ(placed.materials(1).stiffness(), 1);

  auto surfaces = std::make_shared<Surfaces>(*surfacesOf(shape));
  surfaces->materials[1].stiffness = 0.25;
  Instance other = instanceOf(1, shape);
  other.surfaces = surfaces;
  const auto changed = show(makeSnapshot({other}));
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].layout().placed(0).materials(1).stiffness(), 0.25);
}

TEST_F(PageSceneTest, NothingIsKeptWhileNobodyLooks) {
  const std::weak_ptr<const Shape> watched = [&] {
    const auto shape = plane(50);
    show(makeSnapshot({instanceOf(1, shape)}));
    return shape;
  }();
  EXPECT_FALSE(watched.expired());
  page_ = {};
  scene_.follow(makeSnapshot({instanceOf(1, small_)}), kScale, 0);
  EXPECT_EQ(stateAt(0).layout(), 0u);
  while (!watched.expired()) std::this_thread::yield();  // the thread that made its message may hold it a moment longer
  page_ = scene_.open();
  EXPECT_EQ(show(makeSnapshot({instanceOf(1, small_)})).size(), 2u);
}

TEST_F(PageSceneTest, ASceneWithANewMeshInEveryFrameIsShown) {
  int shown = 0;
  for (int i = 0; i < 2000 && shown < 3; ++i) {
    scene_.follow(makeSnapshot({instanceOf(1, plane(8))}), kScale, i * kMs);
    for (const proto::ServerMessage& message : drain(page_)) shown += message.has_layout() ? 1 : 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(shown, 3);
}

// A page without a mesh gets the reason, sees the rest, and goes on with the next scene.
TEST(PageSceneMemory, AMeshThatDoesNotFitIsReportedAndTheRestIsShown) {
  const MemoryBudget budget(10'000);
  PageScene scene(budget);
  PageMemory page = scene.open();
  const auto small = plane(8), large = plane(2000);
  const auto drained = [&] {
    std::vector<proto::ServerMessage> messages;
    while (const PageMessage bytes = scene.next(page)) EXPECT_TRUE(messages.emplace_back().ParseFromString(*bytes));
    return messages;
  };
  const auto show = [&](const std::shared_ptr<const Snapshot>& snapshot) {
    while (true) {
      scene.follow(snapshot, kScale, 0);
      if (auto messages = drained(); !messages.empty()) return messages;
      std::this_thread::yield();
    }
  };
  const auto messages = show(makeSnapshot({instanceOf(1, large), instanceOf(2, small)}));
  ASSERT_EQ(messages.size(), 4u);
  EXPECT_EQ(messages[0].mesh().triangles().size(), 0u);
  EXPECT_EQ(messages[1].mesh().triangles().size(), 8u * 3 * sizeof(std::uint32_t));
  EXPECT_EQ(messages[2].layout().placed_size(), 2);
  EXPECT_EQ(messages[3].notice().text().find("a mesh can be touched but is not shown: there is no room"), 0u)
      << messages[3].notice().text();
  EXPECT_GT(budget.used_bytes(), 0u);
  EXPECT_EQ(show(makeSnapshot({instanceOf(2, small)})).front().layout().placed_size(), 1);
  page = {};
  scene.follow(nullptr, kScale, 0);
  EXPECT_EQ(budget.used_bytes(), 0u) << "nobody looks";
}

// Protobuf writes no message of 2 GB.
TEST(PageMeshes, AMeshBeyondTheLargestMessageIsReportedNotSentEmpty) {
  PageMeshes meshes({}, 5000);
  const auto snapshot = makeSnapshot({instanceOf(1, plane(8)), instanceOf(2, plane(2000))});
  const std::vector<std::uint32_t> numbers = meshes.numbersOf(*snapshot, 0);
  while (!meshes.ready()) std::this_thread::yield();
  proto::ServerMessage small, large;
  ASSERT_TRUE(small.ParseFromString(*meshes.message(numbers[0])));
  ASSERT_TRUE(large.ParseFromString(*meshes.message(numbers[1])));
  EXPECT_GT(small.mesh().triangles().size(), 0u);
  EXPECT_EQ(large.mesh().number(), numbers[1]);
  EXPECT_NE(meshes.lacking().find("several objects"), std::string::npos) << meshes.lacking();
  meshes.keep({numbers[0]});
  EXPECT_EQ(meshes.lacking(), "");
}

}  // namespace
}  // namespace hl::test_page_scene

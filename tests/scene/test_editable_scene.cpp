// Hierarchies of objects, flattened; edits that happen as a whole or not at all; and motion from frame to frame.
#include "scene/editable_scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/error.h"
#include "geometry/scenes.h"
#include "scene/by_key.h"
#include "scene/follow_on.h"
#include "surfaces/depth_frame.h"
#include "surfaces/iso_surface.h"

namespace hl::test_editable_scene {
namespace {

std::shared_ptr<const Shape> triangle(double size = 1) {
  Model model;
  model.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
  model.normals = {{0, 0, 1}, {0, 0, 1}, {0.6, 0, 0.8}};
  model.triangles = {{0, 1, 2}};
  return makeShape(std::move(model), HierarchyKind::kBvh);
}

std::shared_ptr<SceneItems> listOf(SceneItems items) { return std::make_shared<SceneItems>(std::move(items)); }

std::shared_ptr<const SurfaceChange> changeOf(const std::function<void(SurfaceChange&)>& set) {
  auto change = std::make_shared<SurfaceChange>();
  set(*change);
  return change;
}

SceneItem shapeItem(std::shared_ptr<const Shape> shape, const Placement& placement = {}) {
  SceneItem item;
  item.shape = std::move(shape);
  item.placement = std::make_shared<const Placement>(placement);
  return item;
}

SceneItem callItem(std::uint32_t id, const Placement& placement = {}) {
  SceneItem item;
  item.call = id;
  item.placement = std::make_shared<const Placement>(placement);
  return item;
}

Placement turn(double angle, const Vec3& offset) {
  return {Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(), offset};
}

SceneEdit worldOf(SceneItems items) {
  SceneEdit edit;
  edit.world = listOf(std::move(items));
  return edit;
}

// Every vertex of the world, in the order of the keys.
std::vector<Vec3> verticesOf(const EditableScene& scene) {
  const Followed all = followOn(scene.placed(), {}, 0, 0);
  std::vector<Vec3> vertices;
  for (const Instance& instance : all.instances) {
    for (const Vec3& p : instance.shape->model.positions) vertices.push_back(instance.motion.to().toWorld(p));
  }
  return vertices;
}

TEST(EditableScene, CallsMultiplyTheirMatricesLikeGl) {
  EditableScene scene(1, {});
  const Placement arm = turn(0.3, {1, 2, 3}), hand = turn(-0.7, {0, 1, 0}),
                  finger{Mat3(2 * Mat3::Identity()), {0, 0, 1}};
  SceneEdit edit = worldOf({callItem(1, arm)});
  edit.objects[1] = listOf({callItem(2, hand)});
  edit.objects[2] = listOf({shapeItem(triangle(), finger)});
  scene.apply(edit);
  const Placement whole = arm * hand * finger;
  const std::vector<Vec3> vertices = verticesOf(scene);
  ASSERT_EQ(vertices.size(), 3u);
  const std::array<Vec3, 3> given{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((vertices[i] - (whole.linear * given[i] + whole.offset)).norm(), 1e-10);
  EXPECT_EQ(scene.placed()[0].object, 2u);
}

TEST(EditableScene, AnyInvertibleMatrixIsARigidPoseOfAStretchedShape) {
  test::Random random(3);
  for (int i = 0; i < 200; ++i) {
    Mat3 linear;
    for (int column = 0; column < 3; ++column) linear.col(column) = random.inCube(2);
    if (std::abs(linear.determinant()) < 1e-3) continue;
    EditableScene scene(1, {});
    scene.apply(worldOf({shapeItem(triangle(), {linear, {1, 2, 3}})}));
    const PlacedShape& placed = scene.placed()[0];
    EXPECT_NEAR(placed.pose.rotation.determinant(), 1, 1e-12);
    EXPECT_LT((placed.pose.rotation * placed.pose.rotation.transpose() - Mat3::Identity()).norm(), 1e-12);
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3 expected = linear * triangle()->model.positions[v] + Vec3(1, 2, 3);
      EXPECT_LT((placed.pose.toWorld(placed.shape->model.positions[v]) - expected).norm(), 1e-9 * linear.norm());
      const Vec3 normal = (linear.inverse().transpose() * triangle()->model.normals[v]).normalized();
      EXPECT_LT((placed.pose.turnToWorld(placed.shape->model.normals[v]) - normal).norm(), 1e-6);
    }
  }
}

// Bodies take their boxes, balls and capsules from the bounds: those of a mirrored object are as large.
TEST(EditableScene, AScaleAlongTheAxesKeepsThemHoweverItIsTurnedAndMirrored) {
  test::Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Placement turned = turn(3 * random.inCube(1).x(), random.inCube(1));
    const Vec3 scale = i % 2 == 0 ? Vec3(1, 1, 1) : Vec3(Vec3(0.3, 0.4, 0.5) + 0.2 * random.inCube(1));
    const double handed = (i / 2) % 2 == 0 ? -1 : 1;
    EditableScene scene(1, {});
    scene.apply(worldOf({shapeItem(
        triangle(), {turned.linear * Vec3(handed * scale.x(), scale.y(), scale.z()).asDiagonal(), {1, 2, 3}})}));
    const PlacedShape& placed = scene.placed()[0];
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3 expected = handed * scale.cwiseProduct(triangle()->model.positions[v]);
      EXPECT_LT((placed.shape->model.positions[v] - expected).norm(), 1e-9) << i;
    }
  }
}

TEST(EditableScene, RefusesWhatLiesTooFarToBeTouched) {
  EditableScene scene(1, {});
  scene.apply(worldOf({shapeItem(triangle(), {Mat3::Identity(), {0, 1e9 - 1, 0}})}));
  const Pose before = scene.placed()[0].pose;
  const double most = std::numeric_limits<double>::max();
  for (const Vec3& offset : {Vec3(0, 1e9, 0), Vec3(0, 0, -2e9), Vec3(most, -most, 0)}) {
    const Placement far{Mat3::Identity(), offset};
    EXPECT_THROW(scene.apply(worldOf({shapeItem(triangle(), far)})), Error) << offset.transpose();
    EXPECT_THROW(scene.apply(worldOf({shapeItem(triangle(), far * far)})), Error) << offset.transpose();
  }
  const Placement huge{Mat3(1e300 * Mat3::Identity()), {1, 0, 0}};
  EXPECT_THROW(scene.apply(worldOf({shapeItem(triangle(), huge * huge)})), Error);
  EXPECT_EQ(scene.placed()[0].pose, before);
  scene.apply(worldOf({shapeItem(triangle(), huge)}));  // its triangles are left out, as those of a file are
  EXPECT_EQ(scene.primitives(), 0u);
}

TEST(EditableScene, RigidCallsShareOneShapeAndScaledOnesAnother) {
  EditableScene scene(1, {});
  const auto shape = triangle();
  SceneEdit edit;
  edit.objects[1] = listOf({shapeItem(shape)});
  const Placement twice{Mat3(2 * Mat3::Identity()), Vec3::Zero()};
  edit.world = listOf({callItem(1, turn(0.1, Vec3::Zero())), callItem(1, turn(0.2, {1, 0, 0})),
                       callItem(1, turn(0.3, Vec3::Zero()) * twice), callItem(1, turn(0.4, Vec3::Zero()) * twice)});
  scene.apply(edit);
  EXPECT_EQ(scene.placed()[0].shape, shape);
  EXPECT_EQ(scene.placed()[1].shape, shape);
  EXPECT_NE(scene.placed()[2].shape, shape);
  EXPECT_EQ(scene.placed()[2].shape, scene.placed()[3].shape);
  EXPECT_EQ(scene.placed()[0].surfaces, scene.placed()[3].surfaces) << "all feel the same";
  const auto scaled = scene.placed()[2].shape;
  edit.world->at(2).placement = std::make_shared<const Placement>(turn(0.9, Vec3::Zero()) * twice);
  scene.apply(worldOf(*edit.world));
  EXPECT_EQ(scene.placed()[2].shape, scaled) << "turned, not built again";
}

TEST(EditableScene, AScaledCopyIsRefittedFromTheOneBefore) {
  EditableScene scene(1, {});
  const Placement twice{Mat3(2 * Mat3::Identity()), Vec3::Zero()};
  const auto first = triangle();
  scene.apply(worldOf({shapeItem(first, twice)}));
  const auto copy = scene.placed()[0].shape;
  EXPECT_EQ(copy->before, first->geometry);
  Model moved = first->model;
  moved.positions[1] = {3, 0, 1};
  EXPECT_EQ(scene.items(0)->at(0).shape, first);
  const auto second = makeShape(std::move(moved), *first);
  scene.apply(worldOf({shapeItem(second, twice)}));
  EXPECT_EQ(scene.placed()[0].shape->before, copy->geometry);
  EXPECT_EQ(scene.placed()[0].shape->model.positions[1], Vec3(6, 0, 2));
}

TEST(EditableScene, ARebuiltShapeTakesThePlaceOfTheWornOneAndNothingIsAbrupt) {
  EditableScene scene(1, {});
  test::Random random(4);
  Model model;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    model.positions.emplace_back(i, 0, 0);
    model.points.push_back(i);
  }
  const auto row = makeShape(Model(model));
  for (Vec3& p : model.positions) p = random.inCube(1);
  const auto cloud = makeShape(std::move(model), *row);
  const Placement twice{Mat3(2 * Mat3::Identity()), Vec3::Zero()};
  SceneEdit edit = worldOf({callItem(1), callItem(1, twice), shapeItem(cloud, turn(1, {5, 0, 0}))});
  edit.objects[1] = listOf({shapeItem(cloud)});
  scene.apply(edit);
  const std::vector<PlacedShape> before = scene.placed();
  const Followed shown = followOn(before, {}, 0, 0);
  for (int rebuilds = 0; rebuilds < 2; ++rebuilds) {
    const auto worn = scene.toRebuild();
    ASSERT_TRUE(worn);
    EditableScene::Next next = scene.prepareReplaced(worn, rebuilt(*worn));
    scene.show(next);
  }
  EXPECT_FALSE(scene.toRebuild());
  EXPECT_EQ(followOn(scene.placed(), pointersByKey(shown.instances), 0, 0).blend_ns, 0);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NE(scene.placed()[i].shape, before[i].shape);
    EXPECT_EQ(scene.placed()[i].shape->model.positions, before[i].shape->model.positions);
  }
  EXPECT_EQ(scene.items(0)->at(2).shape->cost_ratio, 1);
  EXPECT_EQ(scene.items(1)->at(0).shape, scene.items(0)->at(2).shape);
  scene.apply(worldOf({callItem(1), callItem(1, twice)}));
  EXPECT_EQ(scene.placed()[1].shape->cost_ratio, 1) << "the scaled copy is the rebuilt one still";
  EXPECT_EQ(scene.items(2), nullptr);
}

TEST(EditableScene, WhatAnItemLeavesOutItTakesFromItsCallers) {
  EditableScene scene(1, {});
  SceneItem inner = shapeItem(triangle());
  inner.surface = changeOf([](SurfaceChange& s) { s.dynamic_friction = 0.2; });
  SceneItem call = callItem(1);
  call.surface = changeOf([](SurfaceChange& s) {
    s.dynamic_friction = 0.9;
    s.stiffness = 0.5;
    s.smooth = false;
  });
  call.name = 7;
  SceneEdit edit = worldOf({call, callItem(1)});
  edit.objects[1] = listOf({inner});
  scene.apply(edit);
  const Material& first = scene.placed()[0].surfaces->materials[0];
  EXPECT_EQ(first.dynamic_friction, 0.2);
  EXPECT_EQ(first.stiffness, 0.5);
  EXPECT_FALSE(first.smooth);
  EXPECT_EQ(scene.placed()[0].name, 7u);
  const Material& second = scene.placed()[1].surfaces->materials[0];
  EXPECT_EQ(second.stiffness, 1);
  EXPECT_TRUE(second.smooth);
  EXPECT_EQ(scene.placed()[1].name, 0u);
}

TEST(EditableScene, TexturesAreFoundByNameAndMayBeOverwritten) {
  EditableScene scene(1, {});
  const auto texture = [](float value) {
    auto t = std::make_shared<Texture>();
    t->width = t->height = 1;
    t->texels = {value};
    return t;
  };
  SceneItem item = shapeItem(triangle());
  item.surface = changeOf([](SurfaceChange& s) { s.textures[0] = NamedTextureUse{"rough", 0.1, 0.9}; });
  SceneEdit edit = worldOf({item});
  EXPECT_THROW(scene.apply(edit), Error) << "there is no such texture";
  edit.textures["rough"] = texture(0.25f);
  scene.apply(edit);
  EXPECT_EQ(scene.placed()[0].surfaces->textures[0]->texels[0], 0.25f);
  EXPECT_EQ(scene.placed()[0].surfaces->materials[0].textures[0].high, 0.9);
  SceneEdit overwrite;
  overwrite.textures["rough"] = texture(0.75f);
  scene.apply(overwrite);
  EXPECT_EQ(scene.placed()[0].surfaces->textures[0]->texels[0], 0.75f);
  item.surface = changeOf([](SurfaceChange& s) { s.untextured = true; });
  SceneItem call = callItem(1);
  call.surface = changeOf([](SurfaceChange& s) { s.textures[0] = NamedTextureUse{"rough", 0, 1}; });
  SceneEdit bare = worldOf({call});
  bare.objects[1] = listOf({item});
  scene.apply(bare);
  EXPECT_TRUE(scene.placed()[0].surfaces->textures.empty());
}

TEST(EditableScene, CirclesAreRefusedAndChangeNothing) {
  EditableScene scene(1, {});
  SceneEdit edit = worldOf({callItem(1)});
  edit.objects[1] = listOf({shapeItem(triangle())});
  scene.apply(edit);
  SceneEdit circle;
  circle.objects[1] = listOf({shapeItem(triangle()), callItem(2)});
  circle.objects[2] = listOf({callItem(1)});
  EXPECT_THROW(scene.apply(circle), Error);
  EXPECT_EQ(scene.placed().size(), 1u);
  scene.apply(worldOf({callItem(1), callItem(2)}));
  EXPECT_EQ(scene.placed().size(), 1u) << "object 2 was never defined";
}

TEST(EditableScene, LimitsHoldAndAHierarchyCannotExplode) {
  SceneLimits limits;
  limits.objects = 40;
  limits.scene_bytes = 3 * bytesToMake(triangle()->model);
  limits.instances = 10;
  limits.nesting = 5;
  EditableScene scene(1, limits);
  SceneEdit deep = worldOf({callItem(1)});
  for (std::uint32_t i = 1; i < 8; ++i) deep.objects[i] = listOf({callItem(i + 1)});
  EXPECT_THROW(scene.apply(deep), Error);
  SceneEdit wide = worldOf({callItem(1)});
  for (std::uint32_t i = 1; i < 5; ++i) wide.objects[i] = listOf(SceneItems(100, callItem(i + 1)));  // 1e8 visits
  EXPECT_THROW(scene.apply(wide), Error);
  EXPECT_THROW(scene.apply(worldOf(SceneItems(11, shapeItem(triangle())))), Error);
  EXPECT_THROW(scene.apply(worldOf(
                   {shapeItem(triangle()), shapeItem(triangle()), shapeItem(triangle()), shapeItem(triangle())})),
               Error);
  SceneEdit many;
  for (std::uint32_t i = 1; i <= 41; ++i) many.objects[i] = listOf({});
  EXPECT_THROW(scene.apply(many), Error);
  EXPECT_THROW(scene.apply(worldOf({shapeItem(triangle(), {Vec3(1, 1, 0).asDiagonal(), Vec3::Zero()})})), Error);
  EXPECT_TRUE(scene.placed().empty());
}

// Sixteen numbers of a matrix make a copy of a mesh of any size.
TEST(EditableScene, ScaledCopiesAreLimited) {
  SceneLimits limits;
  limits.scene_bytes = 3 * bytesToMake(triangle()->model);
  EditableScene scene(1, limits);
  SceneEdit edit = worldOf({});
  edit.objects[1] = listOf({shapeItem(triangle())});
  for (int i = 2; i <= 4; ++i) edit.world->push_back(callItem(1, {Mat3(i * Mat3::Identity()), Vec3::Zero()}));
  for (int i = 0; i < 5; ++i) edit.world->push_back(callItem(1, turn(0.1 * i, {1, 0, 0})));  // these share the mesh
  scene.apply(edit);
  EXPECT_EQ(scene.placed().size(), 8u);
  scene.apply(edit);
  edit.world->push_back(callItem(1, {Mat3(5 * Mat3::Identity()), Vec3::Zero()}));
  EXPECT_THROW(scene.apply(edit), Error);
}

TEST(EditableScene, DeletedObjectsAreGoneAndOverwrittenOnesChange) {
  EditableScene scene(1, {});
  SceneEdit edit = worldOf({callItem(1), callItem(2)});
  edit.objects[1] = listOf({shapeItem(triangle())});
  edit.objects[2] = listOf({shapeItem(triangle())});
  scene.apply(edit);
  EXPECT_EQ(scene.placed().size(), 2u);
  SceneEdit change;
  change.deleted_objects = {1};
  change.objects[2] = listOf({shapeItem(triangle(5))});
  scene.apply(change);
  ASSERT_EQ(scene.placed().size(), 1u);
  EXPECT_EQ(scene.placed()[0].shape->extent, 5);
}

TEST(EditableScene, KeysStayFromFrameToFrameAndDifferBetweenSessions) {
  EditableScene a(1, {}), b(2, {});
  const auto frame = [](double x) {
    SceneEdit edit = worldOf({callItem(1), callItem(1, turn(0, {x, 0, 0})), shapeItem(triangle())});
    edit.objects[1] = listOf({shapeItem(triangle()), shapeItem(triangle())});
    return edit;
  };
  a.apply(frame(0));
  b.apply(frame(0));
  const std::vector<PlacedShape> before = a.placed();
  a.apply(frame(1));
  ASSERT_EQ(before.size(), 5u);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(a.placed()[i].key, before[i].key);
    EXPECT_NE(b.placed()[i].key, before[i].key);
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(before[i].key, before[k].key);
  }
}

SceneItem depthItem(float depth) {
  const auto depths = std::make_shared<const std::vector<float>>(4, depth);
  const auto grid = std::make_shared<const HeightGrid>(GridSize{2, 2, SampleKind::kFloat32},
                                                       std::shared_ptr<const void>(depths, depths->data()));
  const auto image = smoothed(*grid, 1, DepthCamera{10, 10, 0.5, 0.5}, nullptr, 0);
  return shapeItem(makeShape(std::make_shared<const DepthFrame>(image, cameraFrame(1))));
}

// What is no mesh has no transition: it is noted in which snapshot it came in the place of another.
TEST(FollowOn, AnotherImageOfACameraIsThereAtOnce) {
  EditableScene scene(1, {});
  const auto show = [&](float depth) {
    SceneEdit edit = worldOf({callItem(1)});
    edit.objects[1] = listOf({depthItem(depth)});
    scene.apply(edit);
  };
  show(1);
  const Followed first = followOn(scene.placed(), {}, 100, 200, {}, {}, 7);
  EXPECT_EQ(first.instances[0].replaced_in, 0U) << "nothing was there";
  show(1.01F);
  const Followed second = followOn(scene.placed(), pointersByKey(first.instances), 300, 400, {}, {}, 8);
  EXPECT_EQ(second.instances[0].replaced_in, 8U);
  const Followed third = followOn(scene.placed(), pointersByKey(second.instances), 500, 600, {}, {}, 9);
  EXPECT_EQ(third.instances[0].replaced_in, 8U) << "the same one";
}

// Values 0 to 1, 2 samples along each side.
SceneItem isoItem(double iso) {
  const auto values = std::make_shared<const std::vector<float>>(std::vector<float>{0, 1, 0, 1, 0, 1, 0, 1});
  const auto volume = std::make_shared<const Volume>(
      VoxelGrid({2, 2, 2}, Samples(SampleKind::kFloat32, std::shared_ptr<const void>(values, values->data()))));
  return shapeItem(makeShape(std::make_shared<const IsoSurface>(volume, GridFrame{}, IsoValue{iso, {}})));
}

// It is no fault of the frame: nothing is there, until a value comes that the volume has.
TEST(FollowOn, ASurfaceMayBeNowhere) {
  for (const SceneItem& nowhere : {isoItem(2), isoItem(-1)}) {
    EditableScene scene(1, {});
    const auto show = [&](const SceneItem& item) {
      SceneEdit edit = worldOf({callItem(1, turn(0.5, {1, 0, 0}))});
      edit.objects[1] = listOf({item, shapeItem(triangle())});
      scene.apply(edit);
      return makeSnapshot(followOn(scene.placed(), {}, 0, 0).instances);
    };
    const auto alone = show(shapeItem(triangle())), empty = show(nowhere);
    ASSERT_EQ(empty->instances.size(), 2U);
    EXPECT_EQ(empty->bounds.min, alone->bounds.min);
    EXPECT_EQ(empty->bounds.max, alone->bounds.max);
    EXPECT_EQ(show(isoItem(0.5))->instances[0].key, empty->instances[0].key) << "it is the same object";
  }
}

TEST(FollowOn, KnownObjectsMoveAndNewOnesAreThere) {
  EditableScene scene(1, {});
  SceneEdit edit = worldOf({callItem(1)});
  edit.objects[1] = listOf({shapeItem(triangle())});
  scene.apply(edit);
  const Followed first = followOn(scene.placed(), {}, 100, 200);
  EXPECT_EQ(first.blend_ns, kAbruptBlend_ns);
  EXPECT_FALSE(first.instances[0].motion.moves());
  scene.apply(worldOf({callItem(1, turn(0.5, {1, 0, 0}))}));
  const Followed second = followOn(scene.placed(), pointersByKey(first.instances), 300, 400);
  EXPECT_EQ(second.blend_ns, 0);
  EXPECT_TRUE(second.instances[0].motion.moves());
  EXPECT_TRUE(second.instances[0].motion.at(300) == Pose{});
  const Followed halfway = followOn(scene.placed(), pointersByKey(second.instances), 350, 450);
  EXPECT_TRUE(halfway.instances[0].motion.at(375) == second.instances[0].motion.at(375)) << "goes on as it was";
  const Followed later = followOn(scene.placed(), pointersByKey(halfway.instances), 1000, 1100);
  EXPECT_FALSE(later.instances[0].motion.moves());
  EXPECT_EQ(later.blend_ns, 0);
  scene.apply(worldOf({callItem(1)}));
  EXPECT_EQ(followOn(scene.placed(), pointersByKey(later.instances), 2000, 2000).blend_ns, kAbruptBlend_ns) << "a jump";
  scene.apply(worldOf({}));
  EXPECT_EQ(followOn(scene.placed(), pointersByKey(later.instances), 2000, 2100).blend_ns, kAbruptBlend_ns) << "gone";
}

std::shared_ptr<SceneItems> withSnaps(SceneItems items, SnapList snaps) {
  auto list = listOf(std::move(items));
  list->snaps = std::make_shared<const SnapList>(std::move(snaps));
  return list;
}

// An object of nothing but snaps, and one with a mesh; called twice, once larger.
TEST(EditableScene, SnapsAreWhereTheirObjectIsCalled) {
  const SnapSpec point{"p", {Vec3(1, 0, 0)}, {}, 0.1, 2};
  const SnapSpec plane{"q", {Vec3(0, 1, 0)}, Vec3(1, 1, 0).normalized(), 0.1, 2};
  EditableScene scene(1, {});
  Placement large = turn(M_PI / 2, {0, 0, 5});
  large.linear *= Vec3(2, 1, 1).asDiagonal();
  SceneEdit edit = worldOf({callItem(1), callItem(1, large), callItem(2)});
  edit.objects[1] = withSnaps({}, {point, plane});
  edit.objects[2] = withSnaps({shapeItem(triangle())}, {point});
  scene.apply(edit);
  const Followed all = followOn(scene.placed(), {}, 0, 0);
  ASSERT_EQ(all.instances.size(), 4U);
  std::vector<Vec3> points, normals;
  for (const Instance& instance : all.instances) {
    if (!instance.snaps) continue;
    for (const SnapSpec& snap : *instance.snaps) {
      if (snap.normal)
        normals.push_back(instance.motion.to().turnToWorld(*snap.normal));
      else
        points.push_back(instance.motion.to().toWorld(snap.points[0]));
      EXPECT_EQ(snap.capture_m, 0.1);
    }
  }
  const auto has = [](const std::vector<Vec3>& list, const Vec3& v) {
    return std::any_of(list.begin(), list.end(), [&](const Vec3& one) { return (one - v).norm() < 1e-9; });
  };
  EXPECT_EQ(points.size(), 3U);
  EXPECT_TRUE(has(points, {1, 0, 0}) && has(points, {0, 2, 5}));
  EXPECT_TRUE(has(normals, Vec3(1, 1, 0).normalized()) && has(normals, Vec3(-1, 0.5, 0).normalized()));
  EXPECT_EQ(makeSnapshot(all.instances)->snaps.size(), 5U);
  const Followed same = followOn(scene.placed(), pointersByKey(all.instances), 10, 20);
  EXPECT_EQ(same.blend_ns, 0);
  SceneEdit other;
  other.objects[2] = withSnaps({shapeItem(triangle())}, {plane});
  scene.apply(other);
  EXPECT_EQ(followOn(scene.placed(), pointersByKey(all.instances), 30, 40).blend_ns, kAbruptBlend_ns);
}

TEST(EditableScene, TheSnapsOfABodyMoveWithIt) {
  EditableScene scene(1, {});
  SceneEdit edit = worldOf({callItem(1)});
  edit.objects[1] = withSnaps({shapeItem(triangle())}, {{"p", {Vec3(1, 0, 0)}, {}, 0.1, 2}});
  BodySpec fixed;
  fixed.fixed = true;
  auto body = std::make_shared<SceneItems>(*edit.objects[1]);
  body->body = std::make_shared<const BodySpec>(fixed);
  edit.objects[1] = body;
  scene.apply(edit);
  ASSERT_EQ(scene.placed().size(), 1U);
  EXPECT_TRUE(scene.placed()[0].body && scene.placed()[0].snaps);
}

TEST(EditableScene, SnapsAreLimited) {
  EditableScene scene(1, {});
  const auto apply = [&](std::size_t calls, std::size_t snaps, std::size_t points) {
    SceneItems items(calls, callItem(1));
    SceneEdit edit = worldOf(items);
    edit.objects[1] = withSnaps({}, SnapList(snaps, SnapSpec{"", std::vector<Vec3>(points, Vec3::Zero()), {}, 0.1, 1}));
    scene.apply(edit);
  };
  apply(2, 32, 1);
  EXPECT_THROW(apply(2, 33, 1), Error);
  apply(4, 4, 256);
  EXPECT_THROW(apply(4, 5, 256), Error);
  EXPECT_EQ(scene.placed().size(), 4U) << "as before";
  EXPECT_THROW(scene.apply(worldOf({callItem(1, turn(0, {0, 2e9, 0}))})), Error);
}

TEST(EditableScene, AMeshIsTheSameWhateverOfItHasShrunkToNothing) {
  const auto first = makeShape(Model(triangle()->model));
  Model flat = first->model;
  flat.positions[2] = flat.positions[1];
  const auto second = makeShape(std::move(flat), *first);
  EXPECT_TRUE(second->primitives.empty());
  EXPECT_EQ(second->mesh, first->mesh);
  EXPECT_EQ(second->before, 0U) << "its hierarchy was built";
  EXPECT_EQ(makeShape(Model(first->model), *second)->mesh, first->mesh) << "and back";
}

TEST(EditableScene, AMeshIsTheSameHoweverItsHierarchyIsMade) {
  for (const HierarchyKind kind : {HierarchyKind::kBvh, HierarchyKind::kSpheres, HierarchyKind::kNone}) {
    const auto first = makeShape(Model(triangle()->model), kind);
    Model moved = first->model;
    moved.positions[2].x() = 0.5;
    const auto second = makeShape(std::move(moved), *first);
    EXPECT_EQ(second->mesh, first->mesh) << nameOf(kind);
    EXPECT_NE(second->geometry, first->geometry);
    EXPECT_NE(makeShape(Model(first->model), kind)->mesh, first->mesh) << "by chance";
  }
}

TEST(EditableScene, ABentMeshGoesFromWhereItWasShown) {
  const auto bent = [](const Shape& shape) {
    Model model = shape.model;
    model.positions[1].y() += 0.1;
    return makeShape(std::move(model), shape);
  };
  const auto shown = triangle(), never_shown = bent(*shown), now = bent(*never_shown);
  EditableScene scene(1, {});
  scene.apply(worldOf({shapeItem(shown)}));
  const Followed first = followOn(scene.placed(), {}, 100, 200);
  EXPECT_FALSE(first.instances[0].mesh_motion);
  scene.apply(worldOf({shapeItem(never_shown)}));
  scene.apply(worldOf({shapeItem(now)}));
  const Followed second = followOn(scene.placed(), pointersByKey(first.instances), 300, 400);
  ASSERT_TRUE(second.instances[0].mesh_motion);
  const MeshTransition& way = second.instances[0].mesh_motion->last();
  EXPECT_EQ(way.from(), shown);
  EXPECT_EQ(way.to(), now);
  EXPECT_EQ(way.begin_ns(), 300);
  EXPECT_EQ(way.end_ns(), 400);
  EXPECT_EQ(way.corners(0, 0.5)[1].y(), shown->model.positions[1].y() + 0.1);
  EXPECT_EQ(second.blend_ns, 0);
  const auto snapshot = makeSnapshot(second.instances);
  EXPECT_EQ(snapshot->deforming, std::vector<std::uint32_t>{0});
  EXPECT_EQ(snapshot->deforms_until_ns, 400);
  EXPECT_EQ(snapshot->moves_until_ns, 400);
  EXPECT_GT(memoryOf(*snapshot), memoryOf(*makeSnapshot(first.instances)) + shown->geometryBytes());
  const auto at_once = followOn(scene.placed(), pointersByKey(first.instances), 300, 300);
  EXPECT_EQ(at_once.instances[0].mesh_motion->end_ns(), 300 + kAbruptBlend_ns) << "no interval is known";
  EXPECT_EQ(at_once.blend_ns, 0);
  const auto same = followOn(scene.placed(), pointersByKey(second.instances), 500, 600);
  EXPECT_FALSE(same.instances[0].mesh_motion) << "it is there";
  EXPECT_EQ(followOn(scene.placed(), pointersByKey(second.instances), 350, 450).instances[0].mesh_motion,
            second.instances[0].mesh_motion)
      << "it is on its way";
  scene.apply(worldOf({shapeItem(triangle(2))}));
  EXPECT_FALSE(followOn(scene.placed(), pointersByKey(second.instances), 350, 450).instances[0].mesh_motion)
      << "another mesh";
}

TEST(EditableScene, AMeshThatIsRedrawnAsItWasDoesNotBend) {
  const auto first = triangle(), again = makeShape(Model(first->model), *first);
  EditableScene scene(1, {});
  scene.apply(worldOf({shapeItem(first)}));
  const Followed shown = followOn(scene.placed(), {}, 100, 200);
  scene.apply(worldOf({shapeItem(again)}));
  const Followed next = followOn(scene.placed(), pointersByKey(shown.instances), 300, 400);
  EXPECT_FALSE(next.instances[0].mesh_motion);
  EXPECT_EQ(next.blend_ns, 0);
}

// A way that has begun is gone to its end; one that has not is forgotten.
TEST(EditableScene, ABendFollowsTheOneBefore) {
  std::vector<std::shared_ptr<const Shape>> shapes{triangle()};
  EditableScene scene(1, {});
  const auto bendNext = [&] {
    Model model = shapes.back()->model;
    model.positions[1].y() += 0.1;
    shapes.push_back(makeShape(std::move(model), *shapes.back()));
    scene.apply(worldOf({shapeItem(shapes.back())}));
  };
  scene.apply(worldOf({shapeItem(shapes[0])}));
  Followed shown = followOn(scene.placed(), {}, 0, 0);
  const auto next = [&](std::int64_t begin_ns, std::int64_t end_ns) {
    bendNext();
    shown = followOn(scene.placed(), pointersByKey(std::as_const(shown.instances)), begin_ns, end_ns);
    return shown.instances[0].mesh_motion;
  };
  next(100, 200);
  auto mesh_motion = next(180, 280);
  EXPECT_EQ(mesh_motion->earlier()->to(), shapes[1]);
  EXPECT_EQ(mesh_motion->last().from(), shapes[1]);
  EXPECT_EQ(mesh_motion->last().begin_ns(), 200);
  EXPECT_EQ(mesh_motion->last().end_ns(), 280) << "no later than it should be";
  mesh_motion = next(190, 290);
  EXPECT_EQ(mesh_motion->earlier()->to(), shapes[1]);
  EXPECT_EQ(mesh_motion->last().from(), shapes[1]);
  EXPECT_EQ(mesh_motion->last().to(), shapes[3]);
  EXPECT_EQ(mesh_motion->last().begin_ns(), 200);
  mesh_motion = next(195, 205);
  EXPECT_EQ(mesh_motion->last().end_ns(), 205);
  mesh_motion = next(198, 199);
  EXPECT_EQ(mesh_motion->last().end_ns(), 201) << "half the time that it asks for, rounded up";
}

}  // namespace
}  // namespace hl::test_editable_scene

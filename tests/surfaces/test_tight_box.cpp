// Tight boxes of surfaces that make their primitives, against all of these.
#include "geometry/tight_box.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "clouds.h"
#include "expressions.h"
#include "fields.h"
#include "frames.h"
#include "index_judge.h"
#include "scene/scene_model.h"
#include "scene/tight_bounds.h"
#include "volumes.h"

namespace hl::test_tight_box {
namespace {

using K = ExpressionKind;
using Source = std::shared_ptr<const PrimitiveSource>;

// Not of vertices that no triangle uses.
Box boxOfAll(const PrimitiveSource& source, const Mat3& turn) {
  const auto mesh = test::meshOf(source);
  Box box;
  for (const std::uint32_t point : mesh.points) box.extend(Vec3(turn * mesh.positions[point]));
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) box.extend(Vec3(turn * mesh.positions[vertex]));
  }
  return box;
}

void expectTight(const PrimitiveSource& source, const Mat3& turn) {
  const Box wanted = boxOfAll(source, turn), box = tightBox(source, *source.makeIndex(), turn);
  ASSERT_EQ(box.empty(), wanted.empty());
  if (box.empty()) return;
  const double size = source.bounds().size().norm();
  const double rounding = 1e-12 * (size + source.bounds().centre().norm());
  EXPECT_GE((box.min - wanted.min).minCoeff(), -rounding);
  EXPECT_LE((box.min - wanted.min).maxCoeff(), size / 20'000 + rounding);
  EXPECT_LE((box.max - wanted.max).maxCoeff(), rounding);
  EXPECT_GE((box.max - wanted.max).minCoeff(), -size / 20'000 - rounding);
}

template <typename Draw>
void expectTight(int count, const Draw& draw) {
  test::Random random(5);
  for (int i = 0; i < count; ++i) {
    Source source;
    try {
      source = draw(random);
      (void)source->makeIndex();
    } catch (const Error&) {  // what is drawn may be no surface
      continue;
    }
    SCOPED_TRACE(i);
    const Mat3 turn = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix();
    expectTight(*source, i % 2 == 0 ? Mat3(Mat3::Identity()) : turn);
  }
}

TEST(TightBox, IsThatOfAllPrimitivesOfAVolume) { expectTight(200, test::randomSurface); }
TEST(TightBox, IsThatOfAllPrimitivesOfHeights) { expectTight(200, test::randomField); }
TEST(TightBox, IsThatOfAllPrimitivesOfAFrame) { expectTight(100, test::randomFrame); }
TEST(TightBox, IsThatOfAllPrimitivesOfACloud) { expectTight(100, test::randomCloud); }
TEST(TightBox, IsThatOfAllPrimitivesOfAnExpression) {
  expectTight(20, [](test::Random& random) { return test::surfaceOf(test::randomSolid(random), 4e-4); });
}

TEST(TightBox, OfOnePointItIsThatPoint) {
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(3, -2, 1)}) {
    const PointCloud cloud(test::cloudOf({p}), CloudLook());
    const Box box = tightBox(cloud, *cloud.makeIndex());
    EXPECT_NEAR((box.min - p).norm() + (box.max - p).norm(), 0, 1e-9);
  }
}

TEST(TightBox, OfNothingItIsEmpty) {
  const auto volume = test::volumeOf({4, 4, 4}, [](const Vec3&) { return 0; });
  const IsoSurface none(volume, test::cubicFrame(1), {7, SolidSide::kAbove});
  EXPECT_TRUE(tightBox(none, *none.makeIndex()).empty());
}

SceneModel sceneOf(Source source) {
  SceneModel scene;
  scene.surfaces.push_back({"surface", std::move(source)});
  return scene;
}

// Bricks and cells reach beyond the surface, by as much as it is large.
TEST(FitModel, TheSurfaceItselfIsFitted) {
  const auto ball = test::volumeOf({17, 17, 17}, [](const Vec3& at) { return 3 - (at - Vec3(8, 8.25, 8)).norm(); });
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3::UnitZ()).toRotationMatrix();
  const auto scan =
      std::make_shared<const IsoSurface>(ball, GridFrame{1e-3 * turn, Vec3(0.1, 0, 0)}, IsoValue{0, SolidSide::kAbove});
  test::Random random(3);
  Expression box = turned(test::box(Vec3(0.05, 0.02, 0.03)), random);
  box.place = Vec3(0.2, 0, 0);
  for (const Source& source : {Source(scan), Source(test::surfaceOf(box))}) {
    SceneModel scene = sceneOf(source);
    const double factor = fitModel(scene, 0.1);
    const Box all = boxOfAll(*scene.surfaces[0].source, Mat3::Identity());
    EXPECT_NEAR(all.size().maxCoeff(), 0.1, 1e-5);
    EXPECT_NEAR(all.centre().norm(), 0, 1e-5);
    EXPECT_NEAR(factor, 0.1 / boxOfAll(*source, Mat3::Identity()).size().maxCoeff(), 1e-4 * factor);
    const Box told = tightBounds(*makeSnapshot(scene));
    EXPECT_NEAR((told.min - all.min).norm() + (told.max - all.max).norm(), 0, 3e-5);
  }
}

TEST(TightBounds, FollowThePoseOfAnInstance) {
  Instance instance;
  instance.shape = makeShape(test::surfaceOf(test::box(Vec3(0.05, 0.02, 0.03))));
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = 1;
  instance.motion = Motion(Pose{Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ()).toRotationMatrix(), Vec3(1, 2, 3)});
  const Box box = tightBounds(*makeSnapshot({std::move(instance)}));
  const double half = 0.035 / std::sqrt(2);
  EXPECT_NEAR((box.max - Vec3(1 + half, 2 + half, 3.015)).norm(), 0, 1e-5);
  EXPECT_NEAR((box.min - Vec3(1 - half, 2 - half, 2.985)).norm(), 0, 1e-5);
}

}  // namespace
}  // namespace hl::test_tight_box

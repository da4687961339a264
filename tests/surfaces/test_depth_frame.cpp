// Depth frames: joined where depth allows, found as the hierarchy finds the same triangles, smoothed over time.
#include "surfaces/depth_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "frames.h"
#include "geometry/queries.h"
#include "guard/realtime_guard.h"
#include "index_judge.h"

namespace hl::test_depth_frame {
namespace {

using test::cameraFor;
using test::frameOf;
using test::Random;
using test::randomFrame;

test::TestBall randomBall(Random& random, const DepthFrame& frame) {
  const DepthPixels& grid = frame.image().pixels;
  const auto pixel = [&](std::uint32_t side) {
    return static_cast<std::uint32_t>(random.below(static_cast<int>(side)));
  };
  const Vec3 at = frame.cells().pointAt({pixel(grid.columns()), pixel(grid.rows())});
  const double cell = frame.frame().axes.col(0).norm() / frame.image().camera.fx;
  const double radius = cell * std::pow(10.0, random.uniform(-2, 1.3));
  return {at + random.uniform(-1.5, 1.5) * radius * random.direction(), radius, cell};
}

TEST(DepthFrame, FirstImpactsAreThoseOfTheMesh) { test::expectImpactsOfMesh(randomFrame, randomBall, 12); }

TEST(DepthFrame, WhatIsWithinADistanceIsWhatIsOfTheMesh) { test::expectDistancesOfMesh(randomFrame, randomBall); }

TEST(DepthFrame, TheNearestTriangleIsThatOfTheMesh) { test::expectNearestOfMesh(randomFrame, randomBall); }

// A plane seen at an angle: each pixel lies on it, and all triangles face the camera.
TEST(DepthFrame, APlaneIsAPlane) {
  const Vec3 normal = Vec3(0.3, -0.2, 1).normalized();
  const DepthCamera camera = cameraFor(64, 48);
  std::vector<float> depths;
  for (int j = 0; j < 48; ++j) {
    for (int i = 0; i < 64; ++i)
      depths.push_back(static_cast<float>(0.5 / normal.dot(Vec3(camera.across(i), -camera.down(j), -1)) * -1));
  }
  const auto frame = frameOf(test::gridOf(64, 48, depths), camera);
  EXPECT_EQ(frame->triangles(), 2U * 63 * 47);
  for (ElementId id = 0; id < frame->count(); ++id) {
    for (const Vec3& corner : frame->corners(id)) ASSERT_NEAR(normal.dot(corner), -0.5, 1e-7);
    const Primitive primitive = primitiveOf(*frame, id);
    ASSERT_GT(primitive.normal.dot(-frame->corners(id)[0]), 0) << "toward the camera";
    ASSERT_NEAR(frame->trueNormal(id, frame->corners(id)[1]).dot(normal), 1, 1e-5);
  }
}

TEST(DepthFrame, WhatDiffersTooMuchIsNotJoinedAndAHoleIsAHole) {
  std::vector<float> depths(64, 1.0F);
  for (int j = 0; j < 8; ++j) {
    for (int i = 4; i < 8; ++i) depths[static_cast<std::size_t>(8 * j + i)] = 1.021F;
  }
  EXPECT_EQ(frameOf(test::gridOf(8, 8, depths), cameraFor(8, 8))->triangles(), 2U * (49 - 7));
  for (int j = 0; j < 8; ++j) depths[static_cast<std::size_t>(8 * j + 4)] = 1.0105F;
  EXPECT_EQ(frameOf(test::gridOf(8, 8, depths), cameraFor(8, 8))->triangles(), 2U * 49);
  depths[27] = 0;
  EXPECT_EQ(frameOf(test::gridOf(8, 8, depths), cameraFor(8, 8))->triangles(), 2U * 49 - 6);
}

TEST(DepthFrame, MatterIsBehindTheSurface) {
  std::vector<float> depths(64, 1.0F);
  depths[27] = 0;
  const auto frame = frameOf(test::gridOf(8, 8, depths), cameraFor(8, 8), 0.5);
  EXPECT_EQ(frame->siteOf({0.1, 0.1, -0.4}), Site::kOpen);
  EXPECT_EQ(frame->siteOf({0.1, 0.1, -0.6}), Site::kMatter);
  EXPECT_EQ(frame->siteOf({0, 0, 0.1}), Site::kOpen) << "behind the camera";
  EXPECT_EQ(frame->siteOf({5, 0, -0.6}), Site::kOpen) << "beside the image";
  EXPECT_EQ(frame->siteOf({0.1, 0.1, -0.5}), Site::kBoundary);
}

// On a steep surface as on a flat one: just before a triangle there is none, just behind it there is.
TEST(DepthFrame, MatterBeginsAtTheTriangles) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const auto frame = randomFrame(random);
    for (int k = 0; k < 50; ++k) {
      const auto id = static_cast<ElementId>(random.uniform(0, 1) * static_cast<double>(frame->count()));
      if (!frame->cells().exists(cellOf(id, frame->image().pixels.columns()))) continue;
      const std::array<Vec3, 3> corner = frame->corners(id);
      const double a = random.uniform(0.01, 0.5), b = random.uniform(0.01, 0.49);
      const Vec3 place = corner[0] + a * (corner[1] - corner[0]) + b * (corner[2] - corner[0]);
      constexpr double kNear = 1e-6;  // of the depth
      const Vec3 ray = place - frame->frame().origin;
      ASSERT_EQ(frame->siteOf(place - kNear * ray), Site::kOpen) << i;
      ASSERT_EQ(frame->siteOf(place + kNear * ray), Site::kMatter) << i;
    }
  }
}

TEST(DepthFrame, SmoothingFollowsSlowlyAndJumpsAtSteps) {
  const DepthCamera camera = cameraFor(2, 2);
  const auto now = [](std::vector<std::uint16_t> depths) { return test::gridOf(2, 2, depths); };
  const auto before = smoothed(*now({1000, 1000, 0, 0}), 1e-3, camera, nullptr, 0.9);
  EXPECT_FLOAT_EQ(static_cast<float>(before->pixels.at(0, 0)), 1);
  const auto after = smoothed(*now({1010, 1200, 0, 1000}), 1e-3, camera, before.get(), 0.9);
  EXPECT_NEAR(after->pixels.at(0, 0), 1.001, 1e-6) << "a tenth of the way";
  EXPECT_NEAR(after->pixels.at(1, 0), 1.2, 1e-6) << "another thing";
  EXPECT_FALSE(after->pixels.at(0, 1) > 0) << "a hole";
  EXPECT_NEAR(after->pixels.at(1, 1), 1, 1e-6) << "was a hole";
  const auto other = smoothed(*now({1010, 1010, 1010, 1010}), 1e-3, cameraFor(3, 3), before.get(), 0.9);
  EXPECT_NEAR(other->pixels.at(0, 0), 1.01, 1e-6) << "another camera";
}

TEST(DepthFrame, AMissingPixelIsHeldForAQuarterOfASecond) {
  const DepthCamera camera = cameraFor(2, 2);
  const auto full = test::gridOf<std::uint16_t>(2, 2, {1000, 1000, 1000, 1000});
  const auto hole = test::gridOf<std::uint16_t>(2, 2, {1000, 0, 1000, 1000});
  auto image = smoothed(*full, 1e-3, camera, nullptr, 0.5);
  for (int i = 1; i <= 2 * kMaxHeld; ++i) {
    image = smoothed(*hole, 1e-3, camera, image.get(), 0.5);
    EXPECT_EQ(image->pixels.at(1, 0) > 0, i <= kMaxHeld) << i;
    EXPECT_EQ(image->tiles.triangles(), i <= kMaxHeld ? 2U : 1U);
  }
  image = smoothed(*full, 1e-3, camera, image.get(), 0.5);
  image = smoothed(*hole, 1e-3, camera, image.get(), 0.5);
  EXPECT_GT(image->pixels.at(1, 0), 0) << "anew";
  image = smoothed(*hole, 1e-3, camera, image.get(), 0);
  EXPECT_FALSE(image->pixels.at(1, 0) > 0) << "without smoothing nothing is held";
}

TEST(DepthFrame, RefusesWhatIsNoCamera) {
  const auto refused = [](const DepthCamera& camera) { EXPECT_THROW(checkCamera(camera), Error); };
  refused({0, 1, 0, 0});
  refused({1, -1, 0, 0});
  refused({NAN, 1, 0, 0});
  refused({1, 1, NAN, 0});
  refused({1, 1, 0, 0, 0});
  refused({1, 1, 0, 0, 2});
  EXPECT_NO_THROW(checkCamera({1, 1, 0, 0}));
}

TEST(DepthFrame, QueriesAreRealTimeSafe) {
  Random random(9);
  const auto frame = randomFrame(random);
  const auto index = frame->makeIndex();
  const test::TestBall ball = randomBall(random, *frame);
  const RealtimeGuard guard;
  std::size_t near = 0;
  index->overlap(ball.centre, ball.radius, [&](ElementId) { ++near; });
  index->sweep(ball.centre, Vec3(0.1, 0.1, 0.1), ball.radius, 0.01, [&](ElementId, double limit) { return limit; });
}

// An image of as many texels has one on each pixel, the top row at v = 1.
TEST(DepthFrame, TexelsLieOnPixels) {
  constexpr std::uint32_t kColumns = 5, kRows = 4;
  const auto frame = test::frameOf(test::gridOf(kColumns, kRows, std::vector<float>(kColumns * kRows, 1)),
                                   test::cameraFor(kColumns, kRows));
  ASSERT_TRUE(frame->hasTexcoords());
  for (ElementId id = 0; id < frame->count(); ++id) {
    const auto pixels = frame->cells().pixelsOf(cellOf(id, kColumns));
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 at = frame->texcoord(id, i);
      EXPECT_DOUBLE_EQ(at.x() * kColumns, pixels[i][0] + 0.5);
      EXPECT_DOUBLE_EQ((1 - at.y()) * kRows, pixels[i][1] + 0.5);
    }
  }
  EXPECT_EQ(frame->drawn(1000).texcoords.size(), frame->drawn(1000).positions.size());
}

}  // namespace
}  // namespace hl::test_depth_frame

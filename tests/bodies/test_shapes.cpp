// Cylinders, hulls and cones, and the mass of meshes, against closed forms and brute force.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "base/error.h"
#include "bodies/convex_hull.h"
#include "bodies/made_bodies.h"
#include "bodies/mesh_body.h"
#include "scene/rigid_body.h"
#include "test_worlds.h"

namespace hl::test_shapes {
namespace {

using namespace test;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

std::vector<Vec3> randomPoints(std::uint64_t seed, std::size_t count, bool on_ball) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 point(normal(random), normal(random), normal(random));
    points.push_back(Vec3(0.3, -0.2, 0.1) + 0.05 * (on_ball ? point.normalized() : point));
  }
  return points;
}

double highestAbove(const Convex& shape, const Vec3& point) {
  double highest = -1e300;
  for (const Convex::Face& face : shape.faces)
    highest = std::max(highest, face.normal.dot(point - shape.vertices[face.corners[0]]));
  return highest;
}

void expectClosed(const Convex& shape) {
  EXPECT_EQ(shape.vertices.size() + shape.faces.size(), shape.edges.size() + 2);  // Euler
  std::map<std::pair<int, int>, int> passed;
  for (const Convex::Face& face : shape.faces) {
    for (std::size_t i = 0; i < face.corners.size(); ++i)
      ++passed[{face.corners[i], face.corners[(i + 1) % face.corners.size()]}];
  }
  EXPECT_EQ(passed.size(), 2 * shape.edges.size());
  for (const auto& [edge, times] : passed) EXPECT_EQ(times, 1);
}

TEST(Hull, EveryPointIsInsideAndEveryVertexExtreme) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto points = randomPoints(seed, 4 + seed, false);
    const Hull hull = hullOf(points);
    expectClosed(hull.shape);
    ASSERT_LE(hull.shape.vertices.size(), kMaxVertices);
    EXPECT_LT(hull.error_m, 1e-9);
    for (const Vec3& point : points) EXPECT_LT(highestAbove(hull.shape, point), 1e-9) << seed;
    // Brute force: a vertex is extreme along the mean of the normals around it, and is a point.
    for (std::size_t v = 0; v < hull.shape.vertices.size(); ++v) {
      Vec3 outward = Vec3::Zero();
      for (const Convex::Face& face : hull.shape.faces) {
        if (std::find(face.corners.begin(), face.corners.end(), v) != face.corners.end()) outward += face.normal;
      }
      const Vec3& vertex = hull.shape.vertices[v];
      int there = 0;
      for (const Vec3& point : points) {
        if ((point - vertex).norm() < 1e-12) ++there;
        EXPECT_LE(outward.dot(point - vertex), 1e-12) << seed;
      }
      EXPECT_EQ(there, 1);
    }
  }
}

TEST(Hull, PointsInOnePlaneAreOneFace) {
  std::vector<Vec3> points;
  for (int x = 0; x <= 6; ++x) {
    for (int y = 0; y <= 6; ++y) {
      for (int z = 0; z <= 6; ++z) points.emplace_back(0.01 * x, 0.02 * y, 0.03 * z);
    }
  }
  const Mat3 turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& point : points) point = turn * point;
  const Convex shape = hullOf(points).shape;
  EXPECT_EQ(shape.vertices.size(), 8u);
  EXPECT_EQ(shape.faces.size(), 6u);
  EXPECT_EQ(shape.directions.size(), 3u);
  expectClosed(shape);
}

TEST(Hull, OfTooManyVerticesThoseThatReachFarthestStay) {
  const auto points = randomPoints(7, 5000, true);
  const Hull hull = hullOf(points);
  expectClosed(hull.shape);
  EXPECT_EQ(hull.shape.vertices.size(), kMaxVertices);
  double farthest = 0;
  for (const Vec3& point : points) farthest = std::max(farthest, highestAbove(hull.shape, point));
  EXPECT_NEAR(hull.error_m, farthest, 1e-12);
  // 64 points of a ball in the best places leave caps of 0.05 r.
  EXPECT_LT(hull.error_m, 0.10 * 0.05);
}

TEST(Hull, BadPointsGetAClearError) {
  const auto error = [](const std::vector<Vec3>& points) {
    try {
      hullOf(points);
    } catch (const Error& what) {
      return std::string(what.what());
    }
    return std::string();
  };
  std::vector<Vec3> flat;
  for (int i = 0; i < 20; ++i) flat.emplace_back(0.1 * i, 0.01 * i * i, 0.3 * i - 0.02 * i * i);
  EXPECT_NE(error(flat).find("lie in a plane"), std::string::npos);
  EXPECT_NE(error({}).find("lie in a plane"), std::string::npos);
  EXPECT_NE(error({Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)}).find("plane"), std::string::npos);
  EXPECT_NE(error({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, NAN)}).find("finite"), std::string::npos);
}

TEST(Mass, OfCubeTetrahedronPyramidAndCylinder) {
  const Mass cube = massOfShape(3, moved(boxShape(Vec3(0.1, 0.2, 0.3)), Vec3(5, 6, 7)));
  EXPECT_LT((cube.inertia_kg_m2 - massOfBox(3, Vec3(0.1, 0.2, 0.3)).inertia_kg_m2).norm(), 1e-12);
  EXPECT_LT((cube.centre_O - Vec3(5, 6, 7)).norm(), 1e-14);
  // A corner of a cube: V = a^3 / 6; about its centre m a^2 3 / 40, and m a^2 / 80 off the diagonal.
  const std::vector<Vec3> corner{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 2)};
  Triangles faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const Solid solid = solidOf(corner, faces);
  EXPECT_NEAR(solid.volume_m3, 8.0 / 6, 1e-14);
  EXPECT_LT((solid.centre_O - Vec3::Constant(0.5)).norm(), 1e-14);
  const Mat3 expected = 8.0 / 6 * 4 * (Mat3::Constant(1.0 / 80) + Mat3(Vec3::Constant(5.0 / 80).asDiagonal()));
  EXPECT_LT((solid.inertia_m5 - expected).norm(), 1e-13);
  for (auto& face : faces) std::swap(face[0], face[1]);  // inside out
  EXPECT_LT((solidOf(corner, faces).inertia_m5 - expected).norm(), 1e-13);
  EXPECT_NEAR(massOfDensity(3, solid).mass_kg, 4, 1e-13);
  // A pyramid's centre is at a quarter of its height.
  const std::vector<Vec3> pyramid{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 4)};
  EXPECT_NEAR(solidOf(hullOf(pyramid).shape).centre_O.z(), 1, 1e-12);
  const Mass cylinder = massOfShape(1, cylinderShape(0.02, 0.01));
  EXPECT_LT((cylinder.inertia_kg_m2 - massOfCylinder(1, 0.02, 0.01).inertia_kg_m2).norm(), 0.02 * 1e-4);
}

// Rings of latitude; the sum falls short of the ball by the square of the angle between rings.
TEST(Mass, OfAFinerBallComesNearerToTheBall) {
  double last = 1;
  for (const std::uint32_t rings : {8u, 16u, 32u, 64u}) {
    std::vector<Vec3> vertices{Vec3(0, 0, 1)};
    Triangles triangles;
    const std::uint32_t around = 2 * rings;
    for (std::uint32_t ring = 1; ring < rings; ++ring) {
      for (std::uint32_t i = 0; i < around; ++i) {
        const double down = EIGEN_PI * ring / rings, turn = 2 * EIGEN_PI * i / around;
        vertices.emplace_back(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn), std::cos(down));
      }
    }
    vertices.emplace_back(0, 0, -1);
    const auto end = static_cast<std::uint32_t>(vertices.size() - 1);
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t next = (i + 1) % around;
      triangles.push_back({0, 1 + i, 1 + next});
      triangles.push_back({end, end - around + next, end - around + i});
      for (std::uint32_t ring = 0; ring + 2 < rings; ++ring) {
        const std::uint32_t up = 1 + ring * around, low = up + around;
        triangles.push_back({up + i, low + i, low + next});
        triangles.push_back({up + i, low + next, up + next});
      }
    }
    const Solid solid = solidOf(vertices, triangles);
    const double error = (solid.inertia_m5 / solid.volume_m3 - 0.4 * Mat3::Identity()).norm();
    EXPECT_NEAR(solid.volume_m3, 4 * EIGEN_PI / 3, 20.0 / rings / rings);
    EXPECT_LT(error, last * (last < 1 ? 0.27 : 1));
    last = error;
  }
}

TEST(Mass, OfWhatHoldsNothingIsRefused) {
  const std::vector<Vec3> square{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  EXPECT_THROW(solidOf(square, Triangles{{0, 1, 2}, {0, 2, 3}}), Error);  // open
  EXPECT_THROW(solidOf(square, Triangles{{0, 1, 2}, {0, 2, 1}}), Error);  // a sheet
  EXPECT_THROW(solidOf(square, Triangles{{0, 1, 7}}), Error);             // no vertex
  EXPECT_THROW(solidOf(square, Triangles{}), Error);
  EXPECT_THROW(massOfDensity(0, solidOf(boxShape(Vec3::Ones()))), Error);
  EXPECT_THROW(massOfDensity(NAN, solidOf(boxShape(Vec3::Ones()))), Error);
}

Body cylinder(double mass_kg, double half_m, double radius_m, double friction) {
  return {1, massOfCylinder(mass_kg, half_m, radius_m), cylinderShape(half_m, radius_m), {friction, friction, 0}};
}
const Mat3 kStanding = Eigen::AngleAxisd(-EIGEN_PI / 2, Vec3::UnitX()).toRotationMatrix();

Playground onSlope(double slope_rad, Body body, double height_m, const Mat3& turned) {
  World world;
  world.fixed = floorScene(1, slope_rad);
  world.fixed_surface = body.surface;
  world.bodies = {std::move(body)};
  const Mat3 turn = Eigen::AngleAxisd(slope_rad, Vec3::UnitZ()).toRotationMatrix();
  return {std::move(world), {placeAt(turn * Vec3(0, height_m, 0), turn * turned)}};
}

// It lies along z and rolls along x: 2 / 3 g sin a; it would slip below a friction of tan a / 3.
TEST(Cylinder, RollsDownAnInclineAsACylinder) {
  for (const double slope : {0.01, 0.35}) {
    for (const double friction : {0.15, 0.1}) {
      Playground play = onSlope(slope, cylinder(0.2, 0.03, 0.02, friction), 0.02, Mat3::Identity());
      play.steps(300);
      const double rolls = 2.0 / 3 * kGravity * std::sin(slope);
      const double slips = kGravity * (std::sin(slope) - friction * std::cos(slope));
      const double expected = 0.3 * (friction < std::tan(slope) / 3 ? slips : rolls);
      EXPECT_NEAR(play.state.bodies[0].velocity.norm(), expected, 1e-6) << slope << " " << friction;
    }
  }
}

// In parts of the speed that is left and m: of a body that rolls over a floor of two triangles, and over their seam.
struct Rolled {
  double speed = 0, hop_m = 0;
};
Rolled rolled(const Body& body, double radius_m, double spin_rad_s, double yaw_rad) {
  World world;
  world.fixed = floorScene(5);
  world.fixed_surface = body.surface;
  world.bodies = {body};
  const Mat3 turn = Eigen::AngleAxisd(yaw_rad, Vec3::UnitY()).toRotationMatrix();
  Playground play(std::move(world), {placeAt(Vec3(-0.4, radius_m, 0.1), turn)});
  BodyState& state = play.state.bodies[0];
  state.spin = -spin_rad_s * turn.col(2);
  state.velocity = spin_rad_s * radius_m * turn.col(0);
  Rolled out;
  for (int i = 0; i < 500; ++i) {
    play.step();
    out.hop_m = std::max(out.hop_m, state.centre.y() - radius_m);
  }
  out.speed = state.velocity.norm() / (spin_rad_s * radius_m);
  return out;
}

// Up to 0.2 rad and 4 mm in a step.
TEST(Cylinder, RollsFastWithoutLossAsBallsAndCapsulesDo) {
  for (const double radius : {0.005, 0.01, 0.02}) {
    const Body bodies[] = {cylinder(0.2, 0.03, radius, 0.5),
                           {1, massOfCapsule(0.2, 0.03, radius), capsuleShape(0.03, radius), {0.5, 0.5, 0}},
                           ball(1, 0.2, radius, 0.5)};
    for (const double spin : {10, 50, 100, 200}) {
      for (const double yaw : {0.0, 0.6}) {
        for (const Body& body : bodies) {
          const Rolled end = rolled(body, radius, spin, yaw);
          EXPECT_NEAR(end.speed, 1, 1e-6) << radius << " " << spin << " " << yaw;
          EXPECT_LT(end.hop_m, 1e-8) << radius << " " << spin << " " << yaw;
        }
      }
    }
  }
}

TEST(Cylinder, LiesAndStandsStill) {
  for (const bool stands : {false, true}) {
    Playground play =
        onSlope(0, cylinder(0.2, 0.03, 0.02, 0.5), stands ? 0.03 : 0.02, stands ? kStanding : Mat3(Mat3::Identity()));
    const Vec3 begin = play.state.bodies[0].centre;
    play.steps(1000);
    EXPECT_LT((play.state.bodies[0].centre - begin).norm(), 1e-8) << stands;
    EXPECT_LT(play.state.bodies[0].velocity.norm(), 1e-6) << stands;
  }
}

// It stands on its end as long as tan a < r / half.
TEST(Cylinder, TipsOverAtTheRightAngle) {
  const double border = std::atan(0.02 / 0.03);
  for (const double slope : {border - 0.004, border + 0.004}) {
    Playground play = onSlope(slope, cylinder(0.2, 0.03, 0.02, 5), 0.03, kStanding);
    play.steps(1000);
    const Vec3 axis = play.state.bodies[0].turned * Vec3::UnitZ();
    const double upright = axis.dot(Vec3(-std::sin(slope), std::cos(slope), 0));
    EXPECT_EQ(upright<0.999, slope> border) << slope << " " << upright;
  }
}

// The lowest point of a cylinder in any pose, against a floor and against the corner of a box.
TEST(Cylinder, MeetsAPlaneExactlyInAnyPose) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Body round = cylinder(1, 0.03, 0.02, 0), plate = block(2, 1, Vec3(1, 0.1, 1), 0);
  for (int i = 0; i < 2000; ++i) {
    BodyState on, below;
    on.turned = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Vec3 axis = on.turned * Vec3::UnitZ();
    const double lowest = 0.03 * std::abs(axis.y()) + 0.02 * std::sqrt(std::max(0.0, 1 - axis.y() * axis.y()));
    on.centre = Vec3(0, 0.1 + lowest + 1e-4, 0);
    PlacedRoom room_a, room_b;
    Manifold found;
    ASSERT_TRUE(findManifold(placed(round.shape.parts[0], on, room_a), placed(plate.shape.parts[0], below, room_b),
                             0.01, found));
    double least = 1;
    for (const ManifoldPoint& point : found.points) least = std::min(least, point.gap);
    EXPECT_NEAR(least, 1e-4, 1e-9) << axis.transpose();
    EXPECT_NEAR(found.normal.y(), 1, 1e-12);
  }
}

TEST(Cylinder, IsTouchedAtItsSideByCornersAndBallsExactly) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Body round = cylinder(1, 0.03, 0.02, 0), cube = block(2, 1, Vec3::Constant(0.01), 0), small = ball(3, 1, 0.005, 0);
  const Mat3 on_corner = Eigen::Quaterniond::FromTwoVectors(Vec3::Ones(), -Vec3::UnitX()).toRotationMatrix();
  for (int i = 0; i < 500; ++i) {
    const double angle = 4 * uniform(random), height = 0.02 * uniform(random);
    const Vec3 outward(std::cos(angle), std::sin(angle), 0);
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    BodyState still, other;
    other.turned = Eigen::Quaterniond(Mat3(turn * on_corner));
    other.centre = (0.02 + 0.01 * std::sqrt(3.0) + 1e-5) * outward + height * Vec3::UnitZ();
    PlacedRoom room_a, room_b;
    Manifold found;
    ASSERT_TRUE(findManifold(placed(round.shape.parts[0], still, room_a), placed(cube.shape.parts[0], other, room_b),
                             0.001, found));
    EXPECT_LT((found.normal + outward).norm(), 1e-6) << angle;
    EXPECT_NEAR(found.points[0].gap, 1e-5, 1e-9) << angle;
    other.centre = (0.025 + 1e-5) * outward + height * Vec3::UnitZ();
    ASSERT_TRUE(findManifold(placed(round.shape.parts[0], still, room_a), placed(small.shape.parts[0], other, room_b),
                             0.001, found));
    EXPECT_LT((found.normal + outward).norm(), 1e-12);
    EXPECT_NEAR(found.points[0].gap, 1e-5, 1e-12);
  }
}

// Hulls that fall onto a floor come to rest on a face: none of a vertex is below it.
TEST(Hull, FallsAndComesToRestOnAFace) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Convex shape = hullOf(randomPoints(seed, 40, true)).shape;
    const Mass mass = massOfShape(0.2, shape);
    shape = moved(std::move(shape), -mass.centre_O);
    World world;
    world.fixed = floorScene();
    world.fixed_surface = {0.5, 0.5, 0};
    world.bodies = {{1, mass, shape, {0.5, 0.5, 0}}};
    Playground play(std::move(world), {placeAt(Vec3(0, 0.1, 0) - mass.centre_O)});
    play.steps(4000);
    const BodyState& body = play.state.bodies[0];
    int low = 0;
    for (const Vec3& vertex : shape.vertices) {
      const double height = (body.centre + body.turned * vertex).y();
      EXPECT_GT(height, -1e-5) << seed;
      low += height < 1e-5 ? 1 : 0;
    }
    EXPECT_GE(low, 3) << seed;
    EXPECT_LT(body.velocity.norm(), 1e-4) << seed;
  }
}

BodySpec specOf(BodyShape shape) {
  BodySpec spec;
  spec.shape = shape;
  spec.density_kg_m3 = 1000;
  return spec;
}

// Of a box that is off its object's origin: the hull is the box itself.
TEST(BodyOf, AHullHasTheMassAndThePlaceOfItsMesh) {
  const Vec3 half(0.01, 0.02, 0.03), at(0.1, -0.2, 0.3);
  Model model = boxModel(half);
  for (Vec3& vertex : model.positions) vertex += at;
  const Body hull = bodyOf(model, specOf(BodyShape::kHull));
  const Mass box = massOfBox(8000 * half.prod(), half);
  EXPECT_NEAR(hull.mass.mass_kg, box.mass_kg, 1e-12);
  EXPECT_LT((hull.mass.centre_O - at).norm(), 1e-12);
  EXPECT_LT((hull.mass.inertia_kg_m2 - box.inertia_kg_m2).norm(), 1e-12 * box.inertia_kg_m2.norm());
  EXPECT_NEAR(hull.shape.reach, half.norm(), 1e-12);
  EXPECT_LT(hull.hull_error_m, 1e-12);
}

// A vertex out there is no part of what is felt, but would be one of the shape.
TEST(BodyOf, AVertexBeyondReachIsRefused) {
  Model model = boxModel(Vec3(0.01, 0.02, 0.03));
  model.positions.emplace_back(-1.8e306, 0.002, 0.02);
  model.triangles.push_back({0, 1, static_cast<std::uint32_t>(model.positions.size() - 1)});
  for (const BodyShape shape : {BodyShape::kBox, BodyShape::kBall, BodyShape::kHull, BodyShape::kParts})
    EXPECT_THROW(bodyOf(model, specOf(shape)), Error);
}

TEST(BodyOf, AVertexOfNoElementIsNoCornerOfTheHull) {
  Model model = boxModel(Vec3(0.01, 0.02, 0.03));
  const double reach = bodyOf(model, specOf(BodyShape::kHull)).shape.reach;
  model.positions.emplace_back(5, 0, 0);
  EXPECT_EQ(bodyOf(model, specOf(BodyShape::kHull)).shape.reach, reach);
}

// What is beyond reach is not felt, and no body needs room there: with a room of all numbers no query has an end.
TEST(RoomAround, EndsWhereThingsAreFelt) {
  const Box room = roomAround({Vec3(-1.8e306, -1, 0), Vec3(1, 1, 1.8e306)});
  EXPECT_LE(room.min.cwiseAbs().maxCoeff(), 4e9);
  EXPECT_LE(room.max.cwiseAbs().maxCoeff(), 4e9);
  const Box near = roomAround({Vec3(-1, -2, -3), Vec3(1, 2, 3)});
  EXPECT_EQ(near.min, Vec3(-7, -8, -9));
  EXPECT_EQ(near.max, Vec3(7, 8, 9));
}

TEST(IsMatterWithin, OfBodiesAndNotOfWhatNoneCanBe) {
  const Vec3 half(0.01, 0.02, 0.03);
  const Model model = boxModel(half);
  const Solid box = solidOf(model.positions, model.triangles);
  const Box bounds{-half, half};
  EXPECT_TRUE(isMatterWithin(bounds, box));
  Solid wrong = box;
  wrong.centre_O.x() = 0.011;
  EXPECT_FALSE(isMatterWithin(bounds, wrong)) << "beyond its bounds";
  wrong = box;
  wrong.volume_m3 = -wrong.volume_m3;
  EXPECT_FALSE(isMatterWithin(bounds, wrong));
  wrong = box;
  wrong.inertia_m5 *= 4;
  EXPECT_FALSE(isMatterWithin(bounds, wrong)) << "more than if all were at the corners";
  wrong = box;
  wrong.inertia_m5(0, 0) = wrong.inertia_m5(1, 1) + wrong.inertia_m5(2, 2) + 1e-12;
  EXPECT_FALSE(isMatterWithin(bounds, wrong)) << "one is more than both others";
}

// A body is made once, however many frames show it; of a shape that has gone nothing is kept.
TEST(MadeBodies, AreMadeOnceForAShapeAndASpec) {
  const auto shape = makeShape(boxModel(Vec3(0.01, 0.02, 0.03)));
  BodySpec spec = specOf(BodyShape::kHull);
  const auto first = madeBody(shape, spec);
  EXPECT_EQ(first->mass.mass_kg, bodyOf(shape->model, spec).mass.mass_kg);
  spec.velocity_m_s = Vec3(1, 2, 3);
  EXPECT_EQ(madeBody(shape, spec), first);
  spec.density_kg_m3 *= 2;
  const auto heavier = madeBody(shape, spec);
  EXPECT_DOUBLE_EQ(heavier->mass.mass_kg, 2 * first->mass.mass_kg);
  const auto same_mesh = makeShape(boxModel(Vec3(0.01, 0.02, 0.03)));
  EXPECT_NE(madeBody(same_mesh, spec), heavier) << "of another shape";
  for (std::size_t i = 0; i < 3 * kMaxOfAShape; ++i) {
    spec.density_kg_m3 += 1;
    madeBody(shape, spec);
  }
  EXPECT_EQ(first.use_count(), 1) << "the oldest of a shape are forgotten";
}

TEST(MadeBodies, WhatCannotBeMadeIsRefusedEachTime) {
  Model flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.triangles = {{0, 1, 2}};
  const auto shape = makeShape(flat);
  for (int i = 0; i < 2; ++i) EXPECT_THROW(madeBody(shape, specOf(BodyShape::kHull)), Error);
}

// The round sides say along which axis it is, whether it is a rod or a disc; else the longest.
TEST(BodyOf, ACylinderLiesAlongTheAxisOfItsBounds) {
  struct Case {
    Vec3 half;
    int axis;
  };
  for (const auto& [half, axis] : {Case{Vec3(0.02, 0.003, 0.02), 1}, Case{Vec3(0.05, 0.01, 0.01005), 0},
                                   Case{Vec3(0.01, 0.02, 0.03), 2}, Case{Vec3(0.02, 0.02, 0.003), 2}}) {
    const Body body = bodyOf(boxModel(half), specOf(BodyShape::kCylinder));
    const double r = std::max(half[(axis + 1) % 3], half[(axis + 2) % 3]), length = 2 * half[axis];
    EXPECT_NEAR(body.mass.mass_kg, 1000 * EIGEN_PI * r * r * length, 1e-9);
    EXPECT_NEAR(body.mass.inertia_kg_m2(axis, axis), body.mass.mass_kg * r * r / 2, 1e-12);
    EXPECT_LT((body.shape.parts[0].faces[1].normal - Vec3::Unit(axis)).norm(), 1e-12);
    EXPECT_EQ(body.shape.parts[0].round_radius, r);
  }
}

}  // namespace
}  // namespace hl::test_shapes

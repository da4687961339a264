// What is left out of a search, against places that the ball touches.
#include "surfaces/slab_pieces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/scenes.h"
#include "index_judge.h"

namespace hl::test_slab_pieces {
namespace {

using test::Random;

GridFrame randomGrid(Random& random) {
  Mat3 axes = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix();
  for (Eigen::Index axis = 0; axis < 3; ++axis) axes.col(axis) = axes.col(axis) * random.uniform(0.5, 2);
  if (random.below(2) == 0) axes += 0.3 * Mat3(Vec3(random.inCube(1)) * random.inCube(1).transpose());
  const double scale = std::pow(10.0, random.uniform(-5, 2));
  return {scale * axes, random.below(2) * scale * random.inCube(100)};
}

// A ball goes past a place of a piece: when it is first touched, as a fraction of the motion; above 1: never.
double touchedAt(const Vec3& from, const Vec3& motion, double radius, const Vec3& place) {
  const Vec3 w = from - place;
  const double a = motion.squaredNorm(), b = w.dot(motion), c = w.squaredNorm() - radius * radius;
  if (c <= 0) return 0;
  const double disc = b * b - a * c;
  return b < 0 && disc >= 0 ? (-b - std::sqrt(disc)) / a : 2;
}

TEST(SlabPieces, NoPieceIsLeftOutAndNoneComesAfterTheBallTouchesIt) {
  Random random(5);
  int touched = 0, late = 0;
  for (int i = 0; i < 200'000 * test::longer(); ++i) {
    const GridFrame frame = randomGrid(random);
    const GridMetric metric(frame);
    const double cell = std::cbrt(std::abs(frame.axes.determinant()));
    const double radius = cell * std::pow(10.0, random.uniform(-1, 2));
    const Vec3 middle = random.inCube(50), off = random.inCube(0.5), normal = random.inCube(1);
    const double rest = random.below(2) * std::pow(10.0, random.uniform(-6, 1));
    const double value = random.uniform(-1, 1) * rest - normal.dot(off);
    const Vec3 at = middle + off, place = frame.point(at.x(), at.y(), at.z());
    const Vec3 from = place + radius * random.uniform(0.9, 1.3) * random.direction();
    const Vec3 motion = random.below(4) == 0
                            ? Vec3(Vec3::Zero())
                            : Vec3(radius * std::pow(10.0, random.uniform(-3, 1)) * random.direction());
    const bool moves = motion.squaredNorm() > 0;
    GridBall ball(metric, from, motion, radius);
    const double begin = random.below(2) * random.uniform(0, 0.5), end = random.below(2) == 0 ? 1 : 0.75;
    if (moves) ball.setPart(begin, end);
    const double when = moves ? touchedAt(from + begin * motion, (end - begin) * motion, radius, place) : 0;
    const double distance = (from - place).norm();
    if (moves ? when > 1 - 1e-9 : distance > radius) continue;
    const SlabPieces pieces(ball, frame, 1);
    double order = moves ? begin : 0;
    ASSERT_TRUE(pieces.mayTouch(middle)) << i;
    ASSERT_TRUE(pieces.touched(middle, value, normal, rest + 1e-12, order)) << i;
    ASSERT_LE(order, moves ? begin + when * (end - begin) + 1e-12 : distance) << i;
    ++touched;
    late += order > (moves ? begin : 0) ? 1 : 0;
  }
  EXPECT_GT(touched, 20'000);
  EXPECT_GT(late, 2'000);
}

}  // namespace
}  // namespace hl::test_slab_pieces

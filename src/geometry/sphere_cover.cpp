#include "geometry/sphere_cover.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/features.h"

namespace hl {

namespace {

// Number of the longest edge; edge i is opposite vertex i.
std::size_t longestEdge(const Primitive& triangle) {
  std::array<double, 3> square{};
  for (std::size_t i = 0; i < 3; ++i) {
    square[i] = (triangle.vertex[kEdges[i].end] - triangle.vertex[kEdges[i].begin]).squaredNorm();
  }
  return static_cast<std::size_t>(std::max_element(square.begin(), square.end()) - square.begin());
}

Ball ballAround(const Primitive& primitive, const Vec3& centre) {
  Ball ball{centre, 0};
  for (const Vec3& v : primitive.vertex) ball.radius = std::max(ball.radius, (v - centre).norm());
  return ball;
}

// A triangle laid flat: the longest edge is the base from (0, 0) to (base, 0), the third vertex is (foot, height).
struct FlatTriangle {
  Vec3 origin, x, y;
  double base, foot, height;

  explicit FlatTriangle(const Primitive& triangle) {
    const std::size_t number = longestEdge(triangle);
    origin = triangle.vertex[kEdges[number].begin];
    const Vec3 along = triangle.vertex[kEdges[number].end] - origin;
    const Vec3 apex = triangle.vertex[number] - origin;
    base = along.norm();
    x = along / base;
    foot = std::clamp(apex.dot(x), 0.0, base);
    const Vec3 across = apex - apex.dot(x) * x;
    height = across.norm();
    y = height > 0 ? Vec3(across / height) : x.unitOrthogonal();
  }
  double left(double v) const { return foot * (v / height); }
  double right(double v) const { return base - (base - foot) * (v / height); }
  Vec3 at(double u, double v) const { return origin + u * x + v * y; }
};

// Rows of equal height along the base. Each row is split into cells of equal width over the part that the triangle
// covers; this is widest at the bottom of the row, as the apex projects onto the base. Returns the number of cells.
int scanConvert(const FlatTriangle& flat, double cell, FunctionRef<void(const Ball&)> visit) {
  int count = 0;
  const int rows = std::max(1, static_cast<int>(std::ceil(flat.height / cell)));
  const double row_height = flat.height / rows;
  for (int row = 0; row < rows; ++row) {
    const double v = row * row_height;
    const double width = flat.right(v) - flat.left(v);
    const int cells = std::max(1, static_cast<int>(std::ceil(width / cell)));
    const double radius = 0.5 * std::hypot(width / cells, row_height);
    for (int i = 0; i < cells; ++i) {
      visit(Ball{flat.at(flat.left(v) + (i + 0.5) * width / cells, v + 0.5 * row_height), radius});
    }
    count += cells;
  }
  return count;
}

void coverTriangle(const Primitive& triangle, double radius, FunctionRef<void(const Ball&)> visit) {
  const FlatTriangle flat(triangle);
  // A square cell of this side fits into a sphere of the wanted radius. Rows times cells is at most
  // (height / cell + 1) (base / cell + 1); the cell grows until the exact count is small enough.
  constexpr double kGrow = 1.1;
  double cell = std::max(
      {radius * std::numbers::sqrt2, flat.base / kCoverMax, std::sqrt(0.5 * flat.base * flat.height / kCoverMax)});
  while (scanConvert(flat, cell, [](const Ball&) {}) > kCoverMax) cell *= kGrow;
  scanConvert(flat, cell, visit);
}

void coverSegment(const Primitive& segment, double radius, FunctionRef<void(const Ball&)> visit) {
  const Vec3 along = segment.vertex[1] - segment.vertex[0];
  const double length = along.norm();
  const int cells = std::max(1, static_cast<int>(std::ceil(std::min<double>(kCoverMax, length / (2 * radius)))));
  for (int i = 0; i < cells; ++i) {
    visit(Ball{segment.vertex[0] + ((i + 0.5) / cells) * along, 0.5 * length / cells});
  }
}

}  // namespace

// The circle through the vertices of an acute triangle, else the longest edge is a diameter.
Ball boundingBall(const Primitive& primitive) {
  const auto& v = primitive.vertex;
  if (primitive.kind != PrimitiveKind::kTriangle) return ballAround(primitive, 0.5 * (v[0] + v[1]));
  const std::size_t number = longestEdge(primitive);
  const Vec3& apex = v[number];
  const Vec3 a = v[kEdges[number].begin] - apex;
  const Vec3 b = v[kEdges[number].end] - apex;
  if (a.dot(b) <= 0) return ballAround(primitive, 0.5 * (v[kEdges[number].begin] + v[kEdges[number].end]));
  const Vec3 n = a.cross(b);
  const Vec3 to_centre = (a.squaredNorm() * b - b.squaredNorm() * a).cross(n) / (2 * n.squaredNorm());
  const Ball circle = ballAround(primitive, apex + to_centre);
  // Rounding may make the circle of a thin triangle wrong; the ball on the longest edge is never much larger.
  const Ball diameter = ballAround(primitive, 0.5 * (v[kEdges[number].begin] + v[kEdges[number].end]));
  return circle.radius < diameter.radius ? circle : diameter;
}

void coverWithSpheres(const Primitive& primitive, double radius, FunctionRef<void(const Ball&)> visit) {
  const Ball ball = boundingBall(primitive);
  if (primitive.kind == PrimitiveKind::kPoint || !(ball.radius > radius)) {
    visit(ball);
  } else if (primitive.kind == PrimitiveKind::kSegment) {
    coverSegment(primitive, radius, visit);
  } else {
    coverTriangle(primitive, radius, visit);
  }
}

}  // namespace hl

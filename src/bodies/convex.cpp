#include "bodies/convex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/plain_math.h"

namespace hl {

namespace {

// Sine of the angle between edges below which they have one direction.
constexpr double kOneDirection = 1e-9;

// Each edge of a closed surface is met from both sides; the one from the lower vertex counts.
void addEdges(Convex& shape, const Convex::Face& face) {
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const Convex::Index begin = face.corners[i], end = face.corners[(i + 1) % face.corners.size()];
    if (begin > end) continue;
    const Vec3 way = (shape.vertices[end] - shape.vertices[begin]).normalized();
    const auto known = std::find_if(shape.directions.begin(), shape.directions.end(), [&](const auto& ends) {
      const Vec3 other = (shape.vertices[ends[1]] - shape.vertices[ends[0]]).normalized();
      return way.cross(other).norm() < kOneDirection;
    });
    const auto direction = static_cast<Convex::Index>(known - shape.directions.begin());
    if (known == shape.directions.end()) shape.directions.push_back({begin, end});
    shape.edges.push_back({begin, end, direction});
  }
}

void measureReach(Convex& shape) {
  shape.reach = 0;
  for (const Vec3& vertex : shape.vertices)
    shape.reach = std::max(shape.reach, (vertex - shape.middle).norm() + shape.radius);
}

double widthAlong(const Convex& shape, const Vec3& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& vertex : shape.vertices) {
    const double along = direction.dot(vertex);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return high - low;
}

// A polytope is thinnest across a face or between two edges: a tetrahedron of four corners nearly in a plane is much
// thicker across each of its faces.
void measureWidth(Convex& shape) {
  double least = std::numeric_limits<double>::infinity();
  for (const Convex::Face& face : shape.faces) least = std::min(least, widthAlong(shape, face.normal));
  const auto along = [&](const std::array<Convex::Index, 2>& ends) {
    return Vec3((shape.vertices[ends[1]] - shape.vertices[ends[0]]).normalized());
  };
  for (std::size_t i = 0; i < shape.directions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 across = along(shape.directions[i]).cross(along(shape.directions[j]));
      const double sine = across.norm();
      if (sine > kOneDirection) least = std::min(least, widthAlong(shape, across / sine));
    }
  }
  shape.thin = shape.radius + least / 2;
}

// Of a polygon, by Newell: the sum over its corners. Length: twice the area.
Vec3 areaOf(const std::vector<Vec3>& vertices, const std::vector<Convex::Index>& corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += (vertices[corners[i]] - vertices[corners[0]])
               .cross(vertices[corners[(i + 1) % corners.size()]] - vertices[corners[0]]);
  return sum;
}

}  // namespace

Convex ballShape(double radius) {
  Convex shape;
  shape.vertices = {Vec3::Zero()};
  shape.radius = shape.reach = shape.thin = radius;
  return shape;
}

Convex capsuleShape(double half_length, double radius) {
  Convex shape;
  shape.vertices = {half_length * Vec3::UnitZ(), -half_length * Vec3::UnitZ()};
  shape.edges = {{0, 1, 0}};
  shape.directions = {{0, 1}};
  shape.radius = shape.thin = radius;
  shape.reach = half_length + radius;
  return shape;
}

// Vertex i has the sign of bit 0 of i in x, of bit 1 in y, of bit 2 in z.
Convex boxShape(const Vec3& half) {
  Convex shape;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    shape.vertices.push_back(half.cwiseProduct(sign));
  }
  shape.edges = {{0, 1, 0}, {2, 3, 0}, {4, 5, 0}, {6, 7, 0}, {0, 2, 1}, {1, 3, 1},
                 {4, 6, 1}, {5, 7, 1}, {0, 4, 2}, {1, 5, 2}, {2, 6, 2}, {3, 7, 2}};
  shape.directions = {{0, 1}, {0, 2}, {0, 4}};
  shape.faces = {{-Vec3::UnitX(), {0, 4, 6, 2}}, {Vec3::UnitX(), {1, 3, 7, 5}},  {-Vec3::UnitY(), {0, 1, 5, 4}},
                 {Vec3::UnitY(), {2, 6, 7, 3}},  {-Vec3::UnitZ(), {0, 2, 3, 1}}, {Vec3::UnitZ(), {4, 5, 7, 6}}};
  shape.reach = half.norm();
  shape.thin = half.minCoeff();
  return shape;
}

Convex polyhedronShape(std::vector<Vec3> vertices, const std::vector<std::vector<Convex::Index>>& faces) {
  Convex shape;
  shape.vertices = std::move(vertices);
  for (const auto& corners : faces) shape.faces.push_back({areaOf(shape.vertices, corners).normalized(), corners});
  for (const Convex::Face& face : shape.faces) addEdges(shape, face);
  measureReach(shape);
  measureWidth(shape);
  return shape;
}

// Vertex 2 i is at the lower end, 2 i + 1 above it.
Convex cylinderShape(double half_length, double radius) {
  std::vector<Vec3> vertices;
  std::vector<std::vector<Convex::Index>> faces(2);
  for (std::size_t i = 0; i < kCylinderSides; ++i) {
    const double angle = 2 * EIGEN_PI * static_cast<double>(i) / kCylinderSides;
    const double x = radius * plain::cos(angle), y = radius * plain::sin(angle);
    vertices.emplace_back(x, y, -half_length);
    vertices.emplace_back(x, y, half_length);
    const auto low = static_cast<Convex::Index>(2 * i),
               next = static_cast<Convex::Index>((low + 2) % (2 * kCylinderSides));
    faces[0].insert(faces[0].begin(), low);
    faces[1].push_back(static_cast<Convex::Index>(low + 1));
    faces.push_back({low, next, static_cast<Convex::Index>(next + 1), static_cast<Convex::Index>(low + 1)});
  }
  Convex shape = polyhedronShape(std::move(vertices), faces);
  shape.round_radius = radius;
  return shape;
}

double heightAbove(const Convex& shape, const Vec3& point) {
  double highest = std::numeric_limits<double>::lowest();
  for (const Convex::Face& face : shape.faces)
    highest = std::max(highest, face.normal.dot(point - shape.vertices[face.corners[0]]));
  return highest;
}

Convex moved(Convex shape, const Vec3& way) {
  for (Vec3& vertex : shape.vertices) vertex += way;
  measureReach(shape);
  return shape;
}

Convex withMiddle(Convex shape, const Vec3& middle) {
  shape.middle = middle;
  measureReach(shape);
  return shape;
}

Convex triangleTopology() {
  Convex shape;
  shape.vertices.resize(3, Vec3::Zero());
  shape.edges = {{0, 1, 0}, {1, 2, 1}, {2, 0, 2}};
  shape.directions = {{0, 1}, {1, 2}, {2, 0}};
  shape.faces = {{Vec3::UnitZ(), {0, 1, 2}}, {-Vec3::UnitZ(), {0, 2, 1}}};
  return shape;
}

}  // namespace hl

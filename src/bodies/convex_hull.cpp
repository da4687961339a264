#include "bodies/convex_hull.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/plain_math.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace hl {

namespace {

constexpr double kFlat = 1e-6;  // thickness over size
// Faces whose middles are no farther from each other's planes become one; of the size.
constexpr const char* kCommand = "qhull C-1e-9";

struct Polyhedron {
  std::vector<std::size_t> points;                // numbers of the vertices
  std::vector<std::vector<Convex::Index>> faces;  // corners: places in `points`
};

// The memory of qhull, and a file for what it says, for one hull.
class Qhull {
 public:
  Qhull() : says_(std::fopen("/dev/null", "w"), &std::fclose) { qh_zero(&qhull_, says_.get()); }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  ~Qhull() {
    int blocks = 0, bytes = 0;
    qh_freeqhull(&qhull_, !qh_ALL);
    qh_memfreeshort(&qhull_, &blocks, &bytes);
  }
  // False: qhull found no hull.
  bool make(std::vector<double>& coordinates) {
    std::string command = kCommand;
    return qh_new_qhull(&qhull_, 3, static_cast<int>(coordinates.size() / 3), coordinates.data(), False, command.data(),
                        says_.get(), says_.get()) == 0;
  }
  // Numbers of the points at the corners of each face, counterclockwise.
  std::vector<std::vector<std::size_t>> faces() {
    std::vector<std::vector<std::size_t>> faces;
    for (facetT* facet = qhull_.facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
      setT* corners = qh_facet3vertex(&qhull_, facet);
      faces.emplace_back();
      for (int i = 0; i < qh_setsize(&qhull_, corners); ++i) {
        const auto* const vertex = static_cast<vertexT*>(SETelem_(corners, i));
        faces.back().push_back(static_cast<std::size_t>(qh_pointid(&qhull_, vertex->point)));
      }
      std::reverse(faces.back().begin(), faces.back().end());  // qhull's are clockwise
      qh_settempfree(&qhull_, &corners);
    }
    return faces;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> says_;
  qhT qhull_;
};

// Of points of a size of about 1 around the origin.
Polyhedron quickhull(const std::vector<Vec3>& points) {
  std::vector<double> coordinates;
  for (const Vec3& point : points) coordinates.insert(coordinates.end(), point.data(), point.data() + 3);
  Qhull qhull;
  if (!qhull.make(coordinates)) throw Error("hull: the points are too near to a plane or a line for a hull");
  Polyhedron hull;
  const auto faces = qhull.faces();
  for (const auto& face : faces) hull.points.insert(hull.points.end(), face.begin(), face.end());
  std::sort(hull.points.begin(), hull.points.end());
  hull.points.erase(std::unique(hull.points.begin(), hull.points.end()), hull.points.end());
  for (const auto& face : faces) {
    hull.faces.emplace_back();
    for (const std::size_t point : face)
      hull.faces.back().push_back(static_cast<Convex::Index>(
          std::lower_bound(hull.points.begin(), hull.points.end(), point) - hull.points.begin()));
  }
  return hull;
}

std::vector<Vec3> taken(const std::vector<Vec3>& points, const std::vector<std::size_t>& numbers) {
  std::vector<Vec3> some;
  for (const std::size_t number : numbers) some.push_back(points[number]);
  return some;
}

// How far a point is outside, by the face that it is farthest above.
double outside(const Convex& hull, const Vec3& point) {
  double highest = 0;
  for (const Convex::Face& face : hull.faces)
    highest = std::max(highest, face.normal.dot(point - hull.vertices[face.corners[0]]));
  return highest;
}

// The first point that lies farthest outside; `distance`: how far.
std::size_t farthestOutside(const Convex& hull, const std::vector<Vec3>& points, double& distance) {
  std::size_t farthest = 0;
  distance = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double here = outside(hull, points[i]);
    if (here > distance) {
      distance = here;
      farthest = i;
    }
  }
  return farthest;
}

// The extreme points along the axes: at least a tetrahedron, or what qhull says of it.
std::vector<Vec3> extremes(const std::vector<Vec3>& points) {
  std::vector<Vec3> some;
  for (const Vec3& direction :
       {Vec3(1, 0, 0), Vec3(-1, 0.1, 0), Vec3(0, 1, 0.1), Vec3(0.1, -1, 0), Vec3(0, 0.1, 1), Vec3(0.1, 0, -1)}) {
    const Vec3& most = *std::max_element(points.begin(), points.end(), [&](const Vec3& x, const Vec3& y) {
      return direction.dot(x) < direction.dot(y);
    });
    if (std::find(some.begin(), some.end(), most) == some.end()) some.push_back(most);
  }
  return some;
}

Convex shapeOf(const std::vector<Vec3>& points) {
  const Polyhedron hull = quickhull(points);
  return polyhedronShape(taken(points, hull.points), hull.faces);
}

Convex simplified(const std::vector<Vec3>& vertices) {
  std::vector<Vec3> kept = extremes(vertices);
  Convex shape = shapeOf(kept);
  double distance = 0;
  while (kept.size() < kMostVertices) {
    kept.push_back(vertices[farthestOutside(shape, vertices, distance)]);
    shape = shapeOf(kept);
  }
  return shape;
}

// The middle of the box around the points, and half of its diagonal. Throws for points that have no hull.
void demandSolid(std::span<const Vec3> points, Vec3& middle, double& size) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& point : points) {
    if (!point.allFinite()) throw Error("hull: a point is not finite");
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  middle = (low + high) / 2;
  size = points.empty() ? 0 : (high - low).norm() / 2;
  Mat3 second = Mat3::Zero();
  if (size > 0) {
    for (const Vec3& point : points) {
      const Vec3 way = (point - points[0]) / size;
      second += way * way.transpose() / static_cast<double>(points.size());
    }
  }
  const Vec3 thin = Eigen::SelfAdjointEigenSolver<Mat3>(second).eigenvectors().col(0);
  double least = 1e300, most = -1e300;
  for (const Vec3& point : points) {
    least = std::min(least, thin.dot(point - middle));
    most = std::max(most, thin.dot(point - middle));
  }
  if (points.size() < 4 || !(most - least > kFlat * size))
    throw Error("hull: the points lie in a plane: give the shape a thickness, or use a box");
}

}  // namespace

Hull hullOf(std::span<const Vec3> points) {
  Vec3 middle;
  double size = 0;
  demandSolid(points, middle, size);
  std::vector<Vec3> scaled;
  for (const Vec3& point : points) scaled.emplace_back((point - middle) / size);
  const std::vector<Vec3> vertices = taken(scaled, quickhull(scaled).points);
  Convex shape = vertices.size() > kMostVertices ? simplified(vertices) : shapeOf(vertices);
  Hull hull;
  farthestOutside(shape, vertices, hull.error_m);
  hull.error_m *= size;
  for (Vec3& vertex : shape.vertices) vertex *= size;
  hull.shape = moved(std::move(shape), middle);
  return hull;
}

Convex coneShape(double half_length, double radius) {
  std::vector<Vec3> points{half_length * Vec3::UnitZ()};
  for (std::size_t i = 0; i < kCylinderSides; ++i) {
    const double angle = 2 * EIGEN_PI * static_cast<double>(i) / kCylinderSides;
    points.emplace_back(radius * plain::cos(angle), radius * plain::sin(angle), -half_length);
  }
  return hullOf(points).shape;
}

}  // namespace hl

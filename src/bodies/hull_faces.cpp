#include "bodies/hull_faces.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "base/error.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace hl {

namespace {

// Faces whose middles are no farther from each other's planes become one; of the size.
constexpr const char* kCommand = "qhull C-1e-9";

using Numbers = std::vector<std::size_t>;

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
  std::vector<HalfSpace> planes() const {
    std::vector<HalfSpace> planes;
    for (const facetT* facet = qhull_.facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next)
      planes.push_back({Vec3(facet->normal[0], facet->normal[1], facet->normal[2]), -facet->offset});
    return planes;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> says_;
  qhT qhull_;
};

// Of points of a size of about 1 around the origin; throws if there is no hull. `coordinates` are to stay.
void make(Qhull& qhull, const std::vector<Vec3>& points, std::vector<double>& coordinates) {
  for (const Vec3& point : points) coordinates.insert(coordinates.end(), point.data(), point.data() + 3);
  if (!qhull.make(coordinates)) throw Error("hull: the points are too near to a plane or a line for a hull");
}

HullFaces quickhull(const std::vector<Vec3>& points) {
  std::vector<double> coordinates;
  Qhull qhull;
  make(qhull, points, coordinates);
  HullFaces hull;
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

// The first point that lies farthest outside; `distance`: how far.
std::size_t farthestOutside(const Convex& hull, const std::vector<Vec3>& points, double& distance) {
  std::size_t farthest = 0;
  distance = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double here = heightAbove(hull, points[i]);
    if (here > distance) {
      distance = here;
      farthest = i;
    }
  }
  return farthest;
}

// The extreme points along the axes: at least a tetrahedron, or what qhull says of it. Numbers of points.
Numbers extremes(const std::vector<Vec3>& points) {
  Numbers some;
  for (const Vec3& direction :
       {Vec3(1, 0, 0), Vec3(-1, 0.1, 0), Vec3(0, 1, 0.1), Vec3(0.1, -1, 0), Vec3(0, 0.1, 1), Vec3(0.1, 0, -1)}) {
    const auto most = std::max_element(points.begin(), points.end(), [&](const Vec3& x, const Vec3& y) {
      return direction.dot(x) < direction.dot(y);
    });
    const auto number = static_cast<std::size_t>(most - points.begin());
    if (std::find(some.begin(), some.end(), number) == some.end()) some.push_back(number);
  }
  return some;
}

// The hull of some of the points, by their numbers among all.
HullFaces hullOfSome(const std::vector<Vec3>& points, const Numbers& some) {
  HullFaces hull = quickhull(pointsOf(points, some));
  for (std::size_t& point : hull.points) point = some[point];
  return hull;
}

Convex shapeOf(const std::vector<Vec3>& points, const HullFaces& hull) {
  return polyhedronShape(pointsOf(points, hull.points), hull.faces);
}

HullFaces simplified(const std::vector<Vec3>& points) {
  Numbers kept = extremes(points);
  HullFaces hull = hullOfSome(points, kept);
  double distance = 0;
  while (kept.size() < kMaxVertices) {
    kept.push_back(farthestOutside(shapeOf(points, hull), points, distance));
    hull = hullOfSome(points, kept);
  }
  return hull;
}

}  // namespace

HullFaces hullFaces(const std::vector<Vec3>& points) {
  const Numbers corners = quickhull(points).points;
  const std::vector<Vec3> vertices = pointsOf(points, corners);
  HullFaces hull = vertices.size() > kMaxVertices ? simplified(vertices) : quickhull(vertices);
  farthestOutside(shapeOf(vertices, hull), vertices, hull.error);
  for (std::size_t& point : hull.points) point = corners[point];
  return hull;
}

std::vector<HalfSpace> unitHullPlanes(const std::vector<Vec3>& points) {
  std::vector<double> coordinates;
  Qhull qhull;
  make(qhull, points, coordinates);
  return qhull.planes();
}

}  // namespace hl

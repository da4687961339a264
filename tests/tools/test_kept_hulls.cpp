// The hulls that the page without a server keeps are those that qhull finds.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "bodies/convex_hull.h"
#include "bodies/mesh_parts.h"
#include "builtin.h"
#include "web/kept_hulls.h"

namespace hl::test_kept_hulls {
namespace {

// The corners of each piece of a mesh, of which its hull is asked for at first.
std::vector<std::vector<Vec3>> cornersOfPieces(const Model& model) {
  std::vector<std::vector<Vec3>> corners;
  for (PieceMesh& mesh : meshesOfPieces(model)) corners.push_back(std::move(mesh.vertices));
  return corners;
}

// Each set of points of which a body's shape is a hull.
std::vector<std::vector<Vec3>> hulledPoints(const SceneBody& body) {
  if (body.spec.fixed) return {};
  if (body.spec.shape == BodyShape::kHull) return {body.model.positions};
  if (body.spec.shape == BodyShape::kParts) return cornersOfPieces(body.model);
  return {};
}

// With HL_KEPT_HULLS=FILE they are written there: web/kept_hulls.inc.
TEST(KeptHulls, AreThoseOfTheBuiltInScenes) {
  std::string lines;
  for (const char* name : {"snaps", "workshop"}) {
    for (const SceneBody& body : makeBuiltinWorld(name).bodies) {
      for (const std::vector<Vec3>& hulled : hulledPoints(body)) {
        const std::vector<Vec3> points = unitPoints(hulled).points;
        const HullFaces hull = hullFaces(points);
        lines += lineOf(points, hull) + '\n';
        const auto kept = keptHull(keptHulls(), points);
        EXPECT_TRUE(kept && kept->points == hull.points && kept->faces == hull.faces && kept->error == hull.error)
            << name << ", " << body.name << ": write them anew";
      }
    }
  }
  if (const char* file = std::getenv("HL_KEPT_HULLS")) std::ofstream(file) << "R\"HULLS(\n" << lines << ")HULLS\"\n";
}

TEST(KeptHulls, ALineIsReadBackAsItWas) {
  const std::vector<Vec3> points{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {0.01, 0.01, 0.01}};
  const HullFaces hull = hullFaces(points);
  const auto read = keptHull("12 0\n" + lineOf(points, hull) + "\n", points);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->points, (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(read->faces, hull.faces);
  EXPECT_FALSE(keptHull(lineOf(points, hull), {{0, 0, 0}}));
}

}  // namespace
}  // namespace hl::test_kept_hulls

// C62: the built-in scenes have the sizes of the paper's, and normals that fit their triangles.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "builtin.h"
#include "io/load_scene.h"
#include "scene/snapshot.h"

namespace hl {
namespace {

void expectSound(const Model& model) {
  for (const auto& t : model.triangles) {
    const Vec3& a = model.positions[t[0]];
    const Vec3 face = (model.positions[t[1]] - a).cross(model.positions[t[2]] - a).normalized();
    for (const std::uint32_t index : t) {
      ASSERT_NEAR(model.normals[index].norm(), 1, 1e-9);
      ASSERT_GT(model.normals[index].dot(face), 0) << model.name;
    }
  }
  EXPECT_TRUE(makeSnapshot(model, HierarchyKind::kNone)->warnings.empty()) << model.name;
}

TEST(C62Builtin, TheTeapotHasThePapersSizeWithinOneInFourHundred) {
  const Model teapot = makeBuiltinScene("teapot");
  EXPECT_EQ(teapot.triangles.size(), 3408u);
  EXPECT_NEAR(static_cast<double>(teapot.triangles.size()), 3416, 3416 / 400.0);
  EXPECT_NEAR(teapot.bounds().size().x(), 0.2, 1e-3);
  for (const Vec3& normal : teapot.normals) ASSERT_NEAR(normal.norm(), 1, 1e-9);
  EXPECT_GT(makeBuiltinScene("teapot:20").triangles.size(), 24'000u);
}

TEST(C62Builtin, TheWalkerHasThePapersPolygons) {
  const Model walker = makeBuiltinScene("walker");
  EXPECT_EQ(walker.triangles.size(), 11'088u);
  expectSound(walker);
}

TEST(Builtin, SurfacesHaveAboutAsManyTrianglesAsAskedFor) {
  for (const char* name : {"terrain", "sphere", "plane", "pipe"}) {
    for (const int n : {1000, 50'000}) {
      const Model model = makeBuiltinScene(std::string(name) + ":" + std::to_string(n));
      EXPECT_NEAR(static_cast<double>(model.triangles.size()) / n, 1, 0.07) << model.name;
      expectSound(model);
    }
  }
}

TEST(Builtin, BadNamesAreRefusedWithTheList) {
  for (const char* spec :
       {"tea", "terrain:", "terrain:x", "terrain:-1", "terrain:0", "terrain:99999999999", "walker:3", ""}) {
    EXPECT_THROW(loadScene(spec), Error) << spec;
  }
}

}  // namespace
}  // namespace hl

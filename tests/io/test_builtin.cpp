// C62: the built-in scenes have the sizes of the paper's, and normals that fit their triangles.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "builtin.h"
#include "io/load_scene.h"
#include "scene/snapshot.h"

namespace hl::test_builtin {
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
  for (const char* name : {"terrain", "rough", "sphere", "plane", "pipe"}) {
    for (const int n : {1000, 50'000}) {
      const Model model = makeBuiltinScene(std::string(name) + ":" + std::to_string(n));
      EXPECT_NEAR(static_cast<double>(model.triangles.size()) / n, 1, 0.07) << model.name;
      expectSound(model);
    }
  }
}

TEST(Builtin, SoupIsInItsBoxAndLooksTheSameWhateverItsNumber) {
  for (const int n : {1, 1000, 64'000}) {
    const Model soup = makeBuiltinScene("soup:" + std::to_string(n));
    EXPECT_EQ(soup.triangles.size(), static_cast<std::size_t>(n));
    EXPECT_LE(soup.bounds().max.maxCoeff(), 0.1);
    EXPECT_GE(soup.bounds().min.minCoeff(), -0.1);
    expectSound(soup);
  }
  const Model soup = makeBuiltinScene("soup:1000");
  EXPECT_NEAR((soup.positions[1] - soup.positions[0]).norm(), 0.02, 1e-12);
}

TEST(Builtin, PitsHaveCreasesWhereTheMeshCanFollowThem) {
  const Model pits = makeBuiltinScene("pits:50000");
  EXPECT_NEAR(static_cast<double>(pits.triangles.size()) / 50'000, 1, 0.1);
  EXPECT_NEAR(pits.bounds().size().y(), 0.02, 1e-12);
  expectSound(pits);
  for (const auto& t : pits.triangles) {
    const Vec3& a = pits.positions[t[0]];
    const Vec3 face = (pits.positions[t[1]] - a).cross(pits.positions[t[2]] - a).normalized();
    ASSERT_NEAR(face.y(), 1 / std::sqrt(3), 1e-6);  // none lies across a crease
  }
}

TEST(Builtin, MembersOfAFamilyDifferAndEachStaysTheSame) {
  const Model one = makeBuiltinScene("rough:5000:1"), other = makeBuiltinScene("rough:5000:2");
  EXPECT_EQ(one.positions, makeBuiltinScene("rough:5000").positions);
  EXPECT_EQ(other.positions, makeBuiltinScene("rough:5000:2").positions);
  EXPECT_NE(one.positions, other.positions);
  for (int member = 1; member <= 20; ++member) {
    const Model model = makeBuiltinScene("rough:5000:" + std::to_string(member));
    EXPECT_LT(model.bounds().size().y(), 0.06) << member;  // a terrain, not a tower
    EXPECT_GT(model.bounds().size().y(), 0.003) << member;
  }
}

TEST(Builtin, AMemberIsAWholeNumber) {
  for (const char* spec : {"rough:5000:0", "rough:5000:", "rough:5000:x", "rough:5000:1:2", "terrain:5000:1"})
    EXPECT_THROW(makeBuiltinScene(spec), Error) << spec;
}

TEST(Builtin, ASceneOfOneSizeSaysSo) {
  try {
    loadScene("walker:3");
    ADD_FAILURE() << "it was taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "'walker:3': there is one walker, which takes no number");
  }
}

TEST(Builtin, BadNamesAreRefusedWithTheList) {
  for (const char* spec :
       {"tea", "terrain:", "terrain:x", "terrain:-1", "terrain:0", "terrain:99999999999", "walker:3", ""}) {
    EXPECT_THROW(loadScene(spec), Error) << spec;
  }
}

}  // namespace
}  // namespace hl::test_builtin

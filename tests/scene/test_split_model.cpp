// A model of several objects: each comes out as a model of its own, and what does not agree is refused.
#include "scene/split_model.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace hl::test_split_model {
namespace {

// A triangle; then a triangle and a segment, with normals.
Model twoObjects() {
  Model model;
  model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {7, 7, 7}};
  model.normals.assign(7, Vec3::UnitZ());
  model.triangles = {{0, 1, 2}, {5, 3, 4}};
  model.segments = {{3, 6}};
  model.warnings = {"a warning"};
  model.reading.joined_vertices = 3;
  model.parts = {{"one", {}, 3, 1, 0}, {"other", Rgb{1, 2, 3}, 4, 1, 1}};
  return model;
}

TEST(SplitModel, EachPartHasItsOwnVerticesAndElements) {
  const Model whole = twoObjects();
  checkParts(whole);
  const std::vector<Model> models = splitModel(whole);
  ASSERT_EQ(models.size(), 2U);
  EXPECT_EQ(models[0].positions, (std::vector<Vec3>{whole.positions.begin(), whole.positions.begin() + 3}));
  EXPECT_EQ(models[0].triangles, whole.triangles.size() == 2 ? std::vector{whole.triangles[0]} : whole.triangles);
  EXPECT_TRUE(models[0].segments.empty());
  EXPECT_EQ(models[0].warnings, whole.warnings);
  EXPECT_EQ(models[0].reading.joined_vertices, 3U);
  EXPECT_EQ(models[1].positions, (std::vector<Vec3>{whole.positions.begin() + 3, whole.positions.end()}));
  EXPECT_EQ(models[1].normals.size(), 4U);
  EXPECT_EQ(models[1].triangles, (std::vector<std::array<std::uint32_t, 3>>{{2, 0, 1}}));
  EXPECT_EQ(models[1].segments, (std::vector<std::array<std::uint32_t, 2>>{{0, 3}}));
  EXPECT_TRUE(models[1].warnings.empty());
}

TEST(SplitModel, PartsThatDoNotAgreeAreRefused) {
  const auto refused = [](auto change) {
    Model model = twoObjects();
    change(model);
    EXPECT_THROW(checkParts(model), Error);
  };
  refused([](Model& m) { m.parts.pop_back(); });
  refused([](Model& m) { m.parts[1].vertices = 3; });
  refused([](Model& m) { m.parts[1].triangles = 0xffffffff; });
  refused([](Model& m) { m.parts[0].vertices = 4, m.parts[1].vertices = 3; });
  refused([](Model& m) { m.triangles[1][0] = 2; });
  refused([](Model& m) { m.segments[0][1] = 7; });
  refused([](Model& m) { m.points = {0}; });
  refused([](Model& m) { m.triangle_materials = {0, 0}; });
  Model plain = twoObjects();
  plain.parts.clear();
  plain.points = {0};
  checkParts(plain);
}

}  // namespace
}  // namespace hl::test_split_model

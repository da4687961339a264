// What a scene file or a model says that nobody can feel: a warning with the line and the object's name, and no texture
// of it is left in the material.
#include "scene/idle_settings.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/load_scene_file.h"
#include "temp_folder.h"

namespace hl::test_idle_settings {
namespace {

using test::fileWith;
using test::tempFile;

// Two texels: black and white.
const std::string kTextures =
    R"("textures": [{"name": "two", "texels": {"width": 2, "height": 1, "values": "AP8="}},
                    {"name": "grey", "texels": {"width": 2, "height": 1, "values": "gIA="}},
                    {"name": "sine", "procedural": {"kind": "sine"}},
                    {"name": "checker", "procedural": {"kind": "checker"}}])";
const std::string kSquare = R"("vertices": [0, 0, 0,  1, 0, 0,  1, 0, -1,  0, 0, -1])";
const std::string kTexcoords = R"("texcoords": [0, 0,  1, 0,  1, 1,  0, 1])";
const std::string kFaces = R"("polygons": [{"vertices": [0, 1, 2, 3]}])";

SceneModel sceneOf(const std::string& objects) {
  return loadSceneFile(fileWith("idle.hl.json", "{" + kTextures + ",\n\"objects\": [" + objects + "]}"));
}

// The only warning of the scene, from its line's number on; "none".
std::string saidOf(const SceneModel& scene) {
  if (scene.model.warnings.empty()) return "none";
  EXPECT_EQ(scene.model.warnings.size(), 1U) << scene.model.warnings[1];
  const std::string file = tempFile("idle.hl.json") + ":";
  EXPECT_TRUE(scene.model.warnings[0].starts_with(file)) << scene.model.warnings[0];
  return scene.model.warnings[0].substr(file.size());
}

std::string objectOf(const std::string& primitives, const std::string& material) {
  return "{\"name\": \"board\", \"primitives\": {" + primitives + "},\n\"material\": {" + material + "}}";
}

std::string saidOfMaterial(const std::string& material) {
  return saidOf(sceneOf(objectOf(kSquare + "," + kTexcoords + "," + kFaces, material)));
}

std::string useOf(const std::string& texture, const std::string& quantity, const std::string& high = "0.001") {
  return R"("textures": [{"texture": ")" + texture + R"(", "quantity": ")" + quantity + R"(", "high": )" + high + "}]";
}

const std::string kAt = "6: objects[0].material ('board'): ";

TEST(IdleSettings, ATextureWithoutTexcoordsIsSaidAndLeftOut) {
  const std::string use = useOf("two", "DYNAMIC_FRICTION");
  const SceneModel bare = sceneOf(objectOf(kSquare + "," + kFaces, use));
  EXPECT_EQ(saidOf(bare), kAt + "its dynamic friction texture 'two' is not felt: there are no texture coordinates");
  EXPECT_FALSE(bare.model.materials[0].textureOf(Quantity::kDynamicFriction).used());
  const SceneModel lines = sceneOf(objectOf(kSquare + "," + kTexcoords + ", \"segments\": [0, 1]", use));
  EXPECT_EQ(saidOf(lines), kAt +
                               "its dynamic friction texture 'two' is not felt: only triangles have texture "
                               "coordinates, and there are none");
  EXPECT_FALSE(lines.model.materials[0].textureOf(Quantity::kDynamicFriction).used());
}

// In one mesh with an object that has them it has zeros for texture coordinates, and must not feel the first texel.
TEST(IdleSettings, WithoutTexcoordsIsSoBesideAnObjectThatHasThem) {
  const std::string use = useOf("two", "STIFFNESS", "0.5");
  const SceneModel scene =
      sceneOf(objectOf(kSquare + "," + kFaces, use) + "," + objectOf(kSquare + "," + kTexcoords + "," + kFaces, use));
  EXPECT_EQ(scene.model.warnings.size(), 1U);
  EXPECT_FALSE(scene.model.materials[0].textureOf(Quantity::kStiffness).used());
  EXPECT_TRUE(scene.model.materials[1].textureOf(Quantity::kStiffness).used());
}

TEST(IdleSettings, AHeightMapWithoutSlopeIsSaidAndLeftOut) {
  EXPECT_EQ(saidOfMaterial(useOf("sine", "HEIGHT")), "none");
  EXPECT_EQ(saidOfMaterial(useOf("two", "HEIGHT")),
            kAt + "its height texture 'two' is not felt: its pattern is narrower than 2 texels, and comes out flat");
  EXPECT_EQ(saidOfMaterial(useOf("grey", "HEIGHT")),
            kAt + "its height texture 'grey' is not felt: its texels are all equal");
  EXPECT_EQ(saidOfMaterial(useOf("sine", "HEIGHT", "0")),
            kAt + "its height texture 'sine' is not felt: low and high are equal");
  EXPECT_EQ(saidOfMaterial(R"("repeatU": 0, "repeatV": 0, )" + useOf("sine", "HEIGHT")),
            kAt + "its height texture 'sine' is not felt: the texture coordinates are all equal");
  EXPECT_EQ(saidOfMaterial(R"("repeatU": 0, )" + useOf("sine", "HEIGHT")),
            kAt + "its height texture 'sine' is not felt: it changes only along u, and the texture coordinates do not");
  EXPECT_EQ(saidOfMaterial(R"("repeatV": 0, )" + useOf("sine", "HEIGHT")), "none") << "along u it has its slope";
  EXPECT_EQ(saidOfMaterial(R"("repeatU": 0, )" + useOf("checker", "HEIGHT")), "none") << "along v it has a slope";
}

TEST(IdleSettings, OfABodyAndOfHeightsToo) {
  const std::string body = objectOf(kSquare + "," + kTexcoords + "," + kFaces, useOf("two", "HEIGHT"));
  const SceneModel moved = sceneOf(body.substr(0, body.size() - 1) + R"(, "body": {"fixed": true}})");
  EXPECT_NE(saidOf(moved).find("its height texture 'two' is not felt"), std::string::npos);
  EXPECT_FALSE(moved.bodies.at(0).model.materials[0].textureOf(Quantity::kHeight).used());
  const SceneModel hills = sceneOf(R"({"name": "board", "heights": {"columns": 2, "rows": 2, "values": [0, 0, 0, 0]},
      "material": {"repeatU": 0, "repeatV": 0, )" +
                                   useOf("sine", "HEIGHT") + "}}");
  EXPECT_NE(saidOf(hills).find("its height texture 'sine' is not felt"), std::string::npos);
  EXPECT_TRUE(hills.surfaces.at(0).textures.empty());
}

TEST(IdleSettings, NumbersThatDoNothingAreSaid) {
  EXPECT_EQ(saidOfMaterial(R"("stribeckMS": 0.1, )" + useOf("two", "STATIC_FRICTION")),
            kAt + "its Stribeck speed has no effect beside a texture of friction or viscosity");
  EXPECT_EQ(saidOfMaterial(R"("stribeckMS": 0.1, "staticFriction": 0.5, "dynamicFriction": 0.2)"), "none");
  EXPECT_EQ(saidOfMaterial(R"("staticFriction": 0.2, "dynamicFriction": 0.5)"),
            kAt + "its static friction of 0.2 is below its dynamic friction of 0.5, and counts as that");
  EXPECT_EQ(saidOfMaterial(R"("dynamicFriction": 0.5)"), "none") << "the other one is not said";
  EXPECT_EQ(saidOfMaterial(R"("stiffness": 0, "strengthN": 1)"),
            kAt + "its strength has no effect: nothing presses on a surface of stiffness 0");
  EXPECT_EQ(saidOfMaterial(R"("strengthN": 1)"), "none");
}

TEST(IdleSettings, ATextureWithoutQuantityIsSaid) {
  const SceneModel scene = sceneOf(
      objectOf(kSquare + "," + kTexcoords + "," + kFaces, "\n\"textures\": [\n{\"texture\": \"two\", \"high\": 0.5}]"));
  EXPECT_EQ(saidOf(scene), "8: objects[0].material.textures[0] ('board') says no quantity: STIFFNESS is taken");
  EXPECT_TRUE(scene.model.materials[0].textureOf(Quantity::kStiffness).used());
  EXPECT_EQ(saidOfMaterial(useOf("two", "STIFFNESS", "0.5")), "none");
}

TEST(IdleSettings, NamesInSmallLettersAreTaken) {
  const SceneModel scene =
      sceneOf(objectOf(kSquare + "," + kTexcoords + "," + kFaces, R"("shade": "flat", )" + useOf("sine", "height")));
  EXPECT_FALSE(scene.model.materials[0].smooth);
  EXPECT_TRUE(scene.model.materials[0].textureOf(Quantity::kHeight).used());
}

TEST(IdleSettings, OfAModelEachMaterialIsJudgedByItsTriangles) {
  Model model;
  model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  model.texcoords = {{0, 0}, {0, 0}, {0, 0}, {1, 1}};
  model.triangles = {{0, 1, 2}, {1, 3, 2}};
  model.triangle_materials = {0, 1};
  model.textures = {makeTexture("sine", 8)};
  model.materials.resize(2);
  for (Material& material : model.materials) material.textureOf(Quantity::kHeight) = {0, 0, 0.001};
  leaveIdleOut(model);
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_EQ(model.warnings[0],
            "material 0: its height texture 'sine' is not felt: the texture coordinates are all equal");
  EXPECT_FALSE(model.materials[0].textureOf(Quantity::kHeight).used());
  EXPECT_TRUE(model.materials[1].textureOf(Quantity::kHeight).used());
}

}  // namespace
}  // namespace hl::test_idle_settings

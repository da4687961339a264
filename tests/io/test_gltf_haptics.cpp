// What glTF files say about touch: friction and haptic textures reach the right triangles, and the rest is a warning.
#include "io/gltf_haptics.h"

#include <gtest/gtest.h>

#include <boost/gil.hpp>
#include <boost/gil/extension/io/png.hpp>
#include <string>

#include "io/load_model.h"
#include "temp_folder.h"

namespace hl::test_gltf_haptics {
namespace {

using test::fileWith;
using test::tempFile;

// Two nodes with one triangle each, moved to x = 0 and x = 10, and what a test adds to nodes, meshes and the root.
std::string gltf(const std::string& node_a, const std::string& node_b, const std::string& mesh_b,
                 const std::string& root) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0)" + node_a +
         R"(},{"mesh":1,"translation":[10,0,0])" + node_b +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},{"primitives":[{"attributes":{"POSITION":0}}])" +
         mesh_b + R"(}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}])" +
         root + "}";
}

std::string collider(int material) {
  return R"(,"extensions":{"KHR_physics_rigid_bodies":{"collider":{"geometry":{},"physicsMaterial":)" +
         std::to_string(material) + "}}}";
}

const char kPhysics[] =
    R"(,"extensions":{"KHR_physics_rigid_bodies":{"physicsMaterials":[{"staticFriction":0.9,"dynamicFriction":0.7},{}]}})";

// The material of the triangle whose first corner has x near `x`.
const Material& materialAt(const Model& model, double x) {
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    if (std::abs(model.positions[model.triangles[i][0]].x() - x) < 1.5)
      return model.materials[model.triangle_materials[i]];
  }
  return model.materials[0];
}

TEST(GltfHaptics, FrictionReachesTheTrianglesOfItsNode) {
  const Model model = loadModel(
      fileWith("two.gltf", gltf(R"(,"name":"ice")" + collider(1), R"(,"name":"rubber")" + collider(0), "", kPhysics)));
  ASSERT_EQ(model.triangle_materials.size(), 2u);
  EXPECT_EQ(materialAt(model, 0).static_friction, 0.6) << "the extension's own default";
  EXPECT_EQ(materialAt(model, 10).static_friction, 0.9);
  EXPECT_EQ(materialAt(model, 10).dynamic_friction, 0.7);
}

TEST(GltfHaptics, NodesThatCannotBeDistinguishedAreLeftOutWithAWarning) {
  const Model model = loadModel(
      fileWith("same.gltf", gltf(R"(,"name":"a")" + collider(0), R"(,"name":"a")" + collider(1), "", kPhysics)));
  EXPECT_TRUE(model.triangle_materials.empty());
  EXPECT_EQ(model.warnings.size(), 2u);
}

TEST(GltfHaptics, MpegTexturesAreReadWithTheirRange) {
  boost::gil::gray8_image_t image(2, 2, boost::gil::gray8_pixel_t(255), 0);
  boost::gil::write_view(tempFile("stiff.png"), boost::gil::const_view(image), boost::gil::png_tag{});
  const std::string root = R"(,"images":[{"uri":"stiff.png"}],"textures":[{"source":0}],
    "extensions":{"MPEG_haptic_material":{"materials":[{
      "stiffness":[{"texture":{"index":0},"type":"Reference","extras":{"low":0.2,"high":0.8}}],
      "friction":[{"texture":{"index":0},"type":"Reference"}], "temperature":[]}]}})";
  const std::string mesh = R"(,"extensions":{"MPEG_haptic_material":{"hapticMaterialIndex":0}})";
  const Model model = loadModel(fileWith("mpeg.gltf", gltf("", R"(,"name":"cloth")", mesh, root)));
  const Material& cloth = materialAt(model, 10);
  EXPECT_EQ(cloth.textureOf(Quantity::kStiffness).low, 0.2);
  EXPECT_EQ(cloth.textureOf(Quantity::kStiffness).high, 0.8);
  EXPECT_TRUE(cloth.textureOf(Quantity::kStaticFriction).used());
  EXPECT_TRUE(cloth.textureOf(Quantity::kDynamicFriction).used());
  EXPECT_FALSE(materialAt(model, 0).textureOf(Quantity::kStiffness).used());
  ASSERT_EQ(model.textures.size(), 2u);
  EXPECT_EQ(model.textures[0].sample({0.5, 0.5}), 1);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("temperature"), std::string::npos);
}

TEST(GltfHaptics, AnImageOfAnotherFolderIsLeftOut) {
  const std::string mesh = R"(,"extensions":{"MPEG_haptic_material":{"hapticMaterialIndex":0}})";
  for (const std::string name : {"../stiff.png", "/etc/passwd"}) {
    const std::string root = R"(,"images":[{"uri":")" + name + R"("}],"textures":[{"source":0}],
      "extensions":{"MPEG_haptic_material":{"materials":[{"stiffness":[{"texture":{"index":0}}]}]}})";
    const Model model = loadModel(fileWith("led.gltf", gltf("", R"(,"name":"cloth")", mesh, root)));
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_EQ(model.warnings[0], "a haptic texture was left out: names '" + name +
                                     "', which is not in its folder: put that file beside it");
  }
}

TEST(GltfHaptics, StrangeValuesOnlyWarn) {
  for (const char* root : {R"(,"extensions":{"KHR_physics_rigid_bodies":7})",
                           R"(,"extensions":{"KHR_physics_rigid_bodies":{"physicsMaterials":"x"}})",
                           R"(,"extensions":{"MPEG_haptic_material":{"materials":[[]]}})"}) {
    const Model model = loadModel(fileWith("odd.gltf", gltf(R"(,"name":"a")" + collider(99), "", "", root)));
    EXPECT_EQ(model.triangles.size(), 2u) << root;
    EXPECT_TRUE(model.triangle_materials.empty());
  }
}

}  // namespace
}  // namespace hl::test_gltf_haptics

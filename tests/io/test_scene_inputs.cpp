// SceneInputs: every file that a scene is read from, in whatever way it is named, and no other.
#include "io/scene_inputs.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "io/sha256.h"
#include "temp_folder.h"

namespace hl::test_scene_inputs {
namespace {

std::set<std::string> namesOf(const std::string& scene) {
  std::set<std::string> names;
  for (const SceneInput& input : sceneInputs(test::tempFile(scene))) names.insert(input.name);
  return names;
}

using Names = std::set<std::string>;

TEST(SceneInputs, ABuiltInSceneHasNone) {
  EXPECT_TRUE(sceneInputs("teapot").empty());
  EXPECT_TRUE(sceneInputs("rough:1000:3").empty());
}

TEST(SceneInputs, OfAnObjAreItsMaterialsAndTheirTextures) {
  test::fileWith("part.obj", "mtllib my part.mtl\nv 0 0 0\nv 1.5 0 0\nv 0 1.e5 0\nf 1 2 3\n");
  test::fileWith("my part.mtl", "newmtl a\nmap_Kd -s 1 1 1 wood.png\nmap_bump none.png\n");
  test::fileWith("wood.png", "no picture");
  test::fileWith("unrelated.mtl", "newmtl b\n");
  EXPECT_EQ(namesOf("part.obj"), (Names{"part.obj", "my part.mtl", "wood.png"}));
  const auto inputs = sceneInputs(test::tempFile("part.obj"));
  EXPECT_EQ(inputs[0].name, "part.obj");
  for (const SceneInput& input : inputs) EXPECT_EQ(input.sha256, sha256OfFile(test::tempFile(input.name)));
}

TEST(SceneInputs, OfASceneFileAreItsModelsAndImagesAndWhatTheyName) {
  test::fileWith("m.obj", "mtllib m.mtl\n");
  test::fileWith("m.mtl", "newmtl a\n");
  test::fileWith("h\xC3\xB6he.asc", "ncols 2\n");
  test::fileWith("t.png", "");
  test::fileWith("s.hl.json", R"({"textures": [{"name": "t", "file": "t.png"}], "objects": [{"file": "m.obj"},
    {"heights": {"file": "h\u00f6he.asc"}}, {"file": "none.obj"}, {"builtin": "teapot"}]})");
  EXPECT_EQ(namesOf("s.hl.json"), (Names{"s.hl.json", "m.obj", "m.mtl", "h\xC3\xB6he.asc", "t.png"}));
}

TEST(SceneInputs, OfAGltfAreItsBuffersAlsoBeneathAndEscaped) {
  std::filesystem::create_directory(test::tempFile("data"));
  test::fileWith("data/a b.bin", "x");
  test::fileWith("g.gltf", R"({"buffers": [{"uri": "data/a%20b.bin"}]})");
  EXPECT_EQ(namesOf("g.gltf"), (Names{"g.gltf", "data/a b.bin"}));
}

TEST(SceneInputs, OfAWorldAreThoseThatItIncludesAlsoEachOther) {
  test::fileWith("w.wrl", "#VRML V2.0 utf8\nInline { url \"v.wrl\" }\n");
  test::fileWith("v.wrl", "#VRML V2.0 utf8\nInline { url [\"w.wrl\"] }\n");
  EXPECT_EQ(namesOf("w.wrl"), (Names{"w.wrl", "v.wrl"}));
  test::fileWith("x.x3d", "<X3D><Scene><Inline url='\"v.wrl\"'/></Scene></X3D>");
  EXPECT_EQ(namesOf("x.x3d"), (Names{"x.x3d", "w.wrl", "v.wrl"}));
}

TEST(SceneInputs, OfAHeaderAreItsSamples) {
  test::fileWith("n.nhdr", "NRRD0004\ndata file: n.raw\n");
  test::fileWith("n.raw", "1234");
  EXPECT_EQ(namesOf("n.nhdr"), (Names{"n.nhdr", "n.raw"}));
}

TEST(SceneInputs, TheirNumbersChangeWithWhatIsInThem) {
  test::fileWith("c.obj", "mtllib c.mtl\n");
  test::fileWith("c.mtl", "newmtl a\n");
  const auto before = sceneInputs(test::tempFile("c.obj"));
  test::fileWith("c.mtl", "newmtl b\n");
  const auto after = sceneInputs(test::tempFile("c.obj"));
  ASSERT_EQ(before.size(), 2u);
  EXPECT_EQ(before[0].sha256, after[0].sha256);
  EXPECT_NE(before[1].sha256, after[1].sha256);
}

TEST(SceneInputs, AFileThatIsNotThereIsAnError) { EXPECT_THROW(sceneInputs("/nonexistent/a.obj"), Error); }

}  // namespace
}  // namespace hl::test_scene_inputs

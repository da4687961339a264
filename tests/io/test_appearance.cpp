// What models look like: the colours and pictures of their files come out as they are there, on the triangles that have
// them, and what cannot be shown is said in one line. Nothing of it is felt.
#include <gtest/gtest.h>
#include <spng.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <set>
#include <string>

#include "gltf_document.h"
#include "io/isolated.h"
#include "io/load_image.h"
#include "io/load_model.h"
#include "io/load_scene_file.h"
#include "io/model_messages.h"
#include "scene/split_model.h"
#include "temp_folder.h"

namespace hl::test_appearance {
namespace {

namespace fs = std::filesystem;
using test::fileWith;

const std::string kModels = "/usr/share/assimp/models/";

std::string pngOf(unsigned side) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> png(spng_ctx_new(SPNG_CTX_ENCODER), &spng_ctx_free);
  spng_ihdr header{side, side, 8, SPNG_COLOR_TYPE_GRAYSCALE, 0, 0, 0};
  spng_set_ihdr(png.get(), &header);
  spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1);
  const std::string pixels(std::size_t{side} * side, '\x7f');
  EXPECT_EQ(spng_encode_image(png.get(), pixels.data(), pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
  std::size_t size = 0;
  int failed = 0;
  void* const bytes = spng_get_png_buffer(png.get(), &size, &failed);
  std::string file(static_cast<const char*>(bytes), size);
  std::free(bytes);
  return file;
}

const Paint& paintOf(const Model& model, std::size_t triangle) {
  return model.appearance.paints.at(model.appearance.triangle_paints.at(triangle));
}

// Two triangles with an edge in common, each of a material of its own.
std::string twoTriangles(const std::string& materials) {
  fileWith("two.mtl", materials);
  return fileWith("two.obj",
                  "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
                  "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 2/2 4/4 3/3\n");
}

TEST(Appearance, SurfacesHaveTheColoursOfTheirMaterials) {
  const Model model = loadModel(twoTriangles("newmtl a\nKd 1 0 0.2\nnewmtl b\nKd 0 0.4 1\n"));
  ASSERT_EQ(model.triangles.size(), 2U);
  EXPECT_EQ(paintOf(model, 0).colour, (Rgb{255, 0, 51}));
  EXPECT_EQ(paintOf(model, 1).colour, (Rgb{0, 102, 255}));
  EXPECT_EQ(model.positions.size(), 4U) << "what it looks like keeps no vertices apart";
  EXPECT_TRUE(model.warnings.empty());
}

// Exporters write it where nobody has chosen a colour: then pages draw the model as others.
TEST(Appearance, OneGreyIsNoColour) {
  EXPECT_TRUE(loadModel(twoTriangles("newmtl a\nKd 0.8 0.8 0.8\nnewmtl b\nKd 0.8 0.8 0.8\n")).appearance.empty());
  EXPECT_FALSE(loadModel(twoTriangles("newmtl a\nKd 0 0 0\nnewmtl b\nKd 1 1 1\n")).appearance.empty());
  EXPECT_TRUE(loadModel(fileWith("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).appearance.empty());
}

// The product of matrices of KHR_texture_transform. The reader turns v around.
TEST(Appearance, PicturesOfGltfLieOverTheirOwnTextureCoordinatesAsTheyAreTransformed) {
  std::mt19937 random(3);
  const auto number = [&] { return std::uniform_real_distribution<float>(-2, 2)(random); };
  for (int round = 0; round < 20; ++round) {
    test::GltfDocument gltf;
    std::vector<float> coordinates;
    while (coordinates.size() < 6) coordinates.push_back(number());
    gltf.attribute("POSITION", gltf.add({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3, "VEC3"));
    gltf.attribute("TEXCOORD_0", gltf.add(std::vector<float>(6, 0.5F), 3, "VEC2"));
    gltf.attribute("TEXCOORD_1", gltf.add(coordinates, 3, "VEC2"));
    gltf.primitive = R"(,"material":0)";
    const float x = number(), y = number(), angle = number(), u = number(), v = number();
    fileWith("lies.png", pngOf(2));
    gltf.rest = fmt::format(
        R"(,"images":[{{"uri":"lies.png"}}],"textures":[{{"source":0}}],"materials":[{{"pbrMetallicRoughness":)"
        R"({{"baseColorTexture":{{"index":0,"texCoord":{},"extensions":{{"KHR_texture_transform":)"
        R"({{"offset":[{},{}],"rotation":{},"scale":[{},{}]{}}}}}}}}}}}])",
        round % 2, x, y, angle, u, v, round % 2 == 0 ? R"(,"texCoord":1)" : "");
    const Model model = loadModel(fileWith("lies.gltf", gltf.gltf()));
    EXPECT_TRUE(model.warnings.empty());
    ASSERT_EQ(model.texcoords.size(), 3u);
    ASSERT_TRUE(paintOf(model, 0).picture);
    for (std::size_t i = 0; i < 3; ++i) {
      const double s = static_cast<double>(u * coordinates[2 * i]), t = static_cast<double>(v * coordinates[2 * i + 1]);
      const double cosine = std::cos(static_cast<double>(angle)), sine = std::sin(static_cast<double>(angle));
      EXPECT_NEAR(model.texcoords[i].x(), cosine * s + sine * t + static_cast<double>(x), 1e-5);
      EXPECT_NEAR(1 - model.texcoords[i].y(), -sine * s + cosine * t + static_cast<double>(y), 1e-5);
    }
  }
}

TEST(Appearance, APictureOverTextureCoordinatesThatAreNotThereIsAWarning) {
  test::GltfDocument gltf;
  gltf.attribute("POSITION", gltf.add({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3, "VEC3"));
  gltf.primitive = R"(,"material":0)";
  fileWith("over.png", pngOf(2));
  gltf.rest = R"(,"images":[{"uri":"over.png"}],"textures":[{"source":0}],"materials":[{"pbrMetallicRoughness":)"
              R"({"baseColorTexture":{"index":0,"texCoord":3}}}])";
  const Model model = loadModel(fileWith("over.gltf", gltf.gltf()));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0],
            "meshes/0/primitives/0: has no TEXCOORD_3 that can be read, over which its picture lies");
}

TEST(Appearance, PicturesAreTheFilesThatMaterialsName) {
  const std::string png = pngOf(4);
  fileWith("wood.png", png);
  const Model model = loadModel(twoTriangles("newmtl a\nmap_Kd wood.png\nnewmtl b\nKd 0 0 0\nmap_Kd .\\wood.png\n"));
  ASSERT_EQ(model.appearance.pictures.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(paintOf(model, i).picture);
    EXPECT_EQ(*model.appearance.pictures[*paintOf(model, i).picture].file, png);
  }
  EXPECT_EQ(paintOf(model, 1).colour, (Rgb{255, 255, 255})) << "a black picture is not meant";
  EXPECT_EQ(model.texcoords.size(), model.positions.size());
}

TEST(Appearance, PicturesThatCannotBeShownAreNamed) {
  fileWith("text.png", "no picture");
  fileWith("huge.png", pngOf(8193));
  const auto warnings = [](const std::string& picture) {
    const Model model = loadModel(twoTriangles("newmtl a\nKd 1 0 0\nmap_Kd " + picture + "\nnewmtl b\n"));
    EXPECT_EQ(paintOf(model, 0).colour, (Rgb{255, 0, 0})) << "the colour is shown in its place";
    return model.warnings;
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(warnings("none.png"),
            Lines{"its picture 'none.png' is not shown: it names 'none.png', and there is no such file"});
  EXPECT_EQ(warnings("text.png"), Lines{"its picture 'text.png' is not shown: it is no PNG or JPEG file"});
  EXPECT_EQ(warnings("huge.png"),
            Lines{"its picture 'huge.png' is not shown: it has 8193 x 8193 pixels, and 8192 a side are the most"});
  EXPECT_EQ(
      warnings("/etc/passwd"),
      Lines{"its picture '/etc/passwd' is not shown: it names '/etc/passwd', which is not in its folder: put that "
            "file beside it"});
  std::string many;
  for (int i = 0; i < 9; ++i) many += "newmtl m" + std::to_string(i) + "\nmap_Kd " + std::to_string(i) + ".png\n";
  std::string obj = "mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
  for (int i = 0; i < 9; ++i) obj += "usemtl m" + std::to_string(i) + "\nf 1/1 2/1 3/1\n";
  fileWith("many.mtl", many);
  const Model model = loadModel(fileWith("many.obj", obj));
  ASSERT_EQ(model.warnings.size(), 4U);
  EXPECT_EQ(model.warnings.back(), "6 pictures more are not shown");
}

TEST(Appearance, VerticesHaveColours) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::string faces = "3 0 1 2\n3 1 3 2\n";
  const Model model =
      loadModel(fileWith("a.ply", ply + "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n1 1 0 9 8 7\n" + faces));
  ASSERT_EQ(model.appearance.vertex_colours.size(), model.positions.size());
  std::set<Rgb> seen(model.appearance.vertex_colours.begin(), model.appearance.vertex_colours.end());
  EXPECT_EQ(seen, (std::set<Rgb>{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {9, 8, 7}}));
  const std::string white = "0 0 0 255 255 255\n1 0 0 255 255 255\n0 1 0 255 255 255\n1 1 0 255 255 255\n";
  EXPECT_TRUE(loadModel(fileWith("a.ply", ply + white + faces)).appearance.empty());
  const Model vrml = loadModel(
      fileWith("a.wrl",
               "#VRML V2.0 utf8\nShape { appearance Appearance { material Material { diffuseColor 0 1 0.2 } } "
               "geometry Box { } }\nTransform { translation 3 0 0 children Shape { geometry Box { } } }\n"));
  ASSERT_EQ(vrml.appearance.vertex_colours.size(), vrml.positions.size());
  EXPECT_EQ(vrml.appearance.vertex_colours.front(), (Rgb{0, 255, 51}));
  EXPECT_NE(vrml.appearance.vertex_colours.back(), vrml.appearance.vertex_colours.front());
}

// Files of others. A picture that is within a file, in its text, or beside it, is the same.
TEST(Appearance, OfModelsOfOthers) {
  if (!fs::exists(kModels)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
  for (const std::string name :
       {"-glTF/BoxTextured.gltf", "-glTF-Binary/BoxTextured.glb", "-glTF-Embedded/BoxTextured.gltf"}) {
    const Model model = loadModel(kModels + "glTF2/BoxTextured" + name);
    ASSERT_EQ(model.appearance.pictures.size(), 1U) << name;
    const ImageSize size = sizeOfImage(*model.appearance.pictures[0].file);
    EXPECT_EQ(size.width, 211U);
    EXPECT_EQ(size.height, 211U);
    EXPECT_TRUE(model.warnings.empty());
  }
  const Model spider = loadModel(kModels + "OBJ/spider.obj");
  EXPECT_GE(spider.appearance.pictures.size(), 4U);
  EXPECT_TRUE(spider.appearance.fits(spider.triangles.size(), spider.positions.size()));
  EXPECT_EQ(loadModel(kModels + "OBJ/cube_with_vertexcolors.obj").appearance.vertex_colours.size(), 24U);
  std::set<Rgb> engine;
  for (const Paint& paint :
       loadModel(kModels + "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb").appearance.paints)
    engine.insert(paint.colour);
  EXPECT_GE(engine.size(), 7U);
}

// As recordings and the process that reads files send it.
TEST(Appearance, GoesThroughMessages) {
  fileWith("wood.png", pngOf(4));
  Model model = loadModel(twoTriangles("newmtl a\nKd 1 0 0.2\nnewmtl b\nmap_Kd wood.png\n"));
  model.appearance.vertex_colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {255, 0, 128}};
  model.appearance.pictures.push_back({model.appearance.pictures[0].file, Wrap::kClamp});
  MeshReader reader;
  std::size_t parts = 0;
  std::vector<proto::RecordedShape> sent;
  writeMesh(model, [&](proto::RecordedShape& part) {
    ++parts;
    sent.push_back(part);
    reader.add(part);
  });
  EXPECT_EQ(parts, 2U) << "each with a picture";
  const Appearance got = reader.take().appearance;
  EXPECT_EQ(got.vertex_colours, model.appearance.vertex_colours);
  EXPECT_EQ(got.triangle_paints, model.appearance.triangle_paints);
  ASSERT_EQ(got.pictures.size(), 2U);
  EXPECT_EQ(*got.pictures[1].file, *model.appearance.pictures[0].file);
  EXPECT_EQ(got.pictures[1].wrap, Wrap::kClamp);
  ASSERT_EQ(got.paints.size(), 2U);
  EXPECT_EQ(got.paints[0].colour, (Rgb{255, 0, 51}));
  EXPECT_EQ(got.paints[1].picture, std::optional<std::uint32_t>(0));
  const auto refused = [&](const auto& spoil) {
    proto::RecordedShape bad = sent[0];
    bad.set_continues(false);
    spoil(bad);
    MeshReader other;
    try {
      other.add(bad);
      other.take();
    } catch (const Error&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto& part) { part.mutable_paints(1)->set_picture(1); }));
  EXPECT_TRUE(refused([](auto& part) { part.set_triangle_paints(0, 2); }));
  EXPECT_TRUE(refused([](auto& part) { part.add_triangle_paints(0); }));
  EXPECT_TRUE(refused([](auto& part) { part.mutable_vertex_colours()->push_back('a'); }));
  EXPECT_TRUE(refused([](auto& part) { part.mutable_vertex_colours()->append("abc"); }));
}

// Appended to others, and cut into parts.
TEST(Appearance, GoesAlongWithItsModel) {
  fileWith("wood.png", pngOf(4));
  twoTriangles("newmtl a\nKd 1 0 0.2\nnewmtl b\nmap_Kd wood.png\n");
  fileWith("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string scene = fileWith(
      "scene.hl.json",
      R"({"objects": [{"file": "plain.obj"}, {"file": "two.obj"}, {"file": "plain.obj"}, {"file": "two.obj"}]})");
  Model whole = loadSceneFile(scene).model;
  ASSERT_EQ(whole.triangles.size(), 6U);
  ASSERT_TRUE(whole.appearance.fits(6, whole.positions.size()));
  for (const std::size_t plain : {0, 3}) EXPECT_EQ(paintOf(whole, plain).colour, (Rgb{255, 255, 255}));
  for (const std::size_t red : {1, 4}) EXPECT_EQ(paintOf(whole, red).colour, (Rgb{255, 0, 51}));
  EXPECT_EQ(paintOf(whole, 2).picture, std::optional<std::uint32_t>(0));
  EXPECT_EQ(paintOf(whole, 5).picture, std::optional<std::uint32_t>(0));
  EXPECT_EQ(whole.appearance.pictures.size(), 1U) << "the file is there once";
  EXPECT_EQ(whole.appearance.paints.size(), 3U);
  whole.appearance.vertex_colours.resize(whole.positions.size());
  whole.appearance.vertex_colours[3] = {1, 2, 3};
  whole.triangle_materials.clear();
  whole.segment_materials.clear();
  whole.point_materials.clear();
  whole.parts = {{"a", {}, 3, 1, 0}, {"b", {}, 4, 2, 0}, {"c", {}, 7, 3, 0}};
  checkParts(whole);
  const std::vector<Model> parts = splitModel(whole);
  Model joined = whole;
  joined.parts[1].colour = Rgb{5, 6, 7};
  asOneObject(joined);
  EXPECT_TRUE(joined.parts.empty());
  EXPECT_EQ(paintOf(joined, 0).colour, (Rgb{255, 255, 255}));
  EXPECT_EQ(paintOf(joined, 1).colour, (Rgb{5, 6, 7}));
  EXPECT_EQ(paintOf(joined, 3).colour, (Rgb{255, 255, 255}));
  EXPECT_EQ(parts[1].appearance.vertex_colours.front(), (Rgb{1, 2, 3}));
  EXPECT_EQ(paintOf(parts[1], 0).colour, (Rgb{255, 0, 51}));
  EXPECT_EQ(paintOf(parts[2], 2).picture, std::optional<std::uint32_t>(0));
}

SceneModel sceneOf(const std::string& objects) {
  return loadSceneFile(fileWith("scene.hl.json", R"({"objects": [)" + objects + "]}"));
}

std::string refusalOf(const std::string& objects) {
  try {
    sceneOf(objects);
  } catch (const Error& error) {
    const std::string line = error.what();
    return line.substr(line.find(": ") + 2);
  }
  return "";
}

constexpr const char* kSquare =
    R"("primitives": {"vertices": [0,0,0, 1,0,0, 1,1,0], "triangles": [0,1,2], "texcoords": [0,0, 1,0, 1,1]})";
constexpr const char* kBare = R"("primitives": {"vertices": [0,0,0, 1,0,0, 1,1,0], "triangles": [0,1,2]})";

TEST(Appearance, SceneFilesGiveColoursAndPictures) {
  const std::string png = pngOf(4);
  fileWith("wood.png", png);
  twoTriangles("newmtl a\nKd 1 0 0.2\nnewmtl b\n");
  const SceneModel scene = sceneOf(
      std::string("{") + kSquare + R"(, "picture": "wood.png", "colour": [1, 2, 3]},)" +
      R"({"file": "two.obj", "colour": [9, 8, 7]}, {"builtin": "sphere:80", "colour": [7, 0, 7], "body": {}},)" +
      R"({"implicit": {"expression": {"sphere": {"radius": 0.01}}}, "colour": [4, 5, 6]})");
  EXPECT_EQ(*scene.model.appearance.pictures.at(paintOf(scene.model, 0).picture.value()).file, png);
  EXPECT_EQ(paintOf(scene.model, 0).colour, (Rgb{1, 2, 3}));
  for (const std::size_t i : {1, 2}) EXPECT_EQ(paintOf(scene.model, i).colour, (Rgb{9, 8, 7})) << "not of its file";
  EXPECT_EQ(scene.surfaces.at(0).colour, (Rgb{4, 5, 6}));
  EXPECT_EQ(paintOf(scene.bodies.at(0).model, 0).colour, (Rgb{7, 0, 7}));
  const SceneModel coloured = sceneOf(R"({"primitives": {"vertices": [0,0,0, 1,0,0, 1,1,0], "triangles": [0,1,2],
      "colours": [1,2,3, 4,5,6, 7,8,9]}})");
  EXPECT_EQ(coloured.model.appearance.vertex_colours, (std::vector<Rgb>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST(Appearance, SceneFilesThatGiveItWrongAreRefused) {
  const std::string bare = std::string("{") + kBare;
  EXPECT_EQ(refusalOf(bare + R"(, "colour": [1, 2]})"), "objects[0].colour must hold 3 numbers: red, green and blue");
  EXPECT_EQ(refusalOf(bare + R"(, "colour": [1, 2, 256]})"),
            "objects[0].colour: colours must be whole numbers from 0 to 255");
  EXPECT_EQ(refusalOf(bare + R"(, "picture": "wood.png"})"),
            "objects[0].picture: it has no texture coordinates, over which a picture could lie");
  EXPECT_NE(refusalOf(std::string("{") + kSquare + R"(, "picture": "nowhere.png"})").find("nowhere.png"),
            std::string::npos);
  EXPECT_EQ(refusalOf(R"({"primitives": {"vertices": [0,0,0, 1,0,0, 1,1,0], "triangles": [0,1,2],
      "colours": [1,2,3]}})"),
            "objects[0].primitives.colours must hold 3 numbers for each vertex");
}

// Over a map of heights it lies as a texture does.
TEST(Appearance, APictureLiesOverAMapOfHeights) {
  fileWith("wood.png", pngOf(4));
  fileWith("map.asc", "ncols 3\nnrows 2\ncellsize 1\n0 0 0\n0 1 0\n");
  const SceneModel scene = sceneOf(R"({"heights": {"file": "map.asc"}, "picture": "wood.png"})");
  ASSERT_EQ(scene.surfaces.size(), 1U);
  EXPECT_EQ(scene.surfaces[0].appearance.pictures.size(), 1U);
  EXPECT_EQ(scene.surfaces[0].appearance.paints.at(0).picture, std::optional<std::uint32_t>(0));
  EXPECT_EQ(refusalOf(R"({"implicit": {"expression": {"sphere": {"radius": 0.01}}}, "picture": "wood.png"})"),
            "objects[0].picture: it has no texture coordinates, over which a picture could lie");
}

}  // namespace
}  // namespace hl::test_appearance

// What the page is sent of textures: which triangles show which image.
#include "page/surface_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <thread>

#include "io/load_scene_file.h"
#include "page/page_meshes.h"
#include "scene/scene_model.h"
#include "surfaces/cloud_maker.h"
#include "surfaces/point_cloud.h"

namespace hl::test_surface_images {
namespace {

// What a page is sent of the images of a model's own surfaces.
proto::SceneMesh imagesOf(const std::string& file) {
  const auto shape = makeShape(loadSceneFile(file).model, HierarchyKind::kNone);
  proto::SceneMesh mesh;
  addSurfaceImages(shape->model, lookOf(*shape, *surfacesOf(shape)), mesh);
  return mesh;
}

TEST(SurfaceImages, EachRunOfTrianglesShowsTheTextureOfItsMaterial) {
  const proto::SceneMesh mesh = imagesOf(HL_EXAMPLES "/textured_tiles.hl.json");
  EXPECT_EQ(mesh.images_size(), 3) << "the waves are used twice and sent once";
  ASSERT_EQ(mesh.parts_size(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(mesh.parts(i).first_triangle(), static_cast<std::uint32_t>(2 * i));
    EXPECT_EQ(mesh.parts(i).triangles(), 2u);
  }
  EXPECT_EQ(mesh.parts(0).image(), mesh.parts(3).image());
  EXPECT_EQ(mesh.texcoords().size(), 2 * sizeof(float) * 4 * 4) << "four tiles of four corners";
  const proto::SurfaceImage& checker = mesh.images(1);
  EXPECT_EQ(checker.width(), 2u);
  EXPECT_EQ(checker.texels(), std::string("\xff\0\0\xff", 4));
  EXPECT_TRUE(checker.nearest());
}

TEST(SurfaceImages, PlainModelsSendNone) {
  const proto::SceneMesh mesh = imagesOf(HL_EXAMPLES "/friction_lanes.hl.json");
  EXPECT_EQ(mesh.images_size() + mesh.parts_size(), 0);
  EXPECT_TRUE(mesh.texcoords().empty());
}

// The mesh that a page draws of each surface: of the depth image fewer triangles than are felt.
TEST(SurfaceImages, HeightsAndDepthImagesShowTheirs) {
  const auto scene = makeSnapshot(loadSceneFile(HL_EXAMPLES "/textured_heights.hl.json"));
  PageMeshes meshes;
  const std::vector<std::uint32_t> numbers = meshes.numbersOf(*scene, 0);
  ASSERT_EQ(numbers.size(), 2U);
  while (!meshes.ready()) std::this_thread::yield();
  for (std::size_t i = 0; i < 2; ++i) {
    proto::ServerMessage message;
    ASSERT_TRUE(message.ParseFromString(*meshes.message(numbers[i])));
    const proto::SceneMesh& mesh = message.mesh();
    ASSERT_EQ(mesh.images_size(), 1);
    ASSERT_EQ(mesh.parts_size(), 1);
    EXPECT_EQ(mesh.parts(0).triangles() * 3 * sizeof(std::uint32_t), mesh.triangles().size());
    ASSERT_EQ(mesh.texcoords().size() * 3, mesh.positions().size() * 2);
    std::vector<float> texcoords(mesh.texcoords().size() / sizeof(float));
    std::memcpy(texcoords.data(), mesh.texcoords().data(), mesh.texcoords().size());
    const float most_u = i == 0 ? 4 : 20, most_v = i == 0 ? 4 : 1;
    float u = 0, v = 0;
    for (std::size_t n = 0; n < texcoords.size(); n += 2) {
      u = std::max(u, texcoords[n]);
      v = std::max(v, texcoords[n + 1]);
    }
    // Of the table the camera does not see all.
    EXPECT_GT(u, 0.7F * most_u);
    EXPECT_GT(v, 0.7F * most_v);
    EXPECT_LE(u, most_u);
    EXPECT_LE(v, most_v);
  }
}

// Two triangles of four vertices, each of a paint of its own.
Model twoPaints() {
  Model model;
  model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  model.texcoords = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  model.triangles = {{0, 1, 2}, {1, 3, 2}};
  model.appearance.paints = {{{255, 0, 0}, {}}, {{0, 0, 255}, {}}};
  model.appearance.triangle_paints = {0, 1};
  return model;
}

TEST(SurfaceImages, AVertexOfTwoColoursIsThereTwice) {
  Model model = twoPaints();
  const ColouredModel split = colouredModel(model);
  ASSERT_TRUE(split.model);
  ASSERT_EQ(split.colours.size(), 6U) << "two of the four are those of both triangles";
  ASSERT_EQ(split.model->positions.size(), 6U);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = split.model->triangles[i][k];
      EXPECT_EQ(split.colours[v], model.appearance.paints[i].colour);
      EXPECT_EQ(split.model->positions[v], model.positions[model.triangles[i][k]]);
      EXPECT_EQ(split.model->texcoords[v], model.texcoords[model.triangles[i][k]]);
    }
  }
  model.appearance.paints[1] = model.appearance.paints[0];
  const ColouredModel one = colouredModel(model);
  EXPECT_FALSE(one.model);
  EXPECT_EQ(one.colours, std::vector<Rgb>(4, {255, 0, 0}));
  model.appearance.vertex_colours = {{0, 0, 0}, {128, 9, 9}, {255, 255, 255}, {51, 0, 0}};
  EXPECT_EQ(colouredModel(model).colours, (std::vector<Rgb>{{0, 0, 0}, {128, 0, 0}, {255, 0, 0}, {51, 0, 0}}));
}

// A texture that is felt hides the picture there.
TEST(SurfaceImages, TrianglesShowThePicturesOfTheirFile) {
  Model model = twoPaints();
  model.appearance.pictures = {{std::make_shared<const std::string>("a"), Wrap::kRepeat},
                               {std::make_shared<const std::string>("b"), Wrap::kClamp}};
  model.appearance.paints = {{{255, 255, 255}, 1}, {{255, 255, 255}, 0}};
  EXPECT_TRUE(colouredModel(model).colours.empty());
  proto::SceneMesh mesh;
  addSurfaceImages(model, {}, mesh);
  ASSERT_EQ(mesh.images_size(), 2);
  EXPECT_EQ(mesh.images(0).file(), "b");
  EXPECT_TRUE(mesh.images(0).clamp());
  EXPECT_EQ(mesh.images(1).file(), "a");
  ASSERT_EQ(mesh.parts_size(), 2);
  EXPECT_EQ(mesh.parts(1).first_triangle(), 1U);
  EXPECT_EQ(mesh.parts(1).image(), 1U);
  const Look felt{std::make_shared<const Texture>(makeTexture("checker", 2))};
  mesh.Clear();
  addSurfaceImages(model, felt, mesh);
  ASSERT_EQ(mesh.images_size(), 1);
  EXPECT_EQ(mesh.images(0).texels().size(), 4U);
  ASSERT_EQ(mesh.parts_size(), 1);
  EXPECT_EQ(mesh.parts(0).triangles(), 2U);
}

// All of what is drawn of it shows the one paint.
TEST(SurfaceImages, AMapOfHeightsShowsItsPicture) {
  SceneModel scene = loadSceneFile(HL_EXAMPLES "/heights.hl.json");
  ASSERT_FALSE(scene.surfaces.empty());
  scene.surfaces[0].appearance.pictures = {{std::make_shared<const std::string>("a"), Wrap::kRepeat}};
  scene.surfaces[0].appearance.paints = {{{255, 0, 0}, 0}};
  const std::size_t first = scene.model.elements() > 0 ? 1 : 0;
  const auto snapshot = makeSnapshot(std::move(scene));
  PageMeshes meshes;
  const std::vector<std::uint32_t> numbers = meshes.numbersOf(*snapshot, 0);
  while (!meshes.ready()) std::this_thread::yield();
  proto::ServerMessage message;
  ASSERT_TRUE(message.ParseFromString(*meshes.message(numbers.at(first))));
  const proto::SceneMesh& mesh = message.mesh();
  ASSERT_EQ(mesh.images_size(), 1);
  EXPECT_EQ(mesh.images(0).file(), "a");
  ASSERT_EQ(mesh.parts_size(), 1);
  EXPECT_EQ(mesh.parts(0).triangles() * 3 * sizeof(std::uint32_t), mesh.triangles().size());
  EXPECT_EQ(mesh.texcoords().size() * 3, mesh.positions().size() * 2);
  EXPECT_EQ(mesh.colours().size() * sizeof(float), mesh.positions().size());
}

// Of the points that are drawn: six corners of a disc each.
TEST(SurfaceImages, CloudsShowTheirColours) {
  SceneModel scene;
  std::size_t skipped = 0;
  const std::vector<Vec3> given{{0, 0, 0}, {0.01, 0, 0}};
  for (const std::vector<Rgb>& colours : {std::vector<Rgb>{{1, 2, 3}, {255, 128, 0}}, {}}) {
    const auto points = makeCloud(onFineLattice(given, {}, skipped, colours));
    scene.surfaces.push_back({"cloud", std::make_shared<const PointCloud>(points, CloudLook{})});
  }
  const auto snapshot = makeSnapshot(scene);
  PageMeshes meshes;
  const std::vector<std::uint32_t> numbers = meshes.numbersOf(*snapshot, 0);
  while (!meshes.ready()) std::this_thread::yield();
  proto::ServerMessage coloured, plain;
  ASSERT_TRUE(coloured.ParseFromString(*meshes.message(numbers.at(0))));
  ASSERT_TRUE(plain.ParseFromString(*meshes.message(numbers.at(1))));
  std::string wanted;
  for (int i = 0; i < 6; ++i) wanted += std::string("\1\2\3", 3);
  for (int i = 0; i < 6; ++i) wanted += std::string("\xff\x80\0", 3);
  EXPECT_EQ(coloured.mesh().colours(), wanted);
  EXPECT_EQ(coloured.mesh().positions().size(), 12 * 3 * sizeof(float));
  EXPECT_TRUE(plain.mesh().colours().empty());
  EXPECT_EQ(plain.mesh().cloud_points(), 2u);
}

}  // namespace
}  // namespace hl::test_surface_images

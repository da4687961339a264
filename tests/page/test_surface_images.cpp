// What the page is told of textures: which triangles show which image.
#include "page/surface_images.h"

#include <gtest/gtest.h>

#include "io/load_scene_file.h"
#include "scene/snapshot.h"

namespace hl {
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

}  // namespace
}  // namespace hl

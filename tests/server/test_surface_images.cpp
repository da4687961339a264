// What the page is told of textures: which triangles show which image.
#include "server/surface_images.h"

#include <gtest/gtest.h>

#include "io/load_scene_file.h"
#include "scene/snapshot.h"

namespace hl {
namespace {

TEST(SurfaceImages, EachRunOfTrianglesShowsTheTextureOfItsMaterial) {
  const Model model = loadSceneFile(HL_EXAMPLES "/textured_tiles.hl.json");
  proto::SceneMesh mesh;
  addSurfaceImages(model, mesh);
  EXPECT_EQ(mesh.images_size(), 3) << "the waves are used twice and sent once";
  ASSERT_EQ(mesh.parts_size(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(mesh.parts(i).first_triangle(), static_cast<std::uint32_t>(2 * i));
    EXPECT_EQ(mesh.parts(i).triangles(), 2u);
  }
  EXPECT_EQ(mesh.parts(0).image(), mesh.parts(3).image());
  EXPECT_EQ(mesh.texcoords().size(), 2 * sizeof(float) * model.texcoords.size());
  const proto::SurfaceImage& checker = mesh.images(1);
  EXPECT_EQ(checker.width(), 2u);
  EXPECT_EQ(checker.texels(), std::string("\xff\0\0\xff", 4));
  EXPECT_TRUE(checker.nearest());
}

TEST(SurfaceImages, PlainModelsSendNone) {
  proto::SceneMesh mesh;
  addSurfaceImages(loadSceneFile(HL_EXAMPLES "/friction_lanes.hl.json"), mesh);
  EXPECT_EQ(mesh.images_size() + mesh.parts_size(), 0);
  EXPECT_TRUE(mesh.texcoords().empty());
}

}  // namespace
}  // namespace hl

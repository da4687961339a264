// OpenVDB and NanoVDB files through hl-vdb: level sets and fog, where they lie, which grid is meant, what is broken.
#include <gtest/gtest.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetPlatonic.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/load_model.h"
#include "io/load_scene.h"
#include "scene/scene_model.h"
#include "surfaces/iso_surface.h"
#include "temp_folder.h"

namespace hl::test_vdb_file {
namespace {

using openvdb::FloatGrid;
using test::fileWith;
using test::tempFile;

class VdbFile : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }
};

std::string vdbFile(const std::string& name, const openvdb::GridCPtrVec& grids) {
  openvdb::io::File(tempFile(name)).write(grids);
  return tempFile(name);
}

FloatGrid::Ptr ball(double radius, double voxel, const openvdb::Vec3f& centre = {0, 0, 0}) {
  return openvdb::tools::createLevelSetSphere<FloatGrid>(static_cast<float>(radius), centre, static_cast<float>(voxel));
}

FloatGrid::Ptr named(const std::string& name, const FloatGrid::Ptr& grid) {
  grid->setName(name);
  return grid;
}

// A level set of these exact distances, with a band of three voxels.
FloatGrid::Ptr levelSet(const openvdb::math::Transform::Ptr& transform, int half,
                        const std::function<double(const Vec3&)>& distance) {
  const double band = 3 * transform->voxelSize().x();
  const auto grid = FloatGrid::create(static_cast<float>(band));
  grid->setTransform(transform);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto values = grid->getAccessor();
  for (const openvdb::Coord& at : openvdb::CoordBBox(openvdb::Coord(-half), openvdb::Coord(half))) {
    const openvdb::Vec3d p = transform->indexToWorld(at);
    if (const double d = distance({p.x(), p.y(), p.z()}); std::abs(d) < band)
      values.setValue(at, static_cast<float>(d));
  }
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

const IsoSurface& surfaceOf(const SceneModel& scene) {
  return dynamic_cast<const IsoSurface&>(*scene.surfaces.at(0).source);
}

SceneModel load(const std::string& path, const std::string& grid = "") {
  LoadOptions options;
  options.grid = grid;
  return loadModelScene(path, options);
}

std::string refusalOf(const std::string& path, const std::string& grid = "") {
  try {
    load(path, grid);
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_TRUE(line.starts_with(path + ": ")) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line.substr(std::min(line.size(), path.size() + 2));
  }
  return "";
}

// Of corners and middles of all triangles, by the exact distance of what is meant; it is not hollow where it is full.
void expectWithin(const IsoSurface& surface, const std::function<double(const Vec3&)>& distance, double least,
                  double most) {
  std::size_t triangles = 0;
  surface.cells().forEach([&](const IsoCell& cell) {
    for (unsigned i = 0; exists(cell, i); ++i, ++triangles) {
      const auto [a, b, c] = surface.corners(surface.cells().idOf(cell, i));
      for (const Vec3& p : {a, b, c, Vec3((a + b + c) / 3)}) {
        ASSERT_GE(distance(p), least) << p.transpose();
        ASSERT_LE(distance(p), most) << p.transpose();
      }
    }
  });
  EXPECT_GT(triangles, 1000U);
}

constexpr double kRounding_m = 1e-8;  // of distances that are kept as float

// The bound of trilinear interpolation with marching cells: 0.51 h^2 / R, and the solid shrinks.
TEST_F(VdbFile, ASphereIsWhereItIsWithinTheBoundOfItsVoxels) {
  constexpr double kRadius = 0.02;
  const Vec3 centre(0.1, -0.0502, 0.0301);
  for (const double voxel : {1e-3, 5e-4}) {
    const SceneModel scene = load(vdbFile("ball.vdb", {ball(kRadius, voxel, {0.1F, -0.0502F, 0.0301F})}));
    EXPECT_TRUE(scene.model.warnings.empty()) << scene.model.warnings[0];
    const IsoSurface& surface = surfaceOf(scene);
    EXPECT_EQ(surface.iso().value, 0);
    EXPECT_EQ(surface.iso().solid, SolidSide::kBelow);
    const auto distance = [&](const Vec3& p) { return (p - centre).norm() - kRadius; };
    expectWithin(surface, distance, -0.51 * voxel * voxel / kRadius, kRounding_m);
    EXPECT_EQ(surface.siteOf(centre), Site::kMatter) << "deep inside, where no voxel is active";
    EXPECT_NE(surface.siteOf(centre + Vec3(0, 0.0215, 0)), Site::kMatter);
  }
}

TEST_F(VdbFile, ATurnedTorusLiesTurned) {
  constexpr double kRing = 0.02, kTube = 0.008, kVoxel = 1e-3;
  const auto transform = openvdb::math::Transform::createLinearTransform(kVoxel);
  transform->postRotate(0.4, openvdb::math::X_AXIS);
  transform->postTranslate(openvdb::Vec3d(0.3, 0, 0));
  const auto distance = [](const Vec3& p) { return std::hypot(std::hypot(p.x() - 0.3, p.z()) - kRing, p.y()) - kTube; };
  const SceneModel scene = load(vdbFile("torus.vdb", {levelSet(transform, 34, distance)}));
  const double curvature = 1 / kTube + 1 / (kRing - kTube);
  expectWithin(surfaceOf(scene), distance, -0.51 * kVoxel * kVoxel * curvature, 0.51 * kVoxel * kVoxel * curvature);
}

// 0.1 mm apart: with voxels of 0.5 mm they are one body, which must be said.
TEST_F(VdbFile, AGapThatTheVoxelsCloseIsReported) {
  const auto two = [](double voxel) {
    const FloatGrid::Ptr both = ball(0.01, voxel);
    openvdb::tools::csgUnion(*both, *ball(0.01, voxel, {0.0201F, 0, 0}));
    return load(vdbFile("two.vdb", {both})).model.warnings;
  };
  const std::vector<std::string> coarse = two(5e-4);
  ASSERT_EQ(coarse.size(), 1U);
  EXPECT_TRUE(coarse[0].starts_with("has walls or gaps that are thinner than two of its voxels, 0.001 m, at "))
      << coarse[0];
  const auto cube = openvdb::tools::createLevelSetCube<FloatGrid>(0.02F, openvdb::Vec3f(0, 0, 0), 5e-4F);
  EXPECT_TRUE(load(vdbFile("cube.vdb", {cube})).model.warnings.empty()) << "edges are no gaps";
}

TEST_F(VdbFile, VoxelsThatAreNoNumbersAreReported) {
  const FloatGrid::Ptr grid = ball(0.02, 1e-3);
  grid->tree().setValueOn(openvdb::Coord(0, 0, 20), std::numeric_limits<float>::quiet_NaN());
  const SceneModel scene = load(vdbFile("lacking.vdb", {grid}));
  ASSERT_EQ(scene.model.warnings.size(), 1U);
  EXPECT_EQ(scene.model.warnings[0],
            "has 1 voxels in its level set that are no numbers: its surface is open around them");
}

TEST_F(VdbFile, FogHasItsThresholdAndItsMatterAbove) {
  const FloatGrid::Ptr fog = ball(0.02, 1e-3);
  openvdb::tools::sdfToFogVolume(*fog);
  const SceneModel scene = load(vdbFile("fog.vdb", {named("density", fog)}));
  const IsoSurface& surface = surfaceOf(scene);
  EXPECT_GT(surface.iso().value, 0.2);
  EXPECT_LT(surface.iso().value, 0.8);
  EXPECT_EQ(surface.iso().solid, SolidSide::kAbove);
  expectWithin(
      surface, [](const Vec3& p) { return p.norm() - 0.02; }, -3e-3, 0);
}

TEST_F(VdbFile, OfSeveralGridsOneIsMeantOrSaid) {
  const auto motion = openvdb::Vec3SGrid::create();
  motion->setName("v");
  const FloatGrid::Ptr fog = named("density", ball(0.02, 1e-3));
  openvdb::tools::sdfToFogVolume(*fog);
  const std::string one = vdbFile("one.vdb", {motion, fog, named("surface", ball(0.01, 1e-3))});
  EXPECT_EQ(surfaceOf(load(one)).iso().solid, SolidSide::kBelow) << "the level set";
  EXPECT_EQ(surfaceOf(load(one, "density")).iso().solid, SolidSide::kAbove);
  EXPECT_EQ(refusalOf(one, "smoke"),
            "has no grid 'smoke'; it has 'v' of vec3s, 'density' of float, 'surface' of float");
  EXPECT_EQ(refusalOf(one, "v"), "has vec3s in its grid 'v': one of float can be touched");
  const std::string two = vdbFile("two.vdb", {named("a", ball(0.01, 1e-3)), named("b", ball(0.02, 1e-3))});
  EXPECT_EQ(
      refusalOf(two),
      "has several grids: say which (--grid NAME, or \"grid\" in a scene file); it has 'a' of float, 'b' of float");
  EXPECT_NEAR(boundsOf(load(two, "b")).size().x(), 0.04, 5e-3);
  EXPECT_EQ(refusalOf(vdbFile("v.vdb", {motion})), "has no grid of float, which could be touched; it has 'v' of vec3s");
  EXPECT_EQ(refusalOf(vdbFile("none.vdb", {})), "has no grid in it");
  const std::string model = fileWith("a.obj", "v 0 0 0\n");
  EXPECT_EQ(refusalOf(model, "b"), "has no grids with names: files ending in .vdb and .nvdb have");
  const SceneModel scene = loadScene(fileWith("two.hl.json", R"({"objects": [
      {"volume": {"file": "two.vdb", "grid": "a"}}, {"volume": {"file": "two.vdb", "grid": "b", "iso": 0.001}}]})"));
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(surfaceOf(scene).iso().solid, SolidSide::kBelow) << "as the file says";
  EXPECT_EQ(dynamic_cast<const IsoSurface&>(*scene.surfaces[1].source).iso().value, 0.001);
}

TEST_F(VdbFile, WhatCannotBeTouchedGivesOneLine) {
  EXPECT_EQ(refusalOf(vdbFile("empty.vdb", {named("e", FloatGrid::create())})), "has nothing in its grid 'e'");
  const FloatGrid::Ptr camera = named("c", FloatGrid::create());
  camera->tree().setValue(openvdb::Coord(0, 0, 0), 1);
  const openvdb::BBoxd box(openvdb::Vec3d(0), openvdb::Vec3d(10));
  camera->setTransform(openvdb::math::Transform::createFrustumTransform(box, 0.5, 10, 1));
  EXPECT_EQ(refusalOf(vdbFile("camera.vdb", {camera})),
            "has its grid 'c' in the frustum of a camera: resample it to a box");
  const FloatGrid::Ptr full = named("f", FloatGrid::create(1));
  full->setGridClass(openvdb::GRID_LEVEL_SET);
  full->tree().setValue(openvdb::Coord(0, 0, 0), 0.25F);
  EXPECT_EQ(refusalOf(vdbFile("full.vdb", {full})),
            "has no surface in its level set 'f': its distances are from 0.25 to 0.25");
  const FloatGrid::Ptr wide = named("w", FloatGrid::create(1));
  for (const int at : {0, 1 << 19}) wide->tree().setValue(openvdb::Coord(at), 0.5F);
  EXPECT_EQ(refusalOf(vdbFile("wide.vdb", {wide})),
            "has 2 active voxels in a box of 524291 x 524291 x 524291, which would take 576470648.0 GB: some lie far "
            "from the others; remove these, or resample the grid 'w' to larger voxels");
  const FloatGrid::Ptr block = named("b", ball(0.01, 1e-3));  // a whole block of 128 voxels along each axis
  block->tree().addTile(2, openvdb::Coord(4096, 4096, 4096), 1, true);
  EXPECT_NE(refusalOf(vdbFile("block.vdb", {block})).find("some lie far from the others"), std::string::npos);
  wide->tree().setValue(openvdb::Coord(1 << 21), 0.5F);
  EXPECT_EQ(refusalOf(vdbFile("wide.vdb", {wide})),
            "has 2.09716e+06 x 2.09716e+06 x 2.09716e+06 samples: a volume has 2 to 1048576 along each axis");
}

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// As many as it says must be in it: one byte of a count asks for gigabytes.
TEST_F(VdbFile, ABentByteTakesNoMoreMemoryThanItsSizeAllows) {
  const FloatGrid::Ptr grid = ball(0.02, 1e-3);
  const std::string good = contentOf(vdbFile("good.vdb", {grid}));
  int refused = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(good.size(), 600); i += 7) {
    std::string bent = good;
    bent[i] = static_cast<char>(bent[i] ^ 0x5a);
    const std::string refusal = refusalOf(fileWith("bent.vdb", bent));
    for (const char* word : {"Error:", "cannot be an empty", "unregistered", "std::"})
      EXPECT_EQ(refusal.find(word), std::string::npos) << i << ": " << refusal;
    refused += refusal.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 5);
  EXPECT_EQ(refusalOf(fileWith("text.vdb", "nothing of the kind\n")), "is not an OpenVDB or NanoVDB file");
}

TEST_F(VdbFile, NanoVdbHasTheSameSamples) {
  const FloatGrid::Ptr grid = named("ball", ball(0.02, 1e-3, {0.01F, 0, 0}));
  const SceneModel open = load(vdbFile("ball.vdb", {grid}));
  const IsoSurface& a = surfaceOf(open);
  for (const auto codec : {nanovdb::io::Codec::NONE, nanovdb::io::Codec::ZIP, nanovdb::io::Codec::BLOSC}) {
    nanovdb::io::writeGrid(tempFile("ball.nvdb"), nanovdb::openToNanoVDB(*grid), codec);
    const SceneModel nano = load(tempFile("ball.nvdb"), "ball");
    const IsoSurface& b = surfaceOf(nano);
    ASSERT_EQ(a.volume()->grid.bytes(), b.volume()->grid.bytes());
    EXPECT_EQ(0, std::memcmp(a.volume()->grid.samples().data(), b.volume()->grid.samples().data(),
                             a.volume()->grid.count() * sizeof(float)));
    EXPECT_LT((a.frame().axes - b.frame().axes).norm(), 1e-12);
    EXPECT_LT((a.frame().origin - b.frame().origin).norm(), 1e-9);
    EXPECT_EQ(b.iso().solid, SolidSide::kBelow);
  }
}

TEST_F(VdbFile, NanoVdbOfShortFloatsIsReadWithinTheirSteps) {
  constexpr double kVoxel = 1e-3, kBand = 2 * 3 * kVoxel;
  const FloatGrid::Ptr grid = ball(0.02, kVoxel);
  const auto handle = nanovdb::openToNanoVDB<nanovdb::HostBuffer, openvdb::FloatTree, nanovdb::Fp16>(*grid);
  nanovdb::io::writeGrid(tempFile("short.nvdb"), handle);
  const SceneModel whole = load(vdbFile("whole.vdb", {grid})), rounded = load(tempFile("short.nvdb"));
  const VoxelGrid &a = surfaceOf(whole).volume()->grid, &b = surfaceOf(rounded).volume()->grid;
  ASSERT_EQ(a.bytes(), b.bytes());
  const auto* const of_a = reinterpret_cast<const float*>(a.samples().data());
  const auto* const of_b = reinterpret_cast<const float*>(b.samples().data());
  double farthest = 0;
  for (std::size_t i = 0; i < a.count(); ++i) farthest = std::max<double>(farthest, std::abs(of_a[i] - of_b[i]));
  EXPECT_GT(farthest, 0);
  EXPECT_LT(farthest, kBand / 65535);  // of a leaf's least to its greatest
}

TEST_F(VdbFile, WhatIsBrokenGivesOneLine) {
  const FloatGrid::Ptr grid = ball(0.005, 1e-3);
  nanovdb::io::writeGrid(tempFile("good.nvdb"), nanovdb::openToNanoVDB(*grid));
  vdbFile("good.vdb", {grid});
  for (const std::string ending : {".vdb", ".nvdb"}) {
    const std::string good = contentOf(tempFile("good" + ending));
    EXPECT_EQ(refusalOf(fileWith("none" + ending, "")), "is empty");
    EXPECT_NE(refusalOf(fileWith("text" + ending, "nothing of the kind\n")), "");
    EXPECT_NE(refusalOf(fileWith("noise" + ending, std::string(3000, '\x9e'))), "");
    for (const std::size_t left : {good.size() / 8, good.size() * 7 / 8, good.size() * 99 / 100, good.size() - 10})
      EXPECT_NE(refusalOf(fileWith("cut" + ending, good.substr(0, left))), "") << ending << " of " << left;
    for (std::size_t i = 1; i < 6; ++i) {  // what is another number may still be a grid
      std::string broken = good;
      broken[good.size() * i / 6] = static_cast<char>(broken[good.size() * i / 6] ^ 0x41);
      refusalOf(fileWith("bent" + ending, broken));
    }
  }
}

}  // namespace
}  // namespace hl::test_vdb_file

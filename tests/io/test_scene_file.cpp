// Scene files: every field arrives, and every error names the line.
#include "io/load_scene_file.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/gil.hpp>
#include <boost/gil/extension/io/jpeg.hpp>
#include <boost/gil/extension/io/png.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.h"
#include "bodies/mesh_body.h"
#include "io/load_image.h"
#include "scene/snapshot.h"
#include "surfaces/depth_frame.h"
#include "surfaces/iso_surface.h"
#include "temp_folder.h"

namespace hl::test_scene_file {
namespace {

using test::fileWith;
using test::tempFile;

Model sceneOf(const std::string& json) { return loadSceneFile(fileWith("scene.hl.json", json)).model; }

std::string refusalOf(const std::string& json) {
  try {
    sceneOf(json);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

// The message without the path in front: ":LINE: ...".
std::string afterFile(const std::string& message) {
  const std::string file = tempFile("scene.hl.json");
  return message.starts_with(file) ? message.substr(file.size()) : "not about the file: " + message;
}

// Two columns, three rows: 16-bit grey, the top row brightest.
void writePng(const std::string& path) {
  boost::gil::gray16_image_t image(2, 3);
  auto view = boost::gil::view(image);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 2; ++x) view(x, y)[0] = static_cast<std::uint16_t>(60000 - 20000 * y + x);
  }
  boost::gil::write_view(path, boost::gil::const_view(image), boost::gil::png_tag{});
}

TEST(SceneFile, EveryFieldArrives) {
  writePng(tempFile("height.png"));
  const Model model = sceneOf(R"({
    "units": 0.001,
    "textures": [
      {"name": "h", "file": "height.png", "wrap": "CLAMP", "filter": "NEAREST"},
      {"name": "l", "procedural": {"kind": "lines", "size": 8, "duty": 0.25}}],
    "objects": [
      {"name": "square", "primitives": {
         "vertices": [0,0,0, 1,0,0, 1,1,0, 0,1,0], "normals": [0,0,2, 0,0,2, 0,0,2, 0,0,2],
         "texcoords": [0,0, 1,0, 1,1, 0,1], "polygons": [{"vertices": [0,1,2,3]}], "segments": [0,2], "points": [1]},
       "transform": {"translate": {"x": 10}, "axis": {"x": 2}, "degrees": 90, "scale": {"x": 2, "y": 3}},
       "material": {"stiffness": 0.5, "staticFriction": 0.6, "dynamicFriction": 0.4, "viscosityNsM": 3,
         "stribeckMS": 0.05, "preslidingNM": 9000, "shade": "FLAT", "repeatU": 4, "repeatV": 5,
         "textures": [{"texture": "h", "quantity": "HEIGHT", "low": 0, "high": 1e-4},
                      {"texture": "l", "quantity": "VISCOSITY", "low": 1, "high": 2}]}},
      {"builtin": "plane:2"}]})");
  EXPECT_EQ(model.triangles.size(), 4u);
  EXPECT_EQ(model.segments.size(), 1u);
  EXPECT_EQ(model.points.size(), 1u);
  // (1, 1, 0) scaled to (2, 3, 0), turned about x to (2, 0, 3), moved to (12, 0, 3), in millimetres.
  EXPECT_LT((model.positions[2] - Vec3(0.012, 0, 0.003)).norm(), 1e-12);
  EXPECT_LT((model.normals[2] - Vec3(0, -1, 0)).norm(), 1e-12);
  EXPECT_EQ(model.texcoords[2], Vec2(4, 5));
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.triangle_materials, (std::vector<std::uint16_t>{0, 0, 1, 1}));
  EXPECT_EQ(model.segment_materials, std::vector<std::uint16_t>{0});
  const Material& m = model.materials[0];
  EXPECT_EQ(m.stiffness, 0.5);
  EXPECT_EQ(m.static_friction, 0.6);
  EXPECT_EQ(m.dynamic_friction, 0.4);
  EXPECT_EQ(m.viscosity_Ns_m, 3);
  EXPECT_EQ(m.stribeck_m_s, 0.05);
  EXPECT_EQ(m.presliding_N_m, 9000);
  EXPECT_FALSE(m.smooth);
  EXPECT_TRUE(model.materials[1].smooth);
  EXPECT_EQ(m.textureOf(Quantity::kHeight).texture, 0u);
  EXPECT_EQ(m.textureOf(Quantity::kHeight).high, 1e-4);
  EXPECT_EQ(m.textureOf(Quantity::kViscosity).texture, 1u);
  EXPECT_FALSE(m.textureOf(Quantity::kStiffness).used());
  EXPECT_EQ(model.textures[0].wrap, Wrap::kClamp);
  EXPECT_EQ(model.textures[0].filter, Filter::kNearest);
  EXPECT_EQ(makeSnapshot(model, HierarchyKind::kBvh)->shape().material_of.size(), 6u);
}

TEST(SceneFile, TheExamplesLoad) {
  for (const char* name : {"friction_lanes", "sticky_pads", "textured_tiles"}) {
    const Model model = loadSceneFile(std::string(HL_EXAMPLES) + "/" + name + ".hl.json").model;
    EXPECT_EQ(model.triangles.size(), 8u);
    EXPECT_EQ(model.materials.size(), 4u);
  }
}

TEST(SceneFile, TheExamplesOfSnapsAndFieldsLoad) {
  const std::string folder = std::string(HL_EXAMPLES) + "/";
  EXPECT_EQ(makeSnapshot(loadSceneFile(folder + "snaps.hl.json"))->snaps.size(), 5U);
  EXPECT_EQ(makeSnapshot(loadSceneFile(folder + "fields.hl.json"))->fields.size(), 4U);
}

TEST(SceneFile, TheExampleOfHeightsLoads) {
  const SceneModel scene = loadSceneFile(std::string(HL_EXAMPLES) + "/heights.hl.json");
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(scene.surfaces[0].source->count(), 800U);
  EXPECT_EQ(scene.surfaces[0].material.dynamic_friction, 0.2);
  EXPECT_NEAR(boundsOf(scene).size().x(), 0.21, 1e-9);
  EXPECT_EQ(makeSnapshot(scene)->instances.size(), 2U);
}

TEST(SceneFile, HeightsAndDepthImagesHaveTextures) {
  const SceneModel scene = loadSceneFile(std::string(HL_EXAMPLES) + "/textured_heights.hl.json");
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(scene.surfaces[0].repeat, Vec2(4, 4));
  EXPECT_EQ(scene.surfaces[1].repeat, Vec2(20, 1));
  const auto snapshot = makeSnapshot(scene);
  const auto& hills = *snapshot->instances[0].surfaces;
  EXPECT_EQ(hills.textures.at(hills.materials[0].textureOf(Quantity::kDynamicFriction).texture)->name, "fields");
  const auto& table = *snapshot->instances[1].surfaces;
  ASSERT_EQ(table.textures.size(), 1U) << "only those that it uses";
  EXPECT_EQ(table.textures.at(table.materials[0].textureOf(Quantity::kHeight).texture)->name, "waves");
  EXPECT_TRUE(snapshot->shape(1).hasTexcoords());
}

TEST(SceneFile, TexturesNeedTextureCoordinates) {
  const auto refused = [](const std::string& shape) {
    try {
      loadSceneFile(fileWith("scene.hl.json", R"({"textures": [{"name": "t", "procedural": {"kind": "sine"}}],
"objects": [{)" + shape + R"(,
"material": {"textures": [{"texture": "t", "quantity": "VISCOSITY"}]}}]})"));
    } catch (const Error& error) {
      return afterFile(error.what());
    }
    return std::string();
  };
  const std::string why =
      ":3: objects[0].material: volumes, clouds and implicit surfaces have no texture coordinates, and take no "
      "textures";
  EXPECT_EQ(refused(R"("heights": {"columns": 2, "rows": 2, "values": [0, 1, 2, 3]})"), "");
  EXPECT_EQ(refused(R"("builtin": "points:sphere:99")"), why);
  EXPECT_EQ(refused(R"("implicit": {"expression": {"sphere": {"radius": 1}}})"), why);
}

std::string heightsRefusal(const std::string& heights, const std::string& rest = "") {
  try {
    loadSceneFile(fileWith("scene.hl.json", "{\"objects\":[{\n\"heights\": {" + heights + "}" + rest + "}]}"));
  } catch (const Error& error) {
    return std::string(error.what()).substr(std::string(error.what()).find("scene.hl.json:") + 14);
  }
  return "";
}

TEST(SceneFile, HeightsThatMakeNoSenseAreRefused) {
  const std::string good = R"("columns": 2, "rows": 2, "values": [0, 1, 2, 3])";
  EXPECT_EQ(heightsRefusal(good), "");
  EXPECT_EQ(heightsRefusal(good + R"(, "spacing": -1)"), "2: objects[0].heights: spacing must be from 1e-12 to 1e9");
  EXPECT_EQ(heightsRefusal(R"("columns": 2, "rows": 3, "values": [0, 1, 2, 3])"),
            "2: objects[0].heights: it has fewer samples than it says");
  EXPECT_EQ(heightsRefusal(good, R"(, "body": {})"),
            "2: objects[0].body: only what is made of triangles can be a body");
  EXPECT_NE(heightsRefusal(R"("file": "none.tif")").find("there is no such file"), std::string::npos);
  fileWith("field.asc", "ncols 2\nnrows 2\ncellsize 5\n1 2 3 4");
  EXPECT_EQ(heightsRefusal(R"("file": "field.asc", "spacing": 2, "verticalScale": 3)"), "");
  EXPECT_EQ(heightsRefusal(R"("file": "field.asc", "columns": 2)"),
            "2: objects[0].heights: columns, rows, values, samples, kind and missing are those of its file");
}

TEST(SceneFile, HeightsOfAFileTakeAnotherSpacing) {
  fileWith("field.asc", "ncols 3\nnrows 2\ncellsize 5\n1 2 3 4 5 6");
  const SceneModel scene = loadSceneFile(fileWith(
      "scene.hl.json", R"({"objects":[{"heights": {"file": "field.asc", "spacing": 2, "verticalScale": 3}}]})"));
  EXPECT_LT((scene.surfaces.at(0).source->bounds().size() - Vec3(4, 15, 2)).norm(), 1e-12);
}

// A profilometer says its spacing in metres and its heights in micrometres: only the scene says so.
TEST(SceneFile, HeightsThatAFileHasTooSteepAreThoseThatTheSceneSays) {
  fileWith("steep.asc", "ncols 2\nnrows 2\ncellsize 1e-3\n0 1 2 60000");
  const auto load = [](const std::string& scale) {
    return loadSceneFile(fileWith("scene.hl.json", R"({"objects":[{"heights": {"file": "steep.asc")" + scale + "}}]}"));
  };
  EXPECT_NO_THROW(makeSnapshot(load(R"(, "verticalScale": 1e-6)")));
  EXPECT_THROW(makeSnapshot(load("")), Error);
}

TEST(SceneFile, TheExampleOfCloudsLoads) {
  const SceneModel scene = loadSceneFile(std::string(HL_EXAMPLES) + "/clouds.hl.json");
  ASSERT_EQ(scene.surfaces.size(), 3U);
  EXPECT_EQ(scene.surfaces[0].source->shared().of, scene.surfaces[1].source->shared().of) << "points and surfels";
  EXPECT_EQ(scene.surfaces[0].source->kind(), PrimitiveKind::kPoint);
  EXPECT_EQ(scene.surfaces[1].source->kind(), PrimitiveKind::kTriangle);
  EXPECT_EQ(makeSnapshot(scene)->instances.size(), 3U);
}

TEST(SceneFile, WhatTheReaderOfACloudSaysIsAWarning) {
  fileWith("far.xyz", "1000 2000 0\n1001 2000 0\n1000 2001 0\n");
  const SceneModel scene =
      loadSceneFile(fileWith("scene.hl.json", R"({"objects": [{"name": "tile", "cloud": {"file": "far.xyz"}}]})"));
  const std::string says =
      "lies far from the origin of its file: its middle, 1000.5 2000.5 0 there, is put at the origin";
  EXPECT_EQ(scene.model.warnings, std::vector<std::string>{"tile: far.xyz: " + says});
}

TEST(SceneFile, ACloudThatMakesNoSenseIsRefused) {
  fileWith("three.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  const auto refused = [](const std::string& cloud) {
    try {
      loadSceneFile(fileWith("scene.hl.json", "{\"objects\":[\n{\"cloud\": {" + cloud + "}}]}"));
    } catch (const Error& error) {
      constexpr std::string_view kWhere = "objects[0].cloud: ";
      return std::string(error.what()).substr(std::string(error.what()).find(kWhere) + kWhere.size());
    }
    return std::string();
  };
  EXPECT_EQ(refused(R"("file": "three.xyz", "surfels": true, "reach": 1)"), "");
  EXPECT_EQ(refused(R"("file": "three.xyz", "reach": 1)"), "reach is of surfels, and this cloud is of points");
  EXPECT_EQ(refused(R"("file": "three.xyz", "surfels": true, "reach": 11)"),
            "a surfel reaches from 0.01 to 10 times the spacing");
  EXPECT_EQ(refused(R"("file": "three.xyz", "builtin": "points:sphere:9")"), "it has a file or a builtin, not both");
  EXPECT_EQ(refused(R"("builtin": "teapot")"), "teapot: is no cloud of points");
  EXPECT_EQ(refused(R"("positions": [1, 2])"), "positions must be three numbers for each point");
  EXPECT_EQ(refused(R"("positions": [1, 2, 3], "colours": [0, 128, 255])"), "");
  EXPECT_EQ(refused(R"("positions": [1, 2, 3], "colours": [0, 128, 256])"),
            "colours must be whole numbers from 0 to 255");
  EXPECT_EQ(refused(R"("positions": [1, 2, 3], "colours": [0, 128])"),
            "colours must be three numbers for each point, or absent");
  EXPECT_EQ(refused(R"("file": "three.xyz", "colours": [0, 128, 255])"),
            "positions, normals and colours are those of its file");
  EXPECT_EQ(refused(R"("positions": [1, 2, 3], "normals": [1])"),
            "normals must be three numbers for each point, or absent");
  EXPECT_EQ(refused(R"("file": "three.xyz", "positions": [1, 2, 3])"),
            "positions, normals and colours are those of its file");
}

TEST(SceneFile, TheExampleOfAVolumeLoads) {
  const SceneModel scene = loadSceneFile(std::string(HL_EXAMPLES) + "/volume.hl.json");
  ASSERT_EQ(scene.surfaces.size(), 3U);
  EXPECT_EQ(scene.surfaces[0].source->shared().of, scene.surfaces[1].source->shared().of) << "skin and bone";
  EXPECT_EQ(scene.surfaces[0].name, "skin");
  EXPECT_EQ(scene.surfaces[0].material.stiffness, 0.4);
  EXPECT_EQ(scene.surfaces[1].material.stiffness, 1);
  EXPECT_EQ(makeSnapshot(scene)->instances.size(), 3U);
}

TEST(SceneFile, TheExampleOfImplicitSurfacesLoads) {
  const SceneModel scene = loadSceneFile(std::string(HL_EXAMPLES) + "/implicit.hl.json");
  ASSERT_EQ(scene.surfaces.size(), 3U);
  EXPECT_EQ(scene.surfaces[1].name, "a block with a bore");
  EXPECT_EQ(scene.surfaces[1].source->siteOf(Vec3(0.015, 0, 0.015)), Site::kMatter);
  EXPECT_EQ(scene.surfaces[1].source->siteOf(Vec3(0, 0.019, 0)), Site::kOpen) << "in the bore";
  for (const SceneSurface& surface : scene.surfaces) EXPECT_LE(surface.source->error_m(), 2.1e-5);
}

TEST(SceneFile, ImplicitSurfacesThatMakeNoSenseAreRefused) {
  const auto refusal = [](const std::string& implicit, const std::string& rest = "") -> std::string {
    try {
      loadSceneFile(fileWith("scene.hl.json", "{\"objects\":[{\n\"implicit\": {" + implicit + "}" + rest + "}]}"));
    } catch (const Error& error) {
      return std::string(error.what()).substr(std::string(error.what()).find("scene.hl.json:") + 14);
    }
    return "";
  };
  const std::string good = R"("expression": {"sphere": {"radius": 0.1}}, "error": 1e-4)";
  EXPECT_EQ(refusal(good), "");
  EXPECT_EQ(refusal(good + R"(, "bounds": {"min": {"x": -1, "y": -1, "z": 0}, "max": {"x": 1, "y": 1, "z": 1}})"), "");
  EXPECT_EQ(refusal(""), "2: objects[0].implicit: it needs an expression");
  EXPECT_NE(refusal(R"("expression": {})").find("an expression needs a sphere, box"), std::string::npos);
  EXPECT_EQ(refusal(R"("expression": {"union": {"of": [{"sphere": {"radius": 0}}]}})"),
            "2: objects[0].implicit: union.of.sphere.radius must be from 1e-9 to 1e6");
  EXPECT_EQ(refusal(R"("expression": {"halfSpace": {"normal": {"y": 1}}})"),
            "2: objects[0].implicit: it has no end, as a half-space or a gyroid has none: give bounds");
  EXPECT_NE(refusal(R"("expression": {"ball": {}})").find("ball"), std::string::npos);
  EXPECT_EQ(refusal(good, R"(, "body": {})"), "2: objects[0].body: only what is made of triangles can be a body");
}

// A NIfTI file of 3 x 2 x 2 int16, whose samples are x, 2 mm apart.
std::string smallNifti(const std::string& name) {
  std::string bytes(352, '\0');
  const auto put = [&](std::size_t at, const auto& value) { std::memcpy(bytes.data() + at, &value, sizeof value); };
  put(0, std::int32_t{348});
  put(40, std::array<std::int16_t, 4>{3, 3, 2, 2});
  put(70, std::array<std::int16_t, 2>{4, 16});
  put(76, std::array<float, 4>{1, 2, 2, 2});
  put(108, 352.0F);
  put(112, 1.0F);
  bytes[123] = 2;  // millimetres
  std::memcpy(bytes.data() + 344, "n+1", 4);
  for (int i = 0; i < 12; ++i) {
    const auto sample = static_cast<std::int16_t>(i % 3);
    bytes.append(reinterpret_cast<const char*>(&sample), sizeof sample);
  }
  return fileWith(name, bytes);
}

TEST(SceneFile, ObjectsOfOneVolumeShareItsSamples) {
  smallNifti("small.nii");
  const SceneModel scene = loadSceneFile(fileWith("scene.hl.json", R"({"objects":[
      {"name": "a", "volume": {"file": "small.nii", "iso": 0.5}},
      {"name": "b", "volume": {"file": "small.nii", "iso": 1.5, "spacing": [0.004, 0.002, 0.002]},
       "transform": {"translate": {"y": 1}}}]})"));
  ASSERT_EQ(scene.surfaces.size(), 2U);
  const auto& a = dynamic_cast<const IsoSurface&>(*scene.surfaces[0].source);
  const auto& b = dynamic_cast<const IsoSurface&>(*scene.surfaces[1].source);
  EXPECT_EQ(a.volume(), b.volume());
  EXPECT_EQ(a.iso().value, 0.5);
  EXPECT_NEAR(a.frame().axes.col(0).norm(), 0.002, 1e-9);
  EXPECT_NEAR(b.frame().axes.col(0).norm(), 0.004, 1e-12);
  EXPECT_NEAR(b.frame().point(1, 0.5, 0.5).y(), 1, 1e-12);
}

TEST(SceneFile, HeightsWithACameraAreADepthImage) {
  fileWith("depth.asc", "ncols 3\nnrows 2\ncellsize 1\n500 500 500\n500 500 700");
  const SceneModel scene = loadSceneFile(fileWith("scene.hl.json", R"({"objects":[
      {"heights": {"file": "depth.asc", "camera": [525, 525, 1, 0.5], "verticalScale": 0.001}}]})"));
  ASSERT_EQ(scene.surfaces.size(), 1U);
  const auto& frame = dynamic_cast<const DepthFrame&>(*scene.surfaces[0].source);
  EXPECT_EQ(frame.triangles(), 2U) << "the last pixel is another thing";
  EXPECT_NEAR(frame.cells().pointAt({2, 0}).x(), 0.5 / 525, 1e-9);
  EXPECT_NEAR(frame.cells().pointAt({2, 0}).z(), -0.5, 1e-7);
}

TEST(SceneFile, TheMatterOfAVolumeIsThatOfItsSurfaceToo) {
  const SceneModel scene = loadSceneFile(fileWith("scene.hl.json", R"({"objects":[
      {"volume": {"builtin": "ct:phantom:16", "iso": 0, "matter": [
        {"value": -100, "stiffness": 0.2, "strengthN": 1},
        {"value": 100, "stiffness": 0.6, "strengthN": 3, "resistanceN": 0.5, "dragNsM": 7}]},
       "material": {"stiffness": 1, "staticFriction": 0.3}}]})"));
  ASSERT_EQ(scene.surfaces.size(), 1U);
  const auto& surface = dynamic_cast<const IsoSurface&>(*scene.surfaces[0].source);
  ASSERT_TRUE(surface.matter());
  EXPECT_EQ(surface.matter()->rows()[1].force, (MatterForce{0.5, 7}));
  const Material material = makeSnapshot(scene)->instances[0].surfaces->materials[0];
  EXPECT_DOUBLE_EQ(material.stiffness, 0.4);
  EXPECT_DOUBLE_EQ(material.strength_N, 2);
  EXPECT_EQ(material.static_friction, 0.3);
}

TEST(SceneFile, BuiltinVolumesHaveTheirOwnMaterials) {
  const SceneModel scene = loadSceneFile(fileWith("scene.hl.json", R"({"objects":[{"builtin": "ct:phantom:16"}]})"));
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(scene.surfaces[0].material.stiffness, 0.5);
  EXPECT_EQ(scene.surfaces[1].name, "objects[0] bone");
}

TEST(SceneFile, VolumesThatMakeNoSenseAreRefused) {
  const auto refusal = [](const std::string& volume, const std::string& rest = "") {
    try {
      loadSceneFile(fileWith("scene.hl.json", "{\"objects\":[{\n\"volume\": {" + volume + "}" + rest + "}]}"));
    } catch (const Error& error) {
      return std::string(error.what()).substr(std::string(error.what()).find("scene.hl.json:") + 14);
    }
    return std::string();
  };
  const std::string good = R"("size": [2, 2, 2], "values": [0, 0, 0, 0, 1, 1, 1, 1])";
  smallNifti("small.nii");
  fileWith("field.asc", "ncols 2\nnrows 2\ncellsize 5\n1 2 3 4");
  EXPECT_EQ(refusal(good), "");
  EXPECT_EQ(refusal(good + R"(, "iso": 2)"),
            "2: objects[0].volume: there is no surface at iso 2: its values are from 0 to 1");
  EXPECT_EQ(refusal(good + R"(, "iso": 0)"),
            "2: objects[0].volume: there is no surface at iso 0: its values are from 0 to 1, as all is matter "
            "then");
  EXPECT_EQ(refusal(good + R"(, "iso": 0, "below": true)"), "");
  EXPECT_EQ(refusal(R"("size": [2, 2, 2], "values": [1, 1, 1, 1, 1, 1, 1, 1])"), "") << "it comes with a warning";
  EXPECT_EQ(refusal(R"("size": [2, 2, 2], "values": [7, 7, 7, 7, 7, 7, 7, 7], "missing": 7)"),
            "2: objects[0].volume: no voxel of it has a finite value but 7, which stands for a missing one");
  EXPECT_EQ(refusal(good + R"(, "scale": 1e300)"),
            "2: objects[0].volume: its scale (the slope of a NIfTI file) of 1e+300 and offset of 0 take values beyond "
            "3.4e38");
  EXPECT_EQ(refusal(R"("size": [2, 2, 3], "values": [0, 1])"),
            "2: objects[0].volume: it has fewer samples than it says");
  EXPECT_EQ(refusal(good, R"(, "body": {})"), "2: objects[0].body: only what is made of triangles can be a body");
  EXPECT_NE(refusal(R"("file": "none.nii")").find("there is no such file"), std::string::npos);
  EXPECT_EQ(refusal(R"("file": "field.asc")"), "2: objects[0].volume: field.asc: is no volume");
  EXPECT_EQ(refusal(R"("file": "small.nii", "builtin": "ct:phantom")"),
            "2: objects[0].volume: it has a file or a builtin, not both");
  EXPECT_EQ(refusal(R"("builtin": "teapot")"), "2: objects[0].volume: teapot: is no volume");
  EXPECT_EQ(refusal(good + R"(, "matter": [{"value": 1}, {"value": 1}])"),
            "2: objects[0].volume: matter: the values of its rows must rise from row to row");
  EXPECT_EQ(refusal(good + R"(, "matter": [{"value": 1, "dragNsM": -1}])"),
            "2: objects[0].volume: matter: drag must be from 0 to 1e9");
  EXPECT_EQ(refusal(R"("file": "small.nii", "size": [3, 2, 2])"),
            "2: objects[0].volume: size, values, samples, kind, missing, scale and offset are those of its file");
}

TEST(SceneFile, TheExampleOfPartsLoads) {
  const SceneModel scene = loadSceneFile(std::string(HL_EXAMPLES) + "/parts.hl.json");
  std::vector<std::size_t> parts;
  for (const SceneBody& body : scene.bodies) parts.push_back(partsIn(body.model, body.spec));
  EXPECT_EQ(parts, (std::vector<std::size_t>{5, 1, 12, 2}));
}

// Each is one closed mesh that is cut into parts.
TEST(SceneFile, TheExampleOfHollowBodiesLoads) {
  const SceneModel scene = loadSceneFile(std::string(HL_EXAMPLES) + "/hollow.hl.json");
  ASSERT_EQ(scene.bodies.size(), 3u);
  for (const std::size_t i : {0u, 2u}) {
    const Body body = bodyOf(scene.bodies[i].model, scene.bodies[i].spec);
    EXPECT_GT(body.shape.parts.size(), 8u);
    EXPECT_LT(body.excess_m, 0.03 * body.shape.reach);  // 0.02 of half the diagonal of the bounds
  }
}

SceneModel worldOfJson(const std::string& json) { return loadSceneFile(fileWith("scene.hl.json", json)); }

// Two cubes of 2 units a side with the given body and joint.
std::string twoBodies(const std::string& body, const std::string& joints) {
  const std::string cube =
      R"("primitives": {"vertices": [-1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1],
         "polygons": [{"vertices": [0,3,2,1]}, {"vertices": [4,5,6,7]}, {"vertices": [0,1,5,4]},
                      {"vertices": [3,7,6,2]}, {"vertices": [0,4,7,3]}, {"vertices": [1,2,6,5]}]})";
  return "{\"units\": 0.01, \"objects\": [\n{\"name\": \"a\", " + cube +
         ", \"transform\": {\"scale\": {\"y\": 2}, \"translate\": {\"x\": 5}},\n\"body\": {" + body +
         "}},\n{\"name\": \"b\", " + cube + ", \"body\": {}}],\n\"joints\": [" + joints + "]}";
}

// Balls, the first of which stay where they are.
std::string manyBodies(std::size_t fixed, std::size_t moving) {
  const std::string ball = R"({"primitives": {"vertices": [0,0,0, 1,0,0, 0,1,0, 0,0,1], "triangles": [0,2,1, 0,1,3]},
    "body": {"shape": "BALL", "fixed": )";
  std::string objects;
  for (std::size_t i = 0; i < fixed + moving; ++i)
    objects += (i > 0 ? "," : "") + ball + (i < fixed ? "true}}" : "false}}");
  return "{\"objects\": [" + objects + "]}";
}

TEST(SceneFile, OnlyBodiesThatMoveCount) {
  EXPECT_EQ(worldOfJson(manyBodies(kMaxBodies + 1, 3)).bodies.size(), kMaxBodies + 4);
  EXPECT_EQ(worldOfJson(manyBodies(1, kMaxBodies)).bodies.size(), kMaxBodies + 1);
  EXPECT_NE(refusalOf(manyBodies(2, kMaxBodies + 1)).find("1001 bodies can move, and at most 1000 may"),
            std::string::npos);
}

TEST(SceneFile, BodiesArriveInMetres) {
  const SceneModel scene = worldOfJson(twoBodies(
      R"("massKg": 0.2, "shape": "BOX", "staticFriction": 0.6, "dynamicFriction": 0.4, "restitution": 0.5,
         "velocityMS": {"x": 1}, "spinRadS": {"z": 2})",
      R"({"name": "j", "kind": "SLIDER", "bodyA": "a", "bodyB": "b", "anchor": {"x": 2.5}, "axis": {"y": 3},
          "low": -1, "high": 2, "rest": 0.5, "spring": 7, "damping": 8, "friction": 9,
          "table": {"position": [0, 1], "force": [2, 3]}})"));
  ASSERT_EQ(scene.bodies.size(), 2u);
  const SceneBody& a = scene.bodies[0];
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.pose.origin, Vec3(0.05, 0, 0));
  EXPECT_EQ(a.model.bounds().size(), Vec3(0.02, 0.04, 0.02));
  EXPECT_EQ(a.spec.mass_kg, 0.2);
  EXPECT_EQ(a.spec.shape, BodyShape::kBox);
  EXPECT_EQ(a.spec.surface, (BodySurface{0.6, 0.4, 0.5}));
  EXPECT_EQ(a.spec.velocity_m_s, Vec3(1, 0, 0));
  EXPECT_EQ(a.spec.spin_rad_s, Vec3(0, 0, 2));
  EXPECT_EQ(scene.bodies[1].spec, BodySpec{});
  ASSERT_EQ(scene.mechanics.joints.size(), 1u);
  const JointSpec& joint = scene.mechanics.joints[0];
  EXPECT_EQ(joint.kind, JointKind::kSlider);
  EXPECT_EQ(joint.body_a, 1u);
  EXPECT_EQ(joint.body_b, 2u);
  EXPECT_EQ(joint.anchor_W, Vec3(0.025, 0, 0));
  EXPECT_EQ(joint.along, (JointForces{-0.01, 0.02, 0.005, 7, 8, 9, {{0, 0.01}, {2, 3}}}));
  const auto snapshot = makeSnapshot(scene);
  ASSERT_EQ(snapshot->instances.size(), 2u);
  EXPECT_TRUE(snapshot->instances[0].movesAsBody());
  EXPECT_EQ(snapshot->mechanics.joints[0].body_b, snapshot->instances[1].key);
}

TEST(SceneFile, BodiesThatCannotBeAreRefusedByLine) {
  const auto expect = [](const std::string& body, const std::string& joints, const std::string& about) {
    const std::string message = afterFile(refusalOf(twoBodies(body, joints)));
    EXPECT_NE(message.find(about), std::string::npos) << message;
    EXPECT_EQ(message[0], ':') << message;
  };
  expect(R"("massKg": -1)", "", "objects[0].body.massKg");
  expect(R"("massKg": "NaN")", "", "must be a finite number");
  expect(R"("restitution": 1.5)", "", "objects[0].body.restitution");
  expect(R"("staticFriction": 0.1, "dynamicFriction": 0.2)", "", "staticFriction must not be less");
  expect("", R"({"bodyA": "c"})", "there is no body 'c'");
  expect("", R"({"bodyA": "a", "bodyB": "a"})", "joins a body to itself");
  std::string twice = twoBodies("", R"({"bodyA": "a"})");
  twice.replace(twice.find("\"name\": \"b\""), 11, "\"name\": \"a\"");
  EXPECT_NE(refusalOf(twice).find("there are several bodies 'a'"), std::string::npos);
  expect("", R"({"bodyA": "a", "kind": "HINGE"})", "needs an axis");
  expect("", R"({"bodyA": "a", "low": 2, "high": 1})", "low must not be above high");
  expect(R"("fixed": true, "velocityMS": {"x": 1})", "", "a fixed body has no velocityMS");
  expect("", R"({"bodyA": "a", "axis": {"x": 1}})", "only a hinge or slider has an axis");
  expect("", R"({"bodyA": "a", "kind": "FIXED", "anchorB": {"x": 1}})", "only a distance has an anchorB");
  expect("", R"({"bodyA": "a", "kind": "DISTANCE", "high": 0})", "high of a distance must be greater than 0");
  expect("", R"({"bodyA": "a", "kind": "DISTANCE", "low": -1})", "low of a distance must not be below 0");
  expect("", R"({"bodyA": "a", "spring": 3})", "a ball or fixed joint has no coordinate");
  expect("", R"({"bodyA": "a", "kind": "FIXED", "high": 1})", "a ball or fixed joint has no coordinate");
  expect("", R"({"bodyA": "a", "table": {"position": [0, 0], "force": [1, 1]}})", "must increase");
}

// The squares of a direction may leave the range of doubles though the direction does not.
TEST(SceneFile, DirectionsMayHaveAnyFiniteLengthButZero) {
  const auto triangle = [](const std::string& more) {
    return R"({"name": "a", "primitives": {"vertices": [-1,-1,-1, 1,-1,-1, 1,1,-1, 0,0,1],
      "triangles": [0,1,2, 0,1,3, 1,2,3, 2,0,3]})" +
           more + "}";
  };
  const auto sceneWith = [&](const std::string& length) {
    const std::string direction = R"({"x": )" + length + R"(, "z": )" + length + "}";
    const std::string turned = R"("axis": )" + direction + R"(, "degrees": 50)";
    return worldOfJson(R"({"objects": [)" +
                       triangle(R"(, "transform": {)" + turned + R"(}, "body": {}, "fields": [{"kind": "CONSTANT",
           "points": [0,0,0], "reach": 1, "forceN": 1, "direction": )" +
                                direction + R"(}], "snaps": [{
           "points": [0,0,0], "capture": 1, "releaseN": 1, "normal": )" +
                                direction + "}]") +
                       R"(, {"implicit": {"expression": {"box": {"size": {"x": 1, "y": 1, "z": 1}}, )" + turned +
                       R"(}}},
            {"implicit": {"expression": {"intersection": {"of": [{"sphere": {"radius": 1}},
              {"halfSpace": {"normal": )" +
                       direction + R"(}}]}}}}],
            "joints": [{"kind": "HINGE", "bodyA": "a", "axis": )" +
                       direction + "}]}");
  };
  const SceneModel plain = sceneWith("1");
  const Vec3 unit = Vec3(1, 0, 1).normalized();
  for (const char* length : {"5e-324", "1e-200", "1e-170", "1e-160", "1e-12", "1e7", "1e154", "1e160", "1.7e308"}) {
    const SceneModel scene = sceneWith(length);
    constexpr double kRounding = 1e-15;
    const SceneBody &body = scene.bodies.at(0), &of_plain = plain.bodies.at(0);
    EXPECT_LT((body.pose.rotation - of_plain.pose.rotation).cwiseAbs().maxCoeff(), kRounding) << length;
    EXPECT_LT((body.fields.at(0).direction - unit).norm(), kRounding) << length;
    EXPECT_LT((*body.snaps.at(0).normal - unit).norm(), kRounding) << length;
    EXPECT_LT((scene.mechanics.joints.at(0).axis_W - unit).norm(), kRounding) << length;
    for (std::size_t i = 0; i < 2; ++i) {
      const Box box = scene.surfaces.at(i).source->bounds(), other = plain.surfaces.at(i).source->bounds();
      EXPECT_LT((box.min - other.min).norm() + (box.max - other.max).norm(), 1e-9) << length << ", surface " << i;
    }
  }
}

std::string withSnaps(const std::string& snaps, const std::string& body = "") {
  return R"({"units": 0.01, "objects": [{"name": "a", "primitives": {"vertices": [-1,-1,-1, 1,-1,-1, 1,1,-1, 0,0,1],
    "triangles": [0,1,2, 0,1,3, 1,2,3, 2,0,3]}, )" +
         body + R"("transform": {"scale": {"y": 2}, "axis": {"z": 1}, "degrees": 90, "translate": {"x": 5}},
"snaps": [)" +
         snaps + "]}]}";
}

TEST(SceneFile, SnapsArriveInMetres) {
  const std::string snaps = R"({"name": "p", "points": [1, 1, 0], "capture": 0.5, "releaseN": 2},
    {"points": [0, 0, 0, 1, 0, 0, 1, 1, 1], "capture": 1, "releaseN": 1},
    {"points": [0, 0, 0], "normal": {"x": 3, "y": 3}, "capture": 1, "releaseN": 1})";
  // Scaled to twice along y, turned from x to y, moved by 5: in the world.
  const SceneModel still = worldOfJson(withSnaps(snaps));
  ASSERT_EQ(still.snaps.size(), 3U);
  EXPECT_EQ(still.snaps[0].name, "p");
  EXPECT_LT((still.snaps[0].points[0] - Vec3(0.03, 0.01, 0)).norm(), 1e-15);
  EXPECT_EQ(still.snaps[0].capture_m, 0.005);
  EXPECT_EQ(still.snaps[0].release_N, 2);
  EXPECT_FALSE(still.snaps[0].normal);
  EXPECT_LT((still.snaps[1].points[2] - Vec3(0.03, 0.01, 0.01)).norm(), 1e-15);
  EXPECT_LT((*still.snaps[2].normal - Vec3(-0.5, 1, 0).normalized()).norm(), 1e-15);
  const auto snapshot = makeSnapshot(still);
  EXPECT_EQ(snapshot->snaps.size(), 3U);
  EXPECT_EQ(snapshot->instances[0].snaps->size(), 3U);
  // Of a body: scaled alone.
  const SceneModel moves = worldOfJson(withSnaps(snaps, R"("body": {"massKg": 1},)"));
  EXPECT_TRUE(moves.snaps.empty());
  ASSERT_EQ(moves.bodies[0].snaps.size(), 3U);
  EXPECT_LT((moves.bodies[0].snaps[0].points[0] - Vec3(0.01, 0.02, 0)).norm(), 1e-15);
  EXPECT_EQ(makeSnapshot(moves)->instances[0].snaps->size(), 3U);
}

TEST(SceneFile, SnapsMoveWithTheSizeOfTheScene) {
  SceneModel scene = worldOfJson(withSnaps(R"({"points": [0, 0, 0], "capture": 0.5, "releaseN": 2})"));
  scaleModel(scene, 10);
  EXPECT_LT((scene.snaps[0].points[0] - Vec3(0.5, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(scene.snaps[0].capture_m, 0.05);
  fitModel(scene, 0.1);
  EXPECT_LT(scene.snaps[0].points[0].norm(), 1e-15) << "it is in the middle";
  EXPECT_NEAR(scene.snaps[0].capture_m, 0.05 * 0.1 / 0.4, 1e-15);
}

TEST(SceneFile, SnapsThatCannotBeAreRefusedByLine) {
  const auto expect = [](const std::string& snaps, const std::string& about) {
    const std::string message = afterFile(refusalOf(withSnaps(snaps)));
    EXPECT_NE(message.find(about), std::string::npos) << message;
    EXPECT_EQ(message.substr(0, 2), ":3") << message;
  };
  expect(R"({"points": [1, 2], "capture": 1, "releaseN": 1})", "snaps[0].points must hold 3 numbers each");
  expect(R"({"capture": 1, "releaseN": 1})", "snaps[0].points must hold 3 numbers each, of one point or more");
  expect(R"({"points": [1, 2, 1e7], "capture": 1, "releaseN": 1})", "points must be between");
  expect(R"({"points": [1, 2, 3], "releaseN": 1})", "snaps[0].capture must be between 1e-09 and 1e+09");
  expect(R"({"points": [1, 2, 3], "capture": 1, "releaseN": -1})", "snaps[0].releaseN must be between");
  expect(R"({"points": [1, 2, 3], "normal": {}, "capture": 1, "releaseN": 1})", "normal must not be zero");
  expect(R"({"points": [1, 2, 3, 4, 5, 6], "normal": {"x": 1}, "capture": 1, "releaseN": 1})", "must be one point");
  expect(R"({"points": [1, 2, 3, 1, 2, 3], "capture": 1, "releaseN": 1})",
         "snaps[0].points of a line or curve must not all be the same: write one point once");
  std::string many;
  for (int i = 0; i < 65; ++i) many += R"({"points": [1, 2, 3], "capture": 1, "releaseN": 1},)";
  many.pop_back();
  expect(many, "snaps: there are more than 64");
  std::string corners = "0";
  for (int i = 1; i < 3 * 257; ++i) corners += ", 0";
  expect(R"({"points": [)" + corners + R"(], "capture": 1, "releaseN": 1})", "points must not be more than 256");
}

std::string withFields(const std::string& fields) {
  return R"({"units": 0.01, "objects": [{"name": "a", "primitives": {"vertices": [0, 0, 0], "points": [0]},
    "transform": {"axis": {"z": 1}, "degrees": 90, "translate": {"x": 5}},
"fields": [)" +
         fields + "]}]}";
}

TEST(SceneFile, FieldsArriveInMetres) {
  const SceneModel scene = worldOfJson(withFields(
      R"({"name": "m", "points": [1, 0, 0], "reach": 3, "forceN": 2},
         {"kind": "SPRING", "points": [0, 0, 0, 1, 0, 0], "reach": 3, "stiffnessNM": 50},
         {"kind": "CONSTANT", "points": [0, 0, 0], "reach": 3, "forceN": 1, "direction": {"x": 7}},
         {"kind": "DRAG", "points": [0, 0, 0], "normal": {"x": 2}, "reach": 3, "dampingNsM": 4})"));
  ASSERT_EQ(scene.fields.size(), 4U);
  const FieldSpec& magnet = scene.fields[0];
  EXPECT_EQ(magnet.name, "m");
  EXPECT_EQ(magnet.kind, FieldKind::kMagnet);
  EXPECT_LT((magnet.points[0] - Vec3(0.05, 0.01, 0)).norm(), 1e-15);
  EXPECT_EQ(magnet.reach_m, 0.03);
  EXPECT_EQ(magnet.force_N, 2);
  EXPECT_EQ(scene.fields[1].stiffness_N_m, 50);
  EXPECT_EQ(scene.fields[1].force_N, 1000) << "no limit but the device's";
  EXPECT_LT((scene.fields[2].direction - Vec3(0, 1, 0)).norm(), 1e-15);
  EXPECT_EQ(scene.fields[3].damping_Ns_m, 4);
  EXPECT_LT((*scene.fields[3].normal - Vec3(0, 1, 0)).norm(), 1e-15);
  EXPECT_EQ(makeSnapshot(scene)->fields.size(), 4U);
}

TEST(SceneFile, FieldsThatCannotBeAreRefusedByLine) {
  const auto expect = [](const std::string& fields, const std::string& about) {
    const std::string message = afterFile(refusalOf(withFields(fields)));
    EXPECT_NE(message.find(about), std::string::npos) << message;
    EXPECT_EQ(message.substr(0, 2), ":3") << message;
  };
  expect(R"({"points": [1, 2, 3], "forceN": 1})", "fields[0].reach must be between 1e-09 and 1e+09");
  expect(R"({"points": [1, 2, 3], "reach": 1})", "fields[0].forceN must be between 1e-09 and 1000");
  expect(R"({"points": [1], "reach": 1, "forceN": 1})", "fields[0].points must hold 3 numbers each");
  const std::string magnet = R"({"points": [1, 2, 3], "reach": 1, "forceN": 1, )";
  expect(magnet + R"("dampingNsM": 1})", "fields[0].dampingNsM is nothing that a MAGNET has: leave it out");
  expect(magnet + R"("direction": {"y": 1}})", "fields[0].direction is nothing that a MAGNET has: leave it out");
  expect(R"({"kind": "DRAG", "points": [1, 2, 3], "reach": 1, "dampingNsM": 1, "forceN": 1})",
         "fields[0].forceN is nothing that a DRAG has: leave it out");
  expect(R"({"kind": "DRAG", "points": [1, 2, 3, 1, 2, 3], "reach": 1, "dampingNsM": 1})",
         "fields[0].points of a line or curve must not all be the same: write one point once");
  expect(R"({"kind": "SPRING", "points": [1, 2, 3], "reach": 1})", "stiffnessNM must be between");
  expect(R"({"kind": "DRAG", "points": [1, 2, 3], "reach": 1, "dampingNsM": 101})", "dampingNsM must be between");
  expect(R"({"kind": "CONSTANT", "points": [1, 2, 3], "reach": 1, "forceN": 1})", "direction must not be zero");
}

TEST(SceneFile, ModelFilesAreRelativeToTheScene) {
  fileWith("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(sceneOf(R"({"objects": [{"file": "part.obj"}, {"file": "part.obj"}]})").triangles.size(), 2u);
}

TEST(SceneFile, PatchesBecomeTrianglesOfTheirSurface) {
  const Model model = sceneOf(R"({"objects": [{"primitives": {"patchError": 1e-6, "patches": [
      {"orderU": 3, "orderV": 2, "points": [0.01,0,0, 0.01,0,-0.01, 0,0,-0.01, 0.01,0.02,0, 0.01,0.02,-0.01, 0,0.02,-0.01],
       "weights": [1, 0.7071067811865476, 1, 1, 0.7071067811865476, 1]}]},
      "transform": {"scale": {"x": 2, "y": 2, "z": 2}}}]})");
  EXPECT_GT(model.triangles.size(), 50u);
  EXPECT_LE(model.reading.patch_error_m, 2e-6);
  EXPECT_GT(model.reading.patch_error_m, 2e-7);
  ASSERT_EQ(model.normals.size(), model.positions.size());
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const Vec3 out(model.positions[i].x(), 0, model.positions[i].z());
    EXPECT_NEAR(out.norm(), 0.02, 1e-15);
    EXPECT_LT(model.normals[i].cross(out).norm(), 1e-15);
  }
  const auto refused = [](const std::string& patch, const std::string& about) {
    const std::string line = refusalOf("{\"objects\": [\n{\"primitives\": {" + patch + "}}]}");
    EXPECT_NE(afterFile(line).find(about), std::string::npos) << line;
    EXPECT_TRUE(afterFile(line).starts_with(":2: ")) << line;
  };
  refused(R"("patches": [{"orderU": 9, "orderV": 2, "points": [0,0,0]}])", "patches[0]: orders");
  refused(R"("patches": [{"orderU": 2, "orderV": 2, "points": [0,0,0, 1,0]}])", "patches[0]: points");
  refused(R"("patches": [{"orderU": 2, "orderV": 2, "points": [0,0,0, 1,0,0, 0,1,0]}])", "2 x 2 control points, not 3");
  refused(R"("patchError": -1, "patches": [{"orderU": 2, "orderV": 2, "points": [0,0,0, 1,0,0, 0,1,0, 1,1,0]}])",
          "patchError");
}

TEST(SceneFile, ErrorsNameTheLine) {
  const auto expect = [](const std::string& json, const std::string& line, const std::string& about) {
    const std::string message = afterFile(refusalOf(json));
    EXPECT_TRUE(message.starts_with(":" + line + ": ")) << json << "\n" << message;
    EXPECT_NE(message.find(about), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  expect("", "1", "not JSON");
  expect("{\n\"objects\": [\n{]\n}", "3", "not JSON");
  expect("{\n\"objects\": [{\"builtin\": \"plane:2\",\n\"material\": {\n\"stifness\": 1}}]}", "4", "stifness");
  expect("{\"objects\": [{\"builtin\": \"plane:2\"},\n{\"material\": {\"stiffness\":\n\"soft\"}}]}", "3", "stiffness");
  expect("{\"objects\": [{\"builtin\": \"plane:2\", \"material\": {\n\n\"stiffness\": 1.5}}]}", "3", "between 0");
  expect("{\"objects\": [{\"builtin\": \"plane:2\", \"material\": {\n\"viscosityNsM\": -1}}]}", "2",
         "between 0 and 1e+09");
  expect("{\"objects\": [{\"builtin\": \"plane:2\", \"material\": {\n\"viscosityNsM\": 1e999}}]}", "2", "out of range");
  expect("{\"objects\": [\n{\"builtin\": \"plnae\"}]}", "2", "plnae");
  expect("{\"objects\": [\n\n{\"file\": \"none.obj\"}]}", "3", "none.obj");
  expect("{\"objects\": [\n\n{\"file\": \"scene.hl.json\"}]}", "3", "another");
  expect("{\"objects\": [{\n\"name\": \"a\"}]}", "1", "needs a file");
  expect("{\"objects\": [{\"primitives\": {\"vertices\": [0,0,0],\n\"triangles\": [0,0,1]}}]}", "2", "vertex 1");
  expect("{\"objects\": [{\"primitives\": {\n\"vertices\": [0,0]}}]}", "2", "3 numbers");
  expect("{\"objects\": [{\"builtin\": \"plane:2\", \"transform\": {\n\"translate\": {\"x\": \"NaN\"}}}]}", "2",
         "finite");
  expect("{\"objects\": [{\"builtin\": \"plane:2\", \"material\": {\n\"shade\": 7}}]}", "2", "SMOOTH");
  expect("{\"textures\": [\n{\"name\": \"a\", \"procedural\": {\"kind\": \"lines\", \"duty\": 7}}]}", "2", "duty");
  const std::string lines =
      "{\"textures\": [{\"name\": \"l\", \"procedural\": {\"kind\": \"lines\"}}], \"objects\": [\n";
  expect(
      lines + "{\"builtin\": \"plane:2\", \"material\": {\"textures\": [\n{\"texture\": \"l\", \"quantity\": 900}]}}]}",
      "3", "quantity");
  expect(
      lines +
          "{\"builtin\": \"plane:2\", \"material\": {\"textures\": [{\"texture\": \"l\"},\n{\"texture\": \"l\"}]}}]}",
      "3", "two textures");
  expect("{\"textures\": [\n{\"name\": \"a\", \"file\": \"none.png\"}], \"objects\": [{\"builtin\": \"walker\"}]}", "2",
         "none.png");
  expect("{\"textures\": [\n{\"name\": \"a\", \"procedural\": {\"kind\": \"wood\"}}]}", "2", "wood");
  expect("{\"objects\": [{\"builtin\": \"plane:2\", \"material\": {\"textures\": [\n{\"texture\": \"gone\"}]}}]}", "2",
         "gone");
  expect("{\"objects\": [{\"builtin\": \"plane:2\", \"material\": {\"textures\": [{\"texture\": \"a\\nb\"}]}}]}", "1",
         "a?b");
  EXPECT_NE(afterFile(refusalOf("{}")).find("no objects"), std::string::npos);
  expect(std::string(100, '['), "1", "nested deeper");
  for (const char* none : {"[]", " 3", "null", "\"{}\"", "[{\"objects\": []}]"})
    EXPECT_EQ(afterFile(refusalOf(none)), R"(:1: a scene file must be one object: {"objects": [..]})") << none;
  expect("\xef\xbb\xbf", "1", "not JSON");
  expect("\xef\xbb\xbf\xef\xbb\xbf{}", "1", "not JSON");
}

TEST(SceneFile, APlaceWhereNothingCanBeTouchedIsRefused) {
  for (const std::string far : {"1e12", "1e300"}) {
    for (const std::string body : {"", R"(, "body": {})"}) {
      const std::string text =
          R"({"objects": [{"builtin": "sphere:100", "transform": {"translate": {"y": )" + far + "}}" + body + "}]}";
      EXPECT_EQ(afterFile(refusalOf(text)), ":1: objects[0].transform.translate.y must be between -1e+09 and 1e+09");
    }
  }
}

// In the words of this file's users: those of the program that reads JSON are for programmers.
TEST(SceneFile, AValueOfAnotherKindIsReportedWithWhatToWrite) {
  const auto fault = [](const std::string& object, const std::string& more = "") {
    return afterFile(refusalOf("{\"objects\": [{\"builtin\": \"sphere:100\"," + object + "}]" + more + "}"));
  };
  const std::string at = ":1: objects[0].";
  EXPECT_EQ(fault(R"("material": {"shade": "shiny"})"), at + "material.shade: \"shiny\" is none of SMOOTH, FLAT");
  EXPECT_EQ(fault(R"("material": {"shade": ["FLAT"]})"), at + "material.shade: it must not be a list");
  EXPECT_EQ(fault(R"("material": {"stiffness": {}})"), at + "material: one of its values must not be an object");
  EXPECT_EQ(fault(R"("material": {"stiffness": "high"})"), at + "material.stiffness: \"high\" is not a number");
  EXPECT_EQ(
      fault(R"("primitives": {})"),
      ":1: objects[0]: \"primitives\" is a second one of values that exclude each other: file, builtin, primitives, "
      "heights, volume, cloud, implicit");
  EXPECT_EQ(fault(R"("body": {"velocityMS": 3})"),
            at + R"(body.velocityMS: 3 must be an object: {"x": .., "y": .., "z": ..})");
  EXPECT_EQ(fault(R"("body": {"shape": "CONE"})"),
            at + R"(body.shape: "CONE" is none of HULL, BOX, BALL, CAPSULE, CYLINDER, PARTS)");
  for (const char* word : {"yes", "true", "TRUE", "0", "no"})
    EXPECT_EQ(fault(R"("body": {"fixed": ")" + std::string(word) + "\"}"),
              at + "body.fixed: it must be true or false, without quotation marks");
  EXPECT_EQ(refusalOf(R"({"objects": [{"builtin": "sphere:100", "name": "yes", "body": {"fixed": true}}]})"),
            "accepted");
  EXPECT_EQ(fault(R"("body": {})", R"(, "units": 0)"), ":1: units must be between 1e-09 and 1e+09");
  EXPECT_EQ(fault(R"("material": {"stifness": 1})"), at + "material.stifness: there is no such name");
  EXPECT_EQ(fault(R"("body": {})", R"(, "gravityMS2": -9.81)"),
            R"(:1: gravityMS2: -9.81 must be an object: {"x": .., "y": .., "z": ..})");
  EXPECT_EQ(fault(R"("body": {})", R"(, "joints": [{"kind": "HINGE", "axis": {"y": 1}}])"),
            ":1: joints[0].bodyA must name a body");
}

TEST(SceneFile, AValueOfTheSceneItselfIsReportedAsThoseOfItsObjects) {
  const auto fault = [](const std::string& said) {
    return afterFile(refusalOf("{\"objects\": [{\"builtin\": \"plane:2\"}],\n" + said + "}"));
  };
  EXPECT_EQ(fault(R"("units": [1])"), ":2: units: it must not be a list");
  EXPECT_EQ(fault(R"("gravityMS2": [0, -9.81, 0])"), ":2: gravityMS2: it must not be a list");
  EXPECT_EQ(fault(R"("units": {})"), ":1: one of its values must not be an object");
  EXPECT_EQ(fault(R"("units": "mm")"), ":2: units: \"mm\" is not a number");
  EXPECT_EQ(fault(R"("unit": 1)"), ":2: unit: there is no such name");
}

TEST(SceneFile, ANameThatIsThereTwiceIsRefusedAndNamed) {
  const auto fault = [](const std::string& json) { return afterFile(refusalOf(json)); };
  EXPECT_EQ(fault("{\"objects\": [{\"builtin\": \"plane:2\",\n\"builtin\": \"plane:2\"}]}"),
            ":2: the name \"builtin\" is there twice in one object");
  EXPECT_EQ(fault(R"({"units": 1, "units": 1, "objects": []})"), ":1: the name \"units\" is there twice in one object");
  EXPECT_EQ(fault(R"({"a\nb": 1, "a\nb": 1})").find('\n'), std::string::npos);
  EXPECT_EQ(refusalOf(R"({"objects": [{"builtin": "plane:2"}, {"builtin": "plane:2"}], "units": 1})"), "accepted");
}

TEST(SceneFile, AByteOrderMarkIsNoPartOfTheText) {
  EXPECT_EQ(sceneOf("\xef\xbb\xbf{\"objects\": [{\"builtin\": \"plane:2\"}]}").triangles.size(), 2U);
}

TEST(SceneFile, ASceneOfTooManyPrimitivesIsRefusedOnTheLineThatIsTooMuch) {
  LoadOptions options;
  options.most_primitives = 5000;
  const std::string two = R"({"objects": [{"builtin": "plane:2000"}, {"builtin": "plane:2000"})";
  EXPECT_NO_THROW(loadSceneFile(fileWith("scene.hl.json", two + "]}"), options));
  try {
    loadSceneFile(fileWith("scene.hl.json", two + ",\n{\"builtin\": \"plane:2000\"}]}"), options);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_TRUE(afterFile(error.what()).starts_with(":2: ")) << error.what();
  }
}

TEST(SceneFile, MutatedTextIsReadOrRefusedInOneLine) {
  const std::string sound = R"({"units": 0.5, "textures": [{"name": "l", "procedural": {"kind": "lines", "size": 4}}],
    "objects": [{"name": "a", "primitives": {"vertices": [0,0,0, 1,0,0, 1,1,0], "normals": [0,0,1, 0,0,1, 0,0,1],
      "texcoords": [0,0, 1,0, 1,1], "triangles": [0,1,2], "polygons": [{"vertices": [0,1,2]}]},
      "transform": {"translate": {"x": 1}, "axis": {"z": 1}, "degrees": 30},
      "material": {"stiffness": 0.5, "textures": [{"texture": "l", "quantity": "VISCOSITY", "high": 3}]}}]})";
  std::mt19937 random(17);
  const std::string bytes = "{}[]\",:0129.eE-+\\ntrufalse\x01\xff";
  int read = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = sound;
    for (int edits = 1 + static_cast<int>(random() % 3); edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      const char byte = bytes[random() % bytes.size()];
      if (random() % 3 == 0)
        text.erase(at, 1 + random() % 5);
      else if (random() % 2 == 0)
        text.insert(at, 1, byte);
      else
        text[at] = byte;
      if (text.empty()) break;
    }
    const std::string message = refusalOf(text);
    read += message == "accepted" ? 1 : 0;
    ASSERT_EQ(message.find('\n'), std::string::npos) << text;
  }
  EXPECT_GT(read, 20);
  EXPECT_LT(read, 2900);
}

TEST(SceneFile, TexturesShareTheRoomThereIs) {
  writePng(tempFile("six.png"));
  const auto read = [](const std::string& textures) {
    LoadOptions options;
    options.most_texels = 25;
    loadSceneFile(
        fileWith("room.hl.json", R"({"textures": [)" + textures + R"(], "objects": [{"builtin": "plane:2"}]})"),
        options);
  };
  const std::string sixteen = R"({"name": "a", "procedural": {"kind": "sine", "size": 4}})";
  const std::string six = R"({"name": "b", "file": "six.png"})";
  EXPECT_NO_THROW(read(sixteen + "," + six));
  EXPECT_THROW(read(six + "," + sixteen + R"(,{"name": "c", "file": "six.png"})"), Error);
  EXPECT_THROW(read(six + "," + sixteen + R"(,{"name": "c", "procedural": {"kind": "sine", "size": 2}})"), Error);
}

TEST(Image, PngKeepsSixteenBitsAndTheLowestRowIsFirst) {
  writePng(tempFile("grey.png"));
  const Texture texture = loadImage(tempFile("grey.png"));
  ASSERT_EQ(texture.width, 2u);
  ASSERT_EQ(texture.height, 3u);
  EXPECT_NEAR(texture.texels[0], 20000 / 65535.0, 1e-6);
  EXPECT_NEAR(texture.texels[1], 20001 / 65535.0, 1e-6);
  EXPECT_NEAR(texture.texels[4], 60000 / 65535.0, 1e-6);
}

TEST(Image, JpegColoursBecomeLuminance) {
  boost::gil::rgb8_image_t image(16, 16, boost::gil::rgb8_pixel_t(255, 255, 255), 0);
  boost::gil::write_view(tempFile("white.jpg"), boost::gil::const_view(image), boost::gil::jpeg_tag{});
  const Texture texture = loadImage(tempFile("white.jpg"));
  EXPECT_EQ(texture.texels.size(), 256u);
  EXPECT_NEAR(texture.texels[100], 1, 0.01);
}

TEST(Image, ColoursBecomeTheirLuminanceAndGreyStaysToTheBit) {
  constexpr double kLuminance = (0.299 * 10 + 0.587 * 200 + 0.114 * 90) / 255;
  boost::gil::rgb8_image_t image(2, 1, boost::gil::rgb8_pixel_t(10, 200, 90), 0);
  boost::gil::view(image)(1, 0) = boost::gil::rgb8_pixel_t(77, 77, 77);
  boost::gil::write_view(tempFile("colour.png"), boost::gil::const_view(image), boost::gil::png_tag{});
  const Texture texture = loadImage(tempFile("colour.png"));
  ASSERT_EQ(texture.texels.size(), 2U);
  EXPECT_NEAR(texture.texels[0], kLuminance, 1e-6);
  EXPECT_EQ(texture.texels[1], 77 / 255.0f);
}

TEST(Image, TornAndHostileFilesAreOneLine) {
  writePng(tempFile("whole.png"));
  std::ifstream in(tempFile("whole.png"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::string huge = bytes;
  huge[16] = huge[20] = 0x7f;  // width and height in IHDR
  for (const std::string& content :
       {bytes.substr(0, 20), bytes.substr(0, bytes.size() - 20), huge, std::string("hello")}) {
    const std::string path = fileWith("torn.png", content);
    try {
      loadImage(path);
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find(path), 0u) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  std::string other_end = bytes;
  other_end[other_end.find("IEND") + 3] = 'I';  // no chunk that anyone knows
  EXPECT_THROW(readImage(fileWith("end.png", other_end)), Error) << "in this process";
  boost::gil::rgb8_image_t image(64, 64, boost::gil::rgb8_pixel_t(10, 200, 90), 0);
  boost::gil::write_view(tempFile("whole.jpg"), boost::gil::const_view(image), boost::gil::jpeg_tag{});
  std::ifstream jpeg(tempFile("whole.jpg"), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(jpeg), std::istreambuf_iterator<char>()};
  EXPECT_THROW(loadImage(fileWith("half.jpg", whole.substr(0, whole.size() / 2))), Error);
  EXPECT_THROW(loadImage(fileWith("a.tiff", "x")), Error);
}

}  // namespace
}  // namespace hl::test_scene_file

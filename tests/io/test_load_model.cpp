// Model files: each kind keeps what it holds; broken and hostile ones give one clear line.
#include "io/load_model.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "base/error.h"
#include "builtin.h"
#include "io/isolated.h"
#include "load_refusal.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"
#include "temp_folder.h"

namespace hl::test_load_model {
namespace {

namespace fs = std::filesystem;
using test::fileWith;
using test::loadRefusal;

const char kObj[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nvn 0 0 1\nvt 0.25 0.75\n"
    "f 1/1/1 2/1/1 3/1/1 4/1/1\nl 1 5\n";

TEST(LoadModel, ObjKeepsPolygonsNormalsAndTexcoords) {
  const Model model = loadModel(fileWith("a.obj", kObj));
  EXPECT_EQ(model.triangles.size(), 2u);
  ASSERT_EQ(model.normals.size(), model.positions.size());
  const auto corner = model.triangles[0][0];
  EXPECT_EQ(model.normals[corner], Vec3::UnitZ());
  EXPECT_NEAR(model.texcoords[corner].x(), 0.25, 1e-6);
}

// A square of 1 m whose corner is there.
std::string squareAt(const Vec3& at) {
  std::string text;
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
    text += fmt::format("v {} {} {}\n", at.x() + corner.x(), at.y() + corner.y(), at.z() + corner.z());
  return text + "f 1 2 3 4\n";
}

TEST(LoadModel, DigitsThatAreLostFarFromTheOriginAreReported) {
  const Model far = loadModel(fileWith("far.obj", squareAt(Vec3(1e9, 0, 0))));
  ASSERT_FALSE(far.warnings.empty());
  EXPECT_EQ(far.warnings[0].find("it lies 1e+09 m from the origin, where coordinates are read to 1.2e+02 m only"), 0U)
      << far.warnings[0];
  EXPECT_EQ(loadModel(fileWith("near.obj", squareAt(Vec3(500, 0, 0)))).warnings, std::vector<std::string>{});
  EXPECT_FALSE(loadModel(fileWith("utm.obj", squareAt(Vec3(5e5, 5e6, 0)))).warnings.empty());
  EXPECT_TRUE(loadModel(fileWith("point.obj", "v 1e9 0 0\n")).warnings.empty());
}

double areaOf(const Model& model) {
  double sum = 0;
  for (const auto& [a, b, c] : model.triangles)
    sum += (model.positions[b] - model.positions[a]).cross(model.positions[c] - model.positions[a]).norm() / 2;
  return sum;
}

// The reflex corner (2, 2) lies on the diagonal of an ear; the square has 16, the notch 4.
TEST(LoadModel, APolygonKeepsItsNotch) {
  const std::string points = "0 0 0\n4 0 0\n4 4 0\n2 2 0\n0 4 0\n";
  const std::string obj = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 2 0\nv 0 4 0\nf 1 2 3 4 5\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
      points + "5 0 1 2 3 4\n";
  const std::string x3d =
      "<X3D version='3.3'><Scene><Shape><IndexedFaceSet convex='false' coordIndex='0 1 2 3 4 -1'>"
      "<Coordinate point='0 0 0 4 0 0 4 4 0 2 2 0 0 4 0'/></IndexedFaceSet></Shape></Scene></X3D>";
  for (const auto& [name, text] : std::map<std::string, std::string>{
           {"n.obj", obj}, {"n.ply", ply}, {"n.off", "OFF\n5 1 0\n" + points + "5 0 1 2 3 4\n"}, {"n.x3d", x3d}}) {
    EXPECT_NEAR(areaOf(loadModel(fileWith(name, text))), 12, 1e-9) << name;
  }
}

TEST(LoadModel, ObjKeepsLines) { EXPECT_EQ(loadModel(fileWith("l.obj", kObj)).segments.size(), 1u); }

// What a program that shares no vertices writes: three lines for each triangle, and normals where there are any.
std::string separateObj(const Model& model) {
  std::string obj;
  const auto line = [&](const char* tag, const Vec3& v) {
    obj += fmt::format("{} {:.9g} {:.9g} {:.9g}\n", tag, v.x(), v.y(), v.z());
  };
  for (const auto& triangle : model.triangles) {
    for (const std::uint32_t index : triangle) {
      line("v", model.positions[index]);
      line("vn", model.normals[index]);
    }
  }
  for (std::size_t i = 0; i < model.triangles.size(); ++i)
    obj += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
  return obj;
}

// The same triangles, each with vertices of its own.
Model separated(const Model& model) {
  Model apart;
  for (const auto& triangle : model.triangles) {
    for (const std::uint32_t index : triangle) {
      apart.positions.push_back(model.positions[index]);
      apart.normals.push_back(model.normals[index]);
    }
    const auto end = static_cast<std::uint32_t>(apart.positions.size());
    apart.triangles.push_back({end - 3, end - 2, end - 1});
  }
  apart.materials = model.materials;
  return apart;
}

TEST(LoadModel, VerticesOfAScanAreJoined) {
  const Model terrain = makeBuiltinScene("terrain:5000");
  const Model scan = loadModel(fileWith("scan.obj", separateObj(terrain)));
  EXPECT_EQ(scan.triangles.size(), terrain.triangles.size());
  EXPECT_EQ(scan.positions.size(), terrain.positions.size());
  EXPECT_EQ(scan.reading.joined_vertices, 3 * terrain.triangles.size() - terrain.positions.size());
  EXPECT_TRUE(scan.reading.single_precision);
  // Vertices, indices and the hierarchy: what docs/hierarchy.md says of a mesh with shared vertices.
  EXPECT_LE(makeShape(scan)->geometryBytes() / scan.triangles.size(), 56u);
}

TEST(LoadModel, AWeldedModelIsTouchedWithTheSameBits) {
  for (const bool smooth : {false, true}) {
    Model scan = loadModel(fileWith("touched.obj", separateObj(makeBuiltinScene("terrain:2000"))));
    scan.materials[0].smooth = smooth;
    scan.materials[0].dynamic_friction = 0.2;
    const Box box = scan.bounds();
    const auto apart = makeSnapshot(separated(scan)), welded = makeSnapshot(std::move(scan));
    ASSERT_GT(apart->shape().model.positions.size(), 5 * welded->shape().model.positions.size());
    ProxySettings settings;
    settings.radius = 0.01 * box.size().norm();
    const auto finger = [&](int i) {
      const double t = 1e-3 * i;
      return Vec3(
          box.centre() +
          0.4 * Vec3(std::sin(7 * t), 0.5 * std::cos(11 * t) - 0.3, std::sin(5 * t + 1)).cwiseProduct(box.size()));
    };
    ProxyState a = startProxy({*apart, 0}, settings, finger(0)), b = startProxy({*welded, 0}, settings, finger(0));
    int touching = 0;
    for (int i = 1; i < 1000; ++i) {
      const TickReport ra = tick(a, {*apart, 0}, settings, finger(i)), rb = tick(b, {*welded, 0}, settings, finger(i));
      ASSERT_EQ(a.position, b.position) << i;
      ASSERT_EQ(ra.target, rb.target) << i;
      ASSERT_EQ(ra.injected_J, rb.injected_J) << i;
      touching += ra.contacts.empty() ? 0 : 1;
    }
    EXPECT_GT(touching, 300);
  }
}

TEST(LoadModel, StlAndPlyInText) {
  const char stl[] =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
      "s\n";
  EXPECT_EQ(loadModel(fileWith("a.stl", stl)).triangles.size(), 1u);
  const char ply[] =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  EXPECT_EQ(loadModel(fileWith("a.ply", ply)).triangles.size(), 2u);
}

TEST(LoadModel, BinaryStl) {
  std::string stl(80, ' ');
  const auto put = [&](const auto& value) { stl.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t{1});
  for (const float f : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) put(f);
  put(std::uint16_t{0});
  EXPECT_EQ(loadModel(fileWith("b.stl", stl)).triangles.size(), 1u);
}

TEST(LoadModel, GltfNodesAreTransformed) {
  // One triangle in a node moved by 10 along x and turned a quarter about z.
  const char gltf[] = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0,"translation":[10,0,0],"rotation":[0,0,0.70710678,0.70710678]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const Model model = loadModel(fileWith("a.gltf", gltf));
  ASSERT_EQ(model.triangles.size(), 1u);
  EXPECT_LT((model.positions[model.triangles[0][1]] - Vec3(10, 1, 0)).norm(), 1e-5);
}

// A triangle whose corners are in a file of the given name.
std::string gltfWith(const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
         buffer + R"("}]})";
}

TEST(LoadModel, AFileNamesOthersInItsOwnFolderOnly) {
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
  const fs::path own = test::tempFolder() / "own";
  fs::create_directories(own / "beneath");
  fileWith("far.bin", bytes);
  fileWith("own/near.bin", bytes);
  fileWith("own/beneath/near.bin", bytes);
  fs::create_symlink(test::tempFolder() / "far.bin", own / "link.bin");
  for (const char* name : {"near.bin", "beneath/near.bin"})
    EXPECT_EQ(loadModel(fileWith("own/a.gltf", gltfWith(name))).triangles.size(), 1u) << name;
  for (const char* name : {"../far.bin", "link.bin"})
    EXPECT_NE(loadRefusal(fileWith("own/a.gltf", gltfWith(name))).find("which is not in its folder"), std::string::npos)
        << name;
  EXPECT_NE(loadRefusal(fileWith("own/a.gltf", gltfWith(test::tempFile("far.bin")))), "") << "an absolute name";
}

TEST(LoadModel, AMaterialElsewhereIsLeftOut) {
  fs::create_directories(test::tempFolder() / "own");
  fileWith("far.mtl", "newmtl red\nKd 1 0 0\n");
  const Model model = loadModel(fileWith("own/m.obj", std::string("mtllib ../far.mtl\n") + kObj));
  EXPECT_EQ(model.triangles.size(), 2u);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0], "names 'far.mtl', which is not in its folder and is left out");
}

TEST(LoadModel, X3d) {
  const char x3d[] =
      "<?xml version='1.0'?><X3D version='3.0' profile='Immersive'><Scene><Transform translation='0 0 5'><Shape>"
      "<IndexedFaceSet coordIndex='0 1 2 -1'><Coordinate point='0 0 0, 1 0 0, 0 1 0'/></IndexedFaceSet></Shape>"
      "</Transform></Scene></X3D>";
  EXPECT_EQ(loadModel(fileWith("a.x3d", x3d)).triangles.size(), 1u);
}

TEST(LoadModel, Vrml97WithTransformsAndPrimitives) {
  const char wrl[] =
      "#VRML V2.0 utf8\nTransform { translation 0 0 5 children [ Shape { geometry Box { size 2 2 2 } }\n"
      "Shape { geometry IndexedLineSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0] } coordIndex [0 1 2 -1] } } ] "
      "}\n";
  const Model model = loadModel(fileWith("a.wrl", wrl));
  EXPECT_EQ(model.triangles.size(), 12u);
  EXPECT_EQ(model.segments.size(), 2u);
  EXPECT_NEAR(model.bounds().max.z(), 6, 1e-5);
}

TEST(LoadModel, Vrml1) {
  const char wrl[] =
      "#VRML V1.0 ascii\nSeparator { Translation { translation 3 0 0 } Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] }\n"
      "IndexedFaceSet { coordIndex [0, 1, 2, -1] } }\n";
  const Model model = loadModel(fileWith("b.wrl", wrl));
  EXPECT_EQ(model.triangles.size(), 1u);
  EXPECT_NEAR(model.bounds().min.x(), 3, 1e-6);
}

TEST(LoadModel, RefusalsAreOneLineThatNamesTheFile) {
  const std::string folder = test::tempFolder().string();
  for (const std::string& path :
       {std::string("/nonexistent/a.obj"), folder, fileWith("empty.obj", ""), fileWith("junk.obj", "hello\n"),
        fileWith("noext", "x"), fileWith("strange.xyzzy", "x"), fileWith("junk.glb", "glTFjunkjunkjunk"),
        fileWith("junk.ply",
                 "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n"),
        fileWith("junk.wrl", "#VRML V2.0 utf8\nShape { geometry"), fileWith("nothing.wrl", "not vrml")}) {
    const std::string refusal = loadRefusal(path);
    EXPECT_EQ(refusal.find(path), 0u) << path << ": " << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
  }
}

// Read as it is, the first would take minutes and the second be a model with one corner at the origin.
TEST(LoadModel, APlyFileThatIsCutSaysSo) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n";
  const std::string whole = header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(loadModel(fileWith("whole.ply", whole)).triangles.size(), 1U);
  for (std::size_t bytes = 4; bytes + 2 < header.size(); bytes += 7)
    EXPECT_NE(loadRefusal(fileWith("head.ply", whole.substr(0, bytes))).find("end_header"), std::string::npos) << bytes;
  const auto counted = [&](const std::string& count) {
    const std::string start = "ply\nformat binary_little_endian 1.0\nelement vertex " + count;
    return loadRefusal(fileWith("count.ply", start + "\nproperty float x\nelement face 1\nend_header\n"));
  };
  EXPECT_NE(counted("99999999999999999999").find("'99999999999999999999' is no count of elements"), std::string::npos);
  EXPECT_NE(counted("-3").find("'-3' is no count of elements"), std::string::npos);
  EXPECT_NE(counted("18446744073709551615").find("it is cut: its header tells of 18446744073709551615 elements"),
            std::string::npos);
  EXPECT_NE(loadRefusal(fileWith("cut.ply", header + "0 0 0\n1 0 0\n")).find("4 elements, and 2 lines"),
            std::string::npos);
}

TEST(LoadModel, BadNumbersAreSkippedWithACount) {
  const Model model =
      loadModel(fileWith("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\n"));
  const auto snapshot = makeSnapshot(model, HierarchyKind::kNone);
  EXPECT_EQ(snapshot->primitives, 1u);
}

constexpr char kPlyHead[] =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";

// All of it is valid, and was lost without a word.
TEST(LoadModel, ObjWithAMarkBlanksBeforeLinesAndCommentsBehindThem) {
  const std::string obj = "v 0 0 0\n  v 1 0 0\n\tv 0 1 0 # corner\r\n v 5 5 5\n  f 1 2 3 # face\nf 1 2 4\n";
  const Model model = loadModel(fileWith("marked.obj", "\xef\xbb\xbf" + obj));
  EXPECT_EQ(model.triangles.size(), 2u);
  EXPECT_EQ(model.positions.size(), 4u);
  EXPECT_EQ(model.bounds().max, Vec3(5, 5, 5));
  EXPECT_EQ(loadModel(fileWith("blank.obj", " " + obj)).triangles.size(), 2u);
}

TEST(LoadModel, APlyFileWithElementsThatAreNotReadSaysSo) {
  const std::string format = "ply\nformat ascii 1.0\n", camera = "element camera 1\nproperty float x\n";
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_index\n", end = "end_header\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n", face = "3 0 1 2\n";
  const std::string refused = "has elements of the kind 'camera' before";
  const std::string between = format + vertices + camera + faces + end + points + "7\n" + face;
  EXPECT_NE(loadRefusal(fileWith("c.ply", between)).find(refused), std::string::npos);
  const std::string first = format + camera + vertices + faces + end + "7\n" + points + face;
  EXPECT_NE(loadRefusal(fileWith("c.ply", first)).find(refused), std::string::npos);
  const std::string last = format + vertices + faces + camera + end + points + face + "7\n";
  EXPECT_EQ(loadModel(fileWith("c.ply", last)).triangles.size(), 1u);
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
  EXPECT_NE(loadRefusal(fileWith("c.ply", format + vertices + strips + end + points + face)).find("tristrips"),
            std::string::npos);
}

TEST(LoadModel, AGltfFileThatNeedsAnUnknownExtensionSaysSo) {
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  fileWith("my buf.bin", std::string(reinterpret_cast<const char*>(corners), sizeof corners));
  std::string gltf = gltfWith("my%20buf.bin");  // as a URI has it
  EXPECT_EQ(loadModel(fileWith("uri.gltf", gltf)).triangles.size(), 1u);
  const auto needing = [&](const std::string& extension) {
    return fileWith("needs.gltf", "{\"extensionsRequired\":[\"" + extension + "\"]," + gltf.substr(gltf.find('{') + 1));
  };
  EXPECT_NE(loadRefusal(needing("EXT_mesh_gpu_instancing")).find("needs the extension EXT_mesh_gpu"),
            std::string::npos);
  EXPECT_EQ(loadModel(needing("KHR_materials_unlit")).triangles.size(), 1u);
}

TEST(LoadModel, AVrmlShapeWithPointsThatDoNotExistIsLeftOut) {
  const std::string begin =
      "#VRML V2.0 utf8\nShape { geometry Box {} }\nShape { geometry IndexedFaceSet { coord Coordinate ";
  const auto with = [&](const std::string& index) {
    return loadModel(
        fileWith("i.wrl", begin + "{ point [0 0 0, 1 0 0, 0 1 0] } coordIndex [0 1 " + index + " -1] } }\n"));
  };
  EXPECT_EQ(with("2").triangles.size(), 13u);
  for (const char* index : {"3", "5000", "-7"}) {
    const Model model = with(index);
    EXPECT_EQ(model.triangles.size(), 12u) << index;
    ASSERT_EQ(model.warnings.size(), 1u) << index;
    EXPECT_EQ(model.warnings[0], "skipped 1 shapes with indices of points that do not exist");
  }
}

TEST(LoadModel, VerticesAloneArePoints) {
  const Model ply = loadModel(fileWith("p.ply", std::string(kPlyHead) + "end_header\n0 0 0\n1 0 0\n0 1 0\n"));
  EXPECT_EQ(ply.points.size(), 3u);
  EXPECT_EQ(ply.positions[ply.points[1]], Vec3(1, 0, 0));
  EXPECT_EQ(loadModel(fileWith("bare.obj", "v 0 0 0\nv 1 2 3\nv 4 5 6\n")).points.size(), 3u);
}

TEST(LoadModel, OnePointIsAModel) {
  for (const char* obj : {"v 1 2 3\n", "v 1 2 3\np 1\n"}) {
    const Model model = loadModel(fileWith("one.obj", obj));
    ASSERT_EQ(model.points.size(), 1u) << obj;
    EXPECT_EQ(model.positions[model.points[0]], Vec3(1, 2, 3));
  }
}

TEST(LoadModel, VerticesBesideFacesAreNoPoints) {
  const std::string ply = std::string(kPlyHead) +
                          "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_TRUE(loadModel(fileWith("f.ply", ply + "3 0 1 2\n")).points.empty());
}

TEST(LoadModel, TornFilesNeverCrash) {
  std::mt19937 random(3);
  for (const auto& [name, content] : {std::pair<std::string, std::string>{"torn.obj", kObj}}) {
    for (int i = 0; i < 30; ++i) {
      std::string torn = content.substr(0, 1 + random() % content.size());
      for (int k = 0; k < 3; ++k) torn[random() % torn.size()] = static_cast<char>(random() % 256);
      loadRefusal(fileWith(name, torn));
    }
  }
}

// Debian's assimp-testmodels: many formats, some broken on purpose. Each loads or is refused in one line.
TEST(LoadModel, EveryTestModelLoadsOrIsRefused) {
  const fs::path folder = "/usr/share/assimp/models";
  if (!fs::exists(folder)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
  int loaded = 0;
  int refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.file_size() > 1'000'000) continue;
    std::string ending = entry.path().extension().string();
    if (ending != ".obj" && ending != ".ply" && ending != ".stl" && ending != ".gltf" && ending != ".glb" &&
        ending != ".x3d" && ending != ".wrl") {
      continue;
    }
    const std::string refusal = loadRefusal(entry.path().string());
    (refusal.empty() ? loaded : refused)++;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
  }
  std::printf("%d test models loaded, %d refused\n", loaded, refused);
  EXPECT_GT(loaded, 20);
}

}  // namespace
}  // namespace hl::test_load_model

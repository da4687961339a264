// Models that bones, skins and morph targets bend stand as their file poses them, without an animation.
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "gltf_document.h"
#include "io/load_model.h"
#include "load_refusal.h"
#include "temp_folder.h"

namespace hl::test_model_pose {
namespace {

using test::cornersOf;
using test::fileWith;
using test::GltfDocument;
using test::loadRefusal;

// A mesh of random triangles without shared corners, bent by a skin of random joints with up to two sets of weights and
// by morph targets, and where each corner has to be (glTF 2.0, 3.7.3.3).
struct Character {
  static constexpr std::size_t kVertices = 12, kJoints = 5;

  explicit Character(unsigned seed) : random(seed) {
    mesh_at = transform();
    for (Eigen::Affine3d& joint : joints) joint = transform();
    for (Eigen::Affine3d& inverse : inverse_bind) inverse = transform();
    for (Vec3& vertex : vertices) vertex = Vec3(between(-1, 1), between(-1, 1), between(-1, 1));
    for (Vec3& vertex : moved) vertex = Vec3(between(-1, 1), between(-1, 1), between(-1, 1));
  }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Eigen::Affine3d transform() {
    Eigen::Affine3d made = Eigen::Affine3d::Identity();
    made.translate(Vec3(between(-1, 1), between(-1, 1), between(-1, 1)));
    made.rotate(Eigen::Quaterniond(between(-1, 1), between(-1, 1), between(-1, 1), 1).normalized());
    made.scale(Vec3(between(0.5, 2), between(0.5, 2), between(0.5, 2)));
    return made;
  }
  static std::string matrix(const Eigen::Affine3d& transform) {
    const Eigen::Matrix4d m = transform.matrix();
    return fmt::format(R"("matrix":[{}])", fmt::join(m.data(), m.data() + 16, ","));
  }
  template <std::size_t N>
  static std::vector<float> floats(const std::array<Vec3, N>& points) {
    std::vector<float> list;
    for (const Vec3& point : points) {
      for (int k = 0; k < 3; ++k) list.push_back(static_cast<float>(point[k]));
    }
    return list;
  }

  // Joint 2 hangs on joint 1, and the mesh on joint 0, whose transform is not to act on it.
  GltfDocument document(int sets, double morph_weight) {
    GltfDocument gltf;
    gltf.attribute("POSITION", gltf.add(floats(vertices), kVertices, "VEC3"));
    for (int set = 0; set < sets; ++set) addSet(gltf, set);
    gltf.primitive = fmt::format(R"(,"targets":[{{"POSITION":{}}}])", gltf.add(floats(moved), kVertices, "VEC3"));
    if (morph_weight != 0) gltf.mesh = fmt::format(R"(,"weights":[{}])", morph_weight);
    std::vector<float> inverse;
    for (const Eigen::Affine3d& one : inverse_bind) {
      const Eigen::Matrix4f m = one.matrix().cast<float>();
      inverse.insert(inverse.end(), m.data(), m.data() + 16);
    }
    gltf.rest = fmt::format(R"(,"skins":[{{"joints":[1,2,3,4,5],"inverseBindMatrices":{}}}])",
                            gltf.add(inverse, kJoints, "MAT4"));
    gltf.nodes = fmt::format(R"({{"name":"body","mesh":0{},{}}})", sets > 0 ? R"(,"skin":0)" : "", matrix(mesh_at));
    for (std::size_t i = 0; i < kJoints; ++i)
      gltf.nodes += fmt::format(R"(,{{{}{}}})", matrix(joints[i]),
                                i == 0   ? R"(,"children":[0])"
                                : i == 1 ? R"(,"children":[3])"
                                         : "");
    gltf.scene_nodes = "1,2,4,5";
    weight_of_morph = morph_weight;
    return gltf;
  }
  void addSet(GltfDocument& gltf, int set) {
    std::vector<std::uint8_t> names;
    std::vector<float> weights;
    for (std::size_t i = 0; i < 4 * kVertices; ++i) {
      names.push_back(static_cast<std::uint8_t>(random() % kJoints));
      weights.push_back(random() % 3 == 0 ? 0 : static_cast<float>(between(0.1, 1)));
      influences.push_back({i / 4, names.back(), static_cast<double>(weights.back())});
    }
    gltf.attribute(fmt::format("JOINTS_{}", set), gltf.add(names.data(), names.size(), 5121, kVertices, "VEC4"));
    gltf.attribute(fmt::format("WEIGHTS_{}", set), gltf.add(weights, kVertices, "VEC4"));
  }

  std::vector<Vec3> expected() const {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < kVertices; ++i) {
      const Vec3 modelled = vertices[i] + weight_of_morph * moved[i];
      Vec3 sum = Vec3::Zero();
      double weights = 0;
      for (const Influence& influence : influences) {
        if (influence.vertex != i) continue;
        sum += influence.weight * (sceneOf(influence.joint) * (inverse_bind[influence.joint] * modelled));
        weights += influence.weight;
      }
      if (influences.empty()) places.push_back(joints[0] * (mesh_at * modelled));
      if (!influences.empty() && weights > 0) places.push_back(sum / weights);
      if (!influences.empty() && weights == 0) {
        const std::size_t first = influences[4 * i].joint;
        places.push_back(sceneOf(first) * (inverse_bind[first] * modelled));
      }
    }
    return places;
  }
  Eigen::Affine3d sceneOf(std::size_t joint) const { return joint == 2 ? joints[1] * joints[2] : joints[joint]; }

  struct Influence {
    std::size_t vertex, joint;
    double weight;
  };
  std::mt19937 random;
  Eigen::Affine3d mesh_at;
  std::array<Eigen::Affine3d, kJoints> joints, inverse_bind;
  std::array<Vec3, kVertices> vertices, moved;
  std::vector<Influence> influences;
  double weight_of_morph = 0;
};

TEST(ModelPose, SkinsAndMorphTargetsOfGltfBendAsTheyAreDefined) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    Character character(seed);
    const GltfDocument gltf =
        character.document(static_cast<int>(seed % 3), seed % 2 == 0 ? 0 : character.between(-1, 1));
    const Model model = loadModel(fileWith("character.gltf", gltf.gltf()));
    EXPECT_TRUE(model.warnings.empty()) << seed;
    const std::vector<Vec3> corners = cornersOf(model), expected = character.expected();
    ASSERT_EQ(corners.size(), expected.size()) << seed;
    for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_LT((corners[i] - expected[i]).norm(), 1e-5) << seed;
  }
}

// A square in the plane z = 0 and its normals, bent by one joint that turns it about x by a right angle.
GltfDocument turnedSquare() {
  GltfDocument gltf;
  gltf.attribute("POSITION", gltf.add({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3, "VEC3"));
  gltf.attribute("NORMAL", gltf.add({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3, "VEC3"));
  const std::vector<std::uint8_t> joints(12, 0);
  gltf.attribute("JOINTS_0", gltf.add(joints.data(), joints.size(), 5121, 3, "VEC4"));
  gltf.attribute("WEIGHTS_0", gltf.add({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 3, "VEC4"));
  gltf.nodes = R"({"mesh":0,"skin":0,"scale":[100,100,100]},{"rotation":[0.70710678,0,0,0.70710678]})";
  gltf.scene_nodes = "0,1";
  gltf.rest = R"(,"skins":[{"joints":[1]}])";
  return gltf;
}

TEST(ModelPose, NormalsTurnWithTheirSkin) {
  const Model model = loadModel(fileWith("turned.gltf", turnedSquare().gltf()));
  ASSERT_EQ(model.normals.size(), 3u);
  for (const Vec3& normal : model.normals) EXPECT_LT((normal - Vec3(0, -1, 0)).norm(), 1e-6);
  EXPECT_LT((cornersOf(model)[2] - Vec3(0, 0, 1)).norm(), 1e-6);
}

TEST(ModelPose, AMeshOfTwoNodesIsBentByEach) {
  GltfDocument gltf = turnedSquare();
  gltf.nodes += R"(,{"mesh":0},{"mesh":0,"skin":1},{"translation":[0,0,5]})";
  gltf.scene_nodes = "0,1,2,3,4";
  gltf.rest = R"(,"skins":[{"joints":[1]},{"joints":[4]}])";
  const std::vector<Vec3> corners = cornersOf(loadModel(fileWith("two.gltf", gltf.gltf())));
  ASSERT_EQ(corners.size(), 9u);
  EXPECT_LT((corners[2] - Vec3(0, 0, 1)).norm(), 1e-6);
  EXPECT_LT((corners[5] - Vec3(0, 1, 0)).norm(), 1e-6);
  EXPECT_LT((corners[8] - Vec3(0, 1, 5)).norm(), 1e-6);
}

TEST(ModelPose, SkinsThatContradictThemselvesAreRefused) {
  const auto refusal = [](const GltfDocument& gltf) { return loadRefusal(fileWith("wrong.gltf", gltf.gltf())); };
  GltfDocument joint = turnedSquare();
  joint.rest = R"(,"skins":[{"joints":[7]}])";
  EXPECT_NE(refusal(joint).find("skins/0: its joints/0 is 7, and there are 2 nodes, from 0"), std::string::npos);
  joint.rest = R"(,"skins":[{"joints":[]}])";
  EXPECT_NE(refusal(joint).find("skins/0: has no joints"), std::string::npos);
  GltfDocument beyond = turnedSquare();
  beyond.bytes[beyond.bytes.size() - 12 * 4 - 12] = 1;
  EXPECT_NE(refusal(beyond).find("its JOINTS_0 names joint 1, and its skin has 1"), std::string::npos)
      << refusal(beyond);
  GltfDocument few = turnedSquare();
  few.rest = fmt::format(R"(,"skins":[{{"joints":[1,0],"inverseBindMatrices":{}}}])",
                         few.add(std::vector<float>(16, 1), 1, "MAT4"));
  EXPECT_NE(refusal(few).find("skins/0: has 2 joints and 1 inverseBindMatrices"), std::string::npos);
  few.rest = R"(,"skins":[{"joints":[1],"inverseBindMatrices":0}])";
  EXPECT_NE(refusal(few).find("skins/0: the accessor of its inverseBindMatrices is no MAT4"), std::string::npos);
}

TEST(ModelPose, ASkinWhoseNodeHasNoExtentIsLeftOutWithAWarning) {
  GltfDocument gltf = turnedSquare();
  gltf.nodes = R"({"mesh":0,"skin":0,"scale":[0,1,1]},{})";
  const Model model = loadModel(fileWith("flat.gltf", gltf.gltf()));
  ASSERT_FALSE(model.warnings.empty());
  EXPECT_NE(model.warnings[0].find("nodes/0: its transform has no inverse"), std::string::npos) << model.warnings[0];
}

// Two triangles of COLLADA: the second is bound to a joint that has moved by 3 since its binding.
TEST(ModelPose, BonesOfColladaBend) {
  const std::string text = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="mesh"><mesh>
<source id="p"><float_array id="pa" count="18">0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1</float_array>
<technique_common><accessor source="#pa" count="6" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 3 4 5</p></triangles>
</mesh></geometry></library_geometries>
<library_controllers><controller id="skin"><skin source="#mesh">
<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
<source id="j"><Name_array id="ja" count="2">j0 j1</Name_array><technique_common><accessor source="#ja" count="2" stride="1"><param name="JOINT" type="name"/></accessor></technique_common></source>
<source id="b"><float_array id="ba" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</float_array><technique_common><accessor source="#ba" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
<source id="w"><float_array id="wa" count="1">1</float_array><technique_common><accessor source="#wa" count="1" stride="1"><param name="WEIGHT" type="float"/></accessor></technique_common></source>
<joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#b"/></joints>
<vertex_weights count="6"><input semantic="JOINT" source="#j" offset="0"/><input semantic="WEIGHT" source="#w" offset="1"/>
<vcount>1 1 1 1 1 1</vcount><v>0 0 0 0 0 0 1 0 1 0 1 0</v></vertex_weights>
</skin></controller></library_controllers>
<library_visual_scenes><visual_scene id="s">
<node id="n0" sid="j0" name="j0" type="JOINT"><node id="n1" sid="j1" name="j1" type="JOINT"><translate>3 0 0</translate></node></node>
<node id="m"><instance_controller url="#skin"><skeleton>#n0</skeleton></instance_controller></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)";
  const std::vector<Vec3> corners = cornersOf(loadModel(fileWith("bones.dae", text)));
  ASSERT_EQ(corners.size(), 6u);
  EXPECT_LT((corners[1] - Vec3(1, 0, 0)).norm(), 1e-6);
  EXPECT_LT((corners[4] - Vec3(4, 0, 1)).norm(), 1e-6);
}

}  // namespace
}  // namespace hl::test_model_pose

#include "io/bone_pose.h"

#include <algorithm>

namespace hl {

namespace {

constexpr int kDeepestBone = 1000;  // deeper nodes are refused where the scene is read

bool anyBones(const aiScene& scene) {
  return std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                     [](const aiMesh* mesh) { return mesh->HasBones(); });
}

}  // namespace

Eigen::Matrix4d matrixOfAssimp(const aiMatrix4x4& m) {
  Eigen::Matrix4d out;
  out << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return out;
}

BonePose::BonePose(const aiScene& scene) {
  if (scene.mRootNode != nullptr && anyBones(scene)) add(*scene.mRootNode, Eigen::Matrix4d::Identity(), 0);
}

void BonePose::add(const aiNode& node, const Eigen::Matrix4d& parent, int depth) {
  if (depth > kDeepestBone) return;
  const Eigen::Matrix4d to_scene = parent * matrixOfAssimp(node.mTransformation);
  nodes_.emplace(node.mName.C_Str(), to_scene);
  for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], to_scene, depth + 1);
}

// By the parts of the sum of a vertex's weights.
std::vector<BentVertex> BonePose::bend(const aiMesh& mesh, const Eigen::Matrix4d& to_scene) const {
  std::vector<BentVertex> bent(mesh.mNumVertices, BentVertex::Zero());
  std::vector<double> sums(mesh.mNumVertices, 0);
  for (unsigned i = 0; i < mesh.mNumBones; ++i) {
    const aiBone& bone = *mesh.mBones[i];
    const auto node = nodes_.find(bone.mName.C_Str());
    const Eigen::Matrix4d moved = node == nodes_.end() ? to_scene : node->second * matrixOfAssimp(bone.mOffsetMatrix);
    for (unsigned k = 0; k < bone.mNumWeights; ++k) {
      const aiVertexWeight& weight = bone.mWeights[k];
      if (weight.mVertexId >= bent.size() || !(weight.mWeight > 0)) continue;
      bent[weight.mVertexId] += static_cast<double>(weight.mWeight) * moved.topRows<3>();
      sums[weight.mVertexId] += static_cast<double>(weight.mWeight);
    }
  }
  for (std::size_t i = 0; i < bent.size(); ++i)
    bent[i] = sums[i] > 0 ? BentVertex(bent[i] / sums[i]) : BentVertex(to_scene.topRows<3>());
  return bent;
}

}  // namespace hl

// Bones of assimp's scenes: what they bend, as it stands without an animation.
#pragma once

#include <assimp/scene.h>

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace hl {

Eigen::Matrix4d matrixOfAssimp(const aiMatrix4x4& matrix);

/// From the coordinates of a vertex to those of the scene.
using BentVertex = Eigen::Matrix<double, 3, 4, Eigen::DontAlign>;

class BonePose {
 public:
  explicit BonePose(const aiScene& scene);

  /// One for each vertex of a mesh that has bones. A vertex without weights, and what hangs on a bone that no node is
  /// named as, goes with the node of the mesh.
  std::vector<BentVertex> bend(const aiMesh& mesh, const Eigen::Matrix4d& to_scene) const;

 private:
  void add(const aiNode& node, const Eigen::Matrix4d& parent, int depth);

  std::map<std::string, Eigen::Matrix4d> nodes_;  // to the scene, by name; the first of a name
};

}  // namespace hl

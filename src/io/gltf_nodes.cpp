#include "io/gltf_nodes.h"

#include <Eigen/Geometry>
#include <cstddef>

#include "io/gltf_item.h"

namespace hl {

namespace {

// By columns in the file. T R S where there is no matrix.
Eigen::Matrix4d ownMatrix(const GltfItem& node) {
  const std::vector<double> matrix = node.numbers("matrix", 16);
  if (!matrix.empty()) return Eigen::Map<const Eigen::Matrix4d>(matrix.data());
  Eigen::Affine3d own = Eigen::Affine3d::Identity();
  const std::vector<double> translation = node.numbers("translation", 3), rotation = node.numbers("rotation", 4),
                            scale = node.numbers("scale", 3);
  if (!translation.empty()) own.translate(Eigen::Vector3d(translation.data()));
  if (!rotation.empty()) own.rotate(Eigen::Quaterniond(rotation.data()).normalized());  // x, y, z, w
  if (!scale.empty()) own.scale(Eigen::Vector3d(scale.data()));
  return own.matrix();
}

}  // namespace

std::vector<Eigen::Matrix4d> gltfNodeMatrices(const boost::json::value& file) {
  const std::vector<GltfItem> nodes = GltfItem(file, "").list("nodes");
  std::vector<Eigen::Matrix4d> matrices(nodes.size());
  std::vector<std::vector<std::size_t>> children;
  std::vector<bool> is_child(nodes.size(), false);
  for (const GltfItem& node : nodes) {
    children.push_back(node.references("children", "nodes", nodes.size()));
    for (const std::size_t child : children.back()) is_child[child] = true;
  }
  std::vector<std::size_t> open;  // each with its matrix, its children not yet
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (is_child[i]) continue;
    matrices[i] = ownMatrix(nodes[i]);
    open.push_back(i);
  }
  std::vector<bool> done(nodes.size(), false);
  while (!open.empty()) {
    const std::size_t parent = open.back();
    open.pop_back();
    if (done[parent]) continue;
    done[parent] = true;
    for (const std::size_t child : children[parent]) {
      matrices[child] = matrices[parent] * ownMatrix(nodes[child]);
      open.push_back(child);
    }
  }
  return matrices;
}

}  // namespace hl

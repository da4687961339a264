// The nodes of a glTF document: where each is in the coordinates of the scene.
#pragma once

#include <Eigen/Core>
#include <boost/json.hpp>
#include <vector>

namespace hl {

/// From each node's coordinates to those of the scene (glTF 2.0, 3.5.3); of nodes that have been checked. Where a file
/// that breaks the rules gives a node two parents, one of them counts.
std::vector<Eigen::Matrix4d> gltfNodeMatrices(const boost::json::value& file);

}  // namespace hl

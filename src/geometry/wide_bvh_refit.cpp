#include "geometry/wide_bvh_refit.h"

#include "geometry/wide_bvh_pack.h"

namespace hl {

namespace {

// A query is a sphere, not a point: boxes count as grown by this part of the root's largest side. So a row of points,
// which has no area, can be judged too.
constexpr double kGrown = 1e-3;

bool used(const WideNode& node, std::size_t lane) { return node.bound[0][0][lane] <= node.bound[1][0][lane]; }

FloatBox laneOf(const WideNode& node, std::size_t lane) {
  FloatBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[static_cast<Eigen::Index>(axis)] = node.bound[0][axis][lane];
    box.max[static_cast<Eigen::Index>(axis)] = node.bound[1][axis][lane];
  }
  return box;
}

Eigen::Array3d sidesOf(const FloatBox& box) { return (box.max - box.min).head<3>().cast<double>(); }

double halfArea(const Eigen::Array3d& sides) { return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0]; }

}  // namespace

// Children have larger numbers than their node, so their boxes are known before it is its turn.
HugeVector<WideNode> refitted(const HugeVector<WideNode>& nodes, const std::vector<FloatBox>& blocks) {
  HugeVector<WideNode> result = nodes;
  std::vector<FloatBox> boxes(nodes.size());
  for (std::size_t i = result.size(); i-- > 0;) {
    WideNode& node = result[i];
    for (std::size_t lane = 0; lane < kWide; ++lane) {
      if (!used(node, lane)) continue;
      const std::uint32_t child = node.child[lane];
      const FloatBox& box = (child & kBlockLink) != 0 ? blocks[child & ~kBlockLink] : boxes[child];
      setBox(node, lane, box);
      boxes[i].extend(box);
    }
  }
  return result;
}

double costOf(const HugeVector<WideNode>& nodes) {
  if (nodes.empty()) return 0;
  FloatBox root;
  for (std::size_t lane = 0; lane < kWide; ++lane) root.extend(laneOf(nodes[0], lane));
  const double grown = kGrown * sidesOf(root).maxCoeff();
  double sum = 0;
  for (const WideNode& node : nodes) {
    for (std::size_t lane = 0; lane < kWide; ++lane) {
      if (used(node, lane)) sum += halfArea(sidesOf(laneOf(node, lane)) + grown);
    }
  }
  return sum / halfArea(sidesOf(root) + grown);
}

}  // namespace hl

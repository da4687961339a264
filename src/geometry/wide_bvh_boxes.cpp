#include "geometry/wide_bvh_boxes.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "base/vec.h"
#include "geometry/float_box.h"

namespace hl {

namespace {

// A query is a sphere, not a point, so boxes count as enlarged by this fraction of the root's largest side. Then a row
// of points, which has no area, also has a cost.
constexpr double kGrown = 1e-3;

// Number of levels from the root whose children are processed in parallel: below them are hundreds of blocks.
int parallelLevels(std::size_t blocks) {
  constexpr std::size_t kBlocksPerThread = 512;
  int levels = 0;
  for (std::size_t left = blocks / kBlocksPerThread; left > 0; left /= kWide) ++levels;
  return levels;
}

template <typename Each>
void forEachLane(int parallel_levels, const Each& each) {
  if (parallel_levels > 0) return oneapi::tbb::parallel_for(std::size_t{0}, kWide, each);
  for (std::size_t lane = 0; lane < kWide; ++lane) each(lane);
}

// One number per primitive of a block.
using Lanes = Eigen::Array<float, kWide, 1>;
using Lanes3 = std::array<Lanes, 3>;

Lanes lanesOf(const std::int16_t (&values)[kWide]) {
  Lanes lanes;
  for (std::size_t lane = 0; lane < kWide; ++lane) lanes[static_cast<Eigen::Index>(lane)] = values[lane];
  return lanes;
}

// Vertices in quantisation steps from the block's origin.
std::array<Lanes3, 3> cornersOf(const WideBlock& block) {
  std::array<Lanes3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) corners[i][axis] = lanesOf(block.vertex[i][axis]);
  }
  return corners;
}

Lanes3 operator-(const Lanes3& a, const Lanes3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The sum of area * n n' over the faces of a block or node, with n the normal of a face. Its eigenvector of the largest
// eigenvalue is the direction that most faces have, regardless of their side.
Mat3 facing(const WideBlock& block) {
  const auto corners = cornersOf(block);
  const Lanes3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const Lanes length2 = normal[0].square() + normal[1].square() + normal[2].square();
  const Lanes per_length = length2.max(1.0f).rsqrt();  // 1: for a primitive without area, or less than a step's
  const double step2 = 1 / (static_cast<double>(block.per_step) * static_cast<double>(block.per_step));
  Mat3 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double part = (normal[i] * normal[j] * per_length).sum();
      sum(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = step2 * part;
      sum(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = step2 * part;
    }
  }
  return sum;
}

// The smallest rotation that takes the nearest axis to `normal`: boxes of neighbours, split along the axes, then lie
// side by side. Rows are the axes of the frame.
Mat3 rotationTo(const Vec3& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Vec3 from = normal[axis] < 0 ? Vec3(-Vec3::Unit(axis)) : Vec3(Vec3::Unit(axis));
  return Eigen::Quaterniond::FromTwoVectors(normal, from).toRotationMatrix();
}

// Below this fraction of the total, a common direction of faces gives no advantage and the axes are used.
constexpr double kCommon = 0.7;

// Maximum height of nodes with a frame. Higher nodes are large compared to a sphere and their faces point in all
// directions, and turning a query takes time.
constexpr int kTurnedHeight = 2;

// The frame is scaled down so that rounding it to multiples of 1 / kFrameOne, with an error of at most sqrt(9) / 2 of
// them, lengthens no vector.
void setFrame(WideNode& node, const Mat3& faces) {
  constexpr double kShrunk = 1 - 2 / static_cast<double>(kFrameOne);
  const Eigen::SelfAdjointEigenSolver<Mat3> directions(faces);
  if (directions.eigenvalues()[2] <= kCommon * faces.trace()) return;
  const Mat3 frame = rotationTo(directions.eigenvectors().col(2));
  node.turned = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t row = 0; row < 3; ++row) {
      const double value = frame(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(axis));
      node.frame[axis][row] = static_cast<std::int16_t>(std::lrint(kShrunk * kFrameOne * value));
    }
  }
}

struct Beneath {
  Mat3 faces = Mat3::Zero();
  int height = 0;  // number of nodes down to the farthest block
};

// NOLINTNEXTLINE(misc-no-recursion): to the tree's bounded depth
Beneath orientFrom(HugeVector<WideNode>& nodes, const HugeVector<WideBlock>& blocks, std::size_t at,
                   int parallel_levels) {
  WideNode& node = nodes[at];
  std::array<Beneath, kWide> parts;
  forEachLane(parallel_levels, [&](std::size_t lane) {
    const std::uint32_t child = node.child[lane];
    if (child == kNoChild) return;
    if (isBlock(child)) {
      parts[lane].faces = facing(blocks[child & ~kBlockLink]);
    } else {
      parts[lane] = orientFrom(nodes, blocks, child, parallel_levels - 1);
    }
  });
  Beneath all;
  for (const Beneath& part : parts) {
    all.faces += part.faces;
    all.height = std::max(all.height, part.height + 1);
  }
  if (all.height <= kTurnedHeight) setFrame(node, all.faces);
  return all;
}

Mat3 frameOf(const WideNode& node) {
  if (node.turned == 0) return Mat3::Identity();
  Mat3 frame;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t row = 0; row < 3; ++row)
      frame(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(axis)) = node.frame[axis][row];
  }
  return frame / kFrameOne;
}

FloatBox boxIn(const WideNode& node, const WideBlock& block) {
  constexpr double kPacked = 1;  // steps: the error of a vertex is at most sqrt(3) / 2, that of the products far less
  const Mat3 frame = frameOf(node);
  const auto corners = cornersOf(block);
  Vec3 low, high;
  for (Eigen::Index row = 0; row < 3; ++row) {
    const Eigen::Vector3f along = frame.row(row).transpose().cast<float>();
    const auto at = [&](std::size_t i) -> Lanes {
      return along[0] * corners[i][0] + along[1] * corners[i][1] + along[2] * corners[i][2];
    };
    const Lanes a = at(0), b = at(1), c = at(2);
    low[row] = a.min(b).min(c).minCoeff() - kPacked;
    high[row] = a.max(b).max(c).maxCoeff() + kPacked;
  }
  const double step = 1 / static_cast<double>(block.per_step);
  const Vec3 origin = frame * Vec3(block.origin[0], block.origin[1], block.origin[2]);
  return roundedOutward(origin + step * low, origin + step * high);
}

FloatBox laneOf(const WideNode& node, std::size_t lane) {
  FloatBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[static_cast<Eigen::Index>(axis)] = node.bound[0][axis][lane];
    box.max[static_cast<Eigen::Index>(axis)] = node.bound[1][axis][lane];
  }
  return box;
}

// Bounds, in the frame of `node`, of the boxes of its child node.
FloatBox boxIn(const WideNode& node, const WideNode& child) {
  const Mat3 turn = frameOf(node) * frameOf(child).inverse();
  const Mat3 sizes = turn.cwiseAbs();
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t lane = 0; lane < kWide; ++lane) {
    if (child.child[lane] == kNoChild) continue;
    const FloatBox box = laneOf(child, lane);
    const Vec3 min = box.min.head<3>().cast<double>(), max = box.max.head<3>().cast<double>();
    const Vec3 middle = turn * (0.5 * (min + max)), half = sizes * (0.5 * (max - min));
    low = low.cwiseMin(middle - half);
    high = high.cwiseMax(middle + half);
  }
  return roundedOutward(low, high);
}

void setBox(WideNode& node, std::size_t lane, const FloatBox& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.bound[0][axis][lane] = box.min[static_cast<Eigen::Index>(axis)];
    node.bound[1][axis][lane] = box.max[static_cast<Eigen::Index>(axis)];
  }
}

void encloseFrom(HugeVector<WideNode>& nodes, const HugeVector<WideNode>& from, const HugeVector<WideBlock>& blocks,
                 std::size_t at, int parallel_levels) {
  WideNode& node = nodes[at];
  node = from[at];
  forEachLane(parallel_levels, [&](std::size_t lane) {
    const std::uint32_t child = node.child[lane];
    if (child == kNoChild) return setBox(node, lane, FloatBox());
    if (isBlock(child)) return setBox(node, lane, boxIn(node, blocks[child & ~kBlockLink]));
    encloseFrom(nodes, from, blocks, child, parallel_levels - 1);
    setBox(node, lane, boxIn(node, nodes[child]));
  });
}

Eigen::Array3d sidesOf(const FloatBox& box) { return (box.max - box.min).head<3>().cast<double>(); }

double halfArea(const Eigen::Array3d& sides) { return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0]; }

// Total area of the boxes of its children, each enlarged by `grown`.
double areaBeneath(const WideNode& node, double grown) {
  double sum = 0;
  for (std::size_t lane = 0; lane < kWide; ++lane) {
    if (node.child[lane] != kNoChild) sum += halfArea(sidesOf(laneOf(node, lane)) + grown);
  }
  return sum;
}

}  // namespace

void orient(HugeVector<WideNode>& nodes, const HugeVector<WideBlock>& blocks) {
  if (!nodes.empty()) orientFrom(nodes, blocks, 0, parallelLevels(blocks.size()));
}

HugeVector<WideNode> enclosed(const HugeVector<WideNode>& nodes, const HugeVector<WideBlock>& blocks) {
  HugeVector<WideNode> result(nodes.size());
  if (!nodes.empty()) encloseFrom(result, nodes, blocks, 0, parallelLevels(blocks.size()));
  return result;
}

double costOf(const HugeVector<WideNode>& nodes) {
  using Range = oneapi::tbb::blocked_range<std::size_t>;
  constexpr std::size_t kGrain = 1024;
  if (nodes.empty()) return 0;
  FloatBox root;
  for (std::size_t lane = 0; lane < kWide; ++lane) root.extend(laneOf(nodes[0], lane));
  const double grown = kGrown * sidesOf(root).maxCoeff();
  const auto add = [&](const Range& range, double sum) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) sum += areaBeneath(nodes[i], grown);
    return sum;
  };
  // Deterministic: the order of the sum does not depend on the number of threads.
  const double sum =
      oneapi::tbb::parallel_deterministic_reduce(Range(0, nodes.size(), kGrain), 0.0, add, std::plus<>());
  return sum / halfArea(sidesOf(root) + grown);
}

}  // namespace hl

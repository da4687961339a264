#include "geometry/sphere_tree.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "geometry/sphere_cover.h"

namespace hl {

namespace {

using Sphere = SphereTree::Sphere;
using Leaf = SphereTree::Leaf;
using Node = SphereTree::Node;

// Maximum depth per lg of the number of leaves. The middle split is used as long as halving from there on can still
// meet this limit. So the stack of the traversal and the cost of the build are bounded for every input.
constexpr double kDepthPerLg = 2.5;
// 2.5 * 31, the maximum for an index of 31 bits; a depth-first traversal keeps at most one waiting child per level.
constexpr std::size_t kStackSize = 80;

// Number of the leaf of a negative link.
std::size_t leafOf(std::int32_t link) {
  const std::int32_t leaf = ~link;
  return static_cast<std::size_t>(leaf);
}

Vec3 centreOf(const Sphere& sphere) { return {sphere.centre[0], sphere.centre[1], sphere.centre[2]}; }

// A single-precision sphere that contains the given sphere. The radius grows by 2^-22 of the coordinates, more than the
// centre moves by rounding (at most sqrt(3) 2^-24), and by a relative 2^-20 before it is rounded itself. Both leave
// enough margin for the double-precision sums of the cover and of queries. This bound is used instead of the actual
// rounding error, and the function is not inlined, because GCC 12 at -O2 replaces a double that was narrowed and
// widened again in one function by the original double.
[[gnu::noinline]] Sphere roundedUp(const Vec3& centre, double radius) {
  constexpr double kRelative = 1 + 1.0 / (1 << 20);
  constexpr double kOfCoordinates = 1.0 / (1 << 22);
  const double grown = (radius + kOfCoordinates * centre.cwiseAbs().maxCoeff()) * kRelative;
  Sphere sphere;
  for (std::size_t i = 0; i < 3; ++i) sphere.centre[i] = static_cast<float>(centre[static_cast<Eigen::Index>(i)]);
  sphere.radius = std::nextafter(static_cast<float>(grown), std::numeric_limits<float>::infinity());
  return sphere;
}

// The first heuristic: the smallest sphere around two spheres.
Ball around(const Sphere& a, const Sphere& b) {
  const Vec3 centre_a = centreOf(a);
  const Vec3 between = centreOf(b) - centre_a;
  const double ra = a.radius;
  const double rb = b.radius;
  const double distance = between.norm();
  if (distance + rb <= ra) return {centre_a, ra};
  if (distance + ra <= rb) return {centreOf(b), rb};
  const double radius = 0.5 * (distance + ra + rb);
  return {centre_a + between * ((radius - ra) / distance), radius};
}

// Order along an axis that does not depend on the order of the input, except between equal spheres.
bool before(const Leaf& a, const Leaf& b, std::size_t axis) {
  const auto& p = a.sphere.centre;
  const auto& q = b.sphere.centre;
  if (p[axis] != q[axis]) return p[axis] < q[axis];
  if (p != q) return p < q;
  return a.sphere.radius < b.sphere.radius;
}

class SphereTreeBuilder {
 public:
  SphereTreeBuilder(std::vector<Leaf>& leaves, std::vector<Node>& nodes) : leaves_(leaves), nodes_(nodes) {
    const double lg = std::log2(static_cast<double>(std::max<std::size_t>(leaves.size(), 1)));
    depth_allowed_ = std::max(levelsByHalving(leaves.size()), static_cast<int>(kDepthPerLg * lg));
  }

  // Builds the tree of leaves [begin, end) and returns its link: a node, or ~leaf.
  std::int32_t build(std::size_t begin, std::size_t end, int depth, Sphere& sphere) {
    depth_ = std::max(depth_, depth);
    if (end - begin == 1) {
      sphere = leaves_[begin].sphere;
      return ~static_cast<std::int32_t>(begin);
    }
    Vec3 box_middle;
    const std::size_t middle = split(begin, end, depth, box_middle);
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    std::array<Sphere, 2> child_sphere;
    const std::int32_t left = build(begin, middle, depth + 1, child_sphere[0]);
    const std::int32_t right = build(middle, end, depth + 1, child_sphere[1]);
    sphere = smallerOfBoth(begin, end, box_middle, child_sphere);
    nodes_[self] = Node{sphere, {left, right}};
    return static_cast<std::int32_t>(self);
  }

  int depth() const { return depth_; }

 private:
  static int levelsByHalving(std::size_t leaves) {
    return leaves < 2 ? 0 : static_cast<int>(std::bit_width(leaves - 1));
  }

  // Splits at the middle of the longest axis of the box of leaf centres; at the median when that would leave one side
  // empty (all centres coincide, up to rounding) or more leaves than the depth allows.
  std::size_t split(std::size_t begin, std::size_t end, int depth, Vec3& box_middle) {
    Vec3 low = centreOf(leaves_[begin].sphere);
    Vec3 high = low;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const Vec3 centre = centreOf(leaves_[i].sphere);
      low = low.cwiseMin(centre);
      high = high.cwiseMax(centre);
    }
    box_middle = 0.5 * (low + high);
    Eigen::Index longest = 0;
    (high - low).maxCoeff(&longest);
    const auto axis = static_cast<std::size_t>(longest);

    const auto first = leaves_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = leaves_.begin() + static_cast<std::ptrdiff_t>(end);
    const double plane = box_middle[longest];
    const auto cut = std::partition(first, last, [&](const Leaf& leaf) { return leaf.sphere.centre[axis] < plane; });
    const auto larger = static_cast<std::size_t>(std::max(cut - first, last - cut));
    if (larger < end - begin && depth + 1 + levelsByHalving(larger) <= depth_allowed_) {
      return begin + static_cast<std::size_t>(cut - first);
    }
    const auto median = first + (last - first) / 2;
    std::nth_element(first, median, last, [&](const Leaf& a, const Leaf& b) { return before(a, b, axis); });
    return begin + (end - begin) / 2;
  }

  Sphere smallerOfBoth(std::size_t begin, std::size_t end, const Vec3& box_middle, const std::array<Sphere, 2>& child) {
    // The second heuristic: centred at the middle of the box, just large enough for all leaves.
    double radius = 0;
    for (std::size_t i = begin; i < end; ++i) {
      radius = std::max(radius, (centreOf(leaves_[i].sphere) - box_middle).norm() + leaves_[i].sphere.radius);
    }
    const Ball pair = around(child[0], child[1]);
    return pair.radius < radius ? roundedUp(pair.centre, pair.radius) : roundedUp(box_middle, radius);
  }

  std::vector<Leaf>& leaves_;
  std::vector<Node>& nodes_;
  int depth_allowed_ = 0;
  int depth_ = 0;
};

// Radius of the leaves: the median bounding radius of the primitives that have a size. 1.25 keeps most primitives of an
// even mesh in one sphere each.
double leafRadius(const Primitives& primitives) {
  constexpr double kOfMedian = 1.25;
  std::vector<double> radii;
  radii.reserve(primitives.size());
  for (const Primitive& primitive : primitives) {
    if (primitive.kind != PrimitiveKind::kPoint) radii.push_back(boundingBall(primitive).radius);
  }
  if (radii.empty()) return 0;
  const auto median = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), median, radii.end());
  return kOfMedian * *median;
}

// Lower bound of the time at which a point moving from w (relative to the centre of a sphere) by m comes within `reach`
// of the centre; 2 if never. See sweep.cpp for the roots; all margins make the time earlier.
class EntryTime {
 public:
  EntryTime(const Vec3& from, const Vec3& motion, double radius)
      : from_(from), motion_(motion), speed2_(motion.squaredNorm()) {
    // Rounding of coordinate sums, a few parts in 2^53 of the largest coordinate.
    constexpr double kRounding = 1e-14;
    slack_ = radius + kRounding * (from.cwiseAbs().maxCoeff() + motion.cwiseAbs().maxCoeff());
  }

  double operator()(const Sphere& sphere) const {
    constexpr double kNever = 2;
    constexpr double kWider = 1 + 1e-12;   // of the reach: rounding of the squares
    constexpr double kEarlier = 1 - 1e-7;  // of the time: a grazing root has half of the digits
    const double reach = (slack_ + sphere.radius) * kWider;
    const Vec3 w = from_ - centreOf(sphere);
    const double c = w.squaredNorm() - reach * reach;
    if (c <= 0) return 0;
    const double b = w.dot(motion_);
    if (!(b < 0)) return kNever;
    const double disc = reach * reach * speed2_ - w.cross(motion_).squaredNorm();
    if (disc < 0) return kNever;
    return kEarlier * c / (-b + std::sqrt(disc));
  }

 private:
  Vec3 from_;
  Vec3 motion_;
  double speed2_;
  double slack_ = 0;
};

}  // namespace

SphereTree SphereTree::build(const Primitives& primitives) {
  SphereTree tree;
  const double leaf_radius = leafRadius(primitives);
  tree.leaves_.reserve(primitives.size());
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    coverWithSpheres(primitives[i], leaf_radius, [&](const Ball& ball) {
      tree.leaves_.push_back({roundedUp(ball.centre, ball.radius), static_cast<std::uint32_t>(i)});
    });
  }
  tree.leaves_.shrink_to_fit();
  if (tree.leaves_.empty()) return tree;
  assert(tree.leaves_.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()));
  tree.nodes_.reserve(tree.leaves_.size() - 1);
  SphereTreeBuilder builder(tree.leaves_, tree.nodes_);
  Sphere root;
  builder.build(0, tree.leaves_.size(), 0, root);
  tree.depth_ = builder.depth();
  return tree;
}

std::size_t SphereTree::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  return sweep(centre, Vec3::Zero(), radius, 0, [&](ElementId primitive, double limit) {
    visit(primitive);
    return limit;
  });
}

std::size_t SphereTree::sweep(const Vec3& from, const Vec3& motion, double radius, double,
                              FunctionRef<double(ElementId, double)> visit) const {
  if (leaves_.empty()) return 0;
  struct Waiting {
    std::int32_t link;
    double entry;
  };
  std::array<Waiting, kStackSize> stack;
  std::size_t waiting = 0, looked = 1;
  const EntryTime entry(from, motion, radius);
  double limit = 1;
  Waiting now{nodes_.empty() ? ~0 : 0, entry(nodes_.empty() ? leaves_[0].sphere : nodes_[0].sphere)};
  while (true) {
    // Descends to a leaf by the nearer child; the farther child waits on the stack.
    while (now.entry <= limit && now.link >= 0) {
      const Node& node = nodes_[static_cast<std::size_t>(now.link)];
      std::array<Waiting, 2> child{};
      for (std::size_t i = 0; i < 2; ++i) {
        const std::int32_t link = node.child[i];
        child[i] = {link,
                    entry(link >= 0 ? nodes_[static_cast<std::size_t>(link)].sphere : leaves_[leafOf(link)].sphere)};
      }
      looked += 2;
      if (child[1].entry < child[0].entry) std::swap(child[0], child[1]);
      if (child[1].entry <= limit) {
        assert(waiting < kStackSize);
        stack[waiting++] = child[1];
      }
      now = child[0];
    }
    if (now.entry <= limit) limit = visit(leaves_[leafOf(now.link)].primitive, limit);
    if (waiting == 0) return looked;
    now = stack[--waiting];
  }
}

IndexStats SphereTree::stats() const {
  return IndexStats{nodes_.size(), leaves_.size(), nodes_.capacity() * sizeof(Node) + leaves_.capacity() * sizeof(Leaf),
                    depth_};
}

}  // namespace hl

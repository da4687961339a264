// Compiled once for each instruction set (foreach_target includes this file again). Multiplications and additions stay
// apart, never fused, so that all sets round alike.
#include "geometry/wide_bvh_query.h"

// Their vectors have no size at compile time, so they cannot be members.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// The scalar code too, everywhere, so that it is tested everywhere.
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/wide_bvh_query.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/wide_bvh_float_query.h"

HWY_BEFORE_NAMESPACE();
namespace hl {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kWide>;
using V = hn::Vec<D>;
using Mask = hn::Mask<D>;
constexpr D kFloats;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);

struct V3 {
  V x, y, z;
};

HWY_INLINE V3 operator-(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE V3 scaled(const V3& a, V s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }
HWY_INLINE V3 sum(const V3& a, const V3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE V dot(const V3& a, const V3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V3 choose(Mask mask, const V3& a, const V3& b) {
  return {hn::IfThenElse(mask, a.x, b.x), hn::IfThenElse(mask, a.y, b.y), hn::IfThenElse(mask, a.z, b.z)};
}
HWY_INLINE V3 same(const float (&v)[3]) {
  return {hn::Set(kFloats, v[0]), hn::Set(kFloats, v[1]), hn::Set(kFloats, v[2])};
}

HWY_INLINE unsigned bitsOf(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kFloats, mask, bytes);
  return bytes[0];
}

HWY_INLINE unsigned usedLanes(const WideTree& tree, std::uint32_t block) {
  const std::uint32_t left = tree.primitives - block * static_cast<std::uint32_t>(kWide);
  return left >= kWide ? 0xffu : (1u << left) - 1;
}

// Square of the distance between the box of the way and the boxes from `lane` on.
HWY_INLINE V distance2(const WideNode& node, std::size_t lane, const BoxQuery& query) {
  V sum2 = hn::Zero(kFloats);
  for (int axis = 0; axis < 3; ++axis) {
    const V low = hn::Load(kFloats, node.bound[0][axis] + lane);
    const V high = hn::Load(kFloats, node.bound[1][axis] + lane);
    const V above = hn::Sub(low, hn::Set(kFloats, query.way_max[axis]));
    const V below = hn::Sub(hn::Set(kFloats, query.way_min[axis]), high);
    const V apart = hn::Max(hn::Max(above, below), hn::Zero(kFloats));
    sum2 = hn::Add(sum2, hn::Mul(apart, apart));
  }
  return sum2;
}

HWY_INLINE unsigned overlapped(const WideNode& node, const BoxQuery& query) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kWide; lane += kLanes) {
    const Mask in = hn::Le(distance2(node, lane, query), hn::Set(kFloats, query.reach2));
    bits |= bitsOf(in) << lane;
  }
  return bits;
}

// Which boxes the sphere may enter up to the limit, and when.
HWY_INLINE unsigned entered(const WideNode& node, const BoxQuery& query, float* entry) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kWide; lane += kLanes) {
    V enter = hn::Zero(kFloats);
    V leave = hn::Set(kFloats, query.limit);
    for (int axis = 0; axis < 3; ++axis) {
      const V near = hn::Load(kFloats, node.bound[query.near[axis]][axis] + lane);
      const V far = hn::Load(kFloats, node.bound[1 - query.near[axis]][axis] + lane);
      const V per_motion = hn::Set(kFloats, query.per_motion[axis]);
      enter = hn::Max(enter, hn::Mul(hn::Sub(near, hn::Set(kFloats, query.near_from[axis])), per_motion));
      leave = hn::Min(leave, hn::Mul(hn::Sub(far, hn::Set(kFloats, query.far_from[axis])), per_motion));
    }
    const Mask near_way = hn::Le(distance2(node, lane, query), hn::Set(kFloats, query.reach2));
    bits |= bitsOf(hn::And(hn::Le(enter, leave), near_way)) << lane;
    hn::Store(enter, kFloats, entry + lane);
  }
  return bits;
}

HWY_INLINE V coordinate(const std::int16_t* lanes) {
  const hn::Rebind<std::int16_t, D> packed;
  const hn::RebindToSigned<D> whole;
  return hn::ConvertTo(kFloats, hn::PromoteTo(whole, hn::Load(packed, lanes)));
}

// The primitives of some lanes of a block.
struct Corners {
  V3 a, b, c;
};

HWY_INLINE Corners cornersOf(const WideBlock& block, std::size_t lane) {
  const auto corner = [&](std::size_t i) HWY_ATTR {
    const auto& axes = block.vertex[i];
    return V3{coordinate(axes[0] + lane), coordinate(axes[1] + lane), coordinate(axes[2] + lane)};
  };
  return {corner(0), corner(1), corner(2)};
}

// Keeps the nearer to the origin of `best` and the nearest point of the segment from a along ab.
HWY_INLINE void nearer(const V3& a, const V3& ab, V3& best, V& best2) {
  const V length2 = hn::Max(dot(ab, ab), hn::Set(kFloats, 1e-30f));  // a point: dot(a, ab) is zero
  const V s = hn::Div(hn::Neg(dot(a, ab)), length2);
  const V cut = hn::Min(hn::Max(s, hn::Zero(kFloats)), hn::Set(kFloats, 1.0f));
  const V3 at = sum(a, scaled(ab, cut));
  const V distance2 = dot(at, at);
  const Mask better = hn::Lt(distance2, best2);
  best = choose(better, at, best);
  best2 = hn::IfThenElse(better, distance2, best2);
}

// A direction from the origin toward the point of the primitive nearest to it, of any length. However rough it is, what
// follows from it is true: see Plane.
HWY_INLINE V3 towards(const Corners& p) {
  const V3 ab = p.b - p.a;
  const V3 bc = p.c - p.b;
  const V3 ca = p.a - p.c;
  V3 nearest = p.a;
  V nearest2 = dot(p.a, p.a);
  nearer(p.a, ab, nearest, nearest2);
  nearer(p.b, bc, nearest, nearest2);
  nearer(p.c, ca, nearest, nearest2);
  const V3 normal = cross(ab, bc);
  const V zero = hn::Zero(kFloats);
  const Mask inside =
      hn::And(hn::And(hn::Gt(dot(cross(p.a, p.b), normal), zero), hn::Gt(dot(cross(p.b, p.c), normal), zero)),
              hn::Gt(dot(cross(p.c, p.a), normal), zero));
  const V height = dot(p.a, normal);
  const V3 face = choose(hn::Lt(height, zero), V3{hn::Neg(normal.x), hn::Neg(normal.y), hn::Neg(normal.z)}, normal);
  return choose(inside, face, nearest);
}

// A plane that separates: with n = `toward`, the primitive lies at n . x >= nearest, the sphere about the origin at
// n . x <= edge. Any n proves that they are apart when nearest > edge; that nearest in distance proves the most.
struct Plane {
  V nearest, edge;
};

HWY_INLINE Plane planeAlong(const V3& toward, const Corners& p, V reach) {
  const V nearest = hn::Min(hn::Min(dot(toward, p.a), dot(toward, p.b)), dot(toward, p.c));
  return {nearest, hn::Mul(reach, hn::Sqrt(dot(toward, toward)))};
}

HWY_INLINE Corners seenFrom(const V3& at, const Corners& p) { return {p.a - at, p.b - at, p.c - at}; }

// Which primitives of the block may be within reach.
HWY_INLINE unsigned withinReach(const WideBlock& block, const BlockQuery& query) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kWide; lane += kLanes) {
    const Corners corners = seenFrom(same(query.from), cornersOf(block, lane));
    const Plane plane = planeAlong(towards(corners), corners, hn::Set(kFloats, query.reach));
    bits |= (bitsOf(hn::Gt(plane.nearest, plane.edge)) ^ ((1u << kLanes) - 1)) << lane;
  }
  return bits;
}

// Which primitives of the block may be touched up to the limit, and lower bounds of when. Conservative advancement
// (Mirtich 1996): no touch before the sphere crosses a separating plane, and from there the next plane tells more.
HWY_INLINE unsigned touched(const WideBlock& block, const BlockQuery& query, float limit, float* entry) {
  constexpr int kAdvances = 2;
  const V never = hn::Set(kFloats, 2.0f);
  const V latest = hn::Set(kFloats, limit);
  const V reach = hn::Set(kFloats, query.reach);
  const V3 from = same(query.from);
  const V3 motion = same(query.motion);
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kWide; lane += kLanes) {
    const Corners still = cornersOf(block, lane);
    V time = hn::Zero(kFloats);
    for (int i = 0; i < kAdvances; ++i) {
      const Corners corners = seenFrom(sum(from, scaled(motion, time)), still);
      const V3 toward = towards(corners);
      const Plane plane = planeAlong(toward, corners, reach);
      const V closing = dot(toward, motion);
      const V later = hn::Add(time, hn::Div(hn::Sub(plane.nearest, plane.edge), closing));
      const V crossed = hn::IfThenElse(hn::Gt(closing, hn::Zero(kFloats)), later, never);
      time = hn::IfThenElse(hn::Gt(plane.nearest, plane.edge), hn::Min(crossed, never), time);
      if (hn::AllFalse(kFloats, hn::Le(time, latest))) break;
    }
    bits |= bitsOf(hn::Le(time, latest)) << lane;
    hn::Store(time, kFloats, entry + lane);
  }
  return bits;
}

HWY_INLINE std::size_t takeLowest(unsigned& bits) {
  const auto lane = static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
  bits &= bits - 1;
  return lane;
}

HWY_INLINE std::size_t takeEarliest(unsigned& bits, const float* entry) {
  unsigned rest = bits;
  std::size_t earliest = takeLowest(rest);
  while (rest != 0) {
    const std::size_t lane = takeLowest(rest);
    if (entry[lane] < entry[earliest]) earliest = lane;
  }
  bits &= ~(1u << earliest);
  return earliest;
}

void overlap(const WideTree& tree, const WideQuery& query, FunctionRef<void(std::uint32_t)> visit) {
  const BoxQuery box = boxQuery(tree, query);
  std::uint32_t stack[kWideStackSize];
  std::size_t waiting = 0;
  stack[waiting++] = tree.root;
  while (waiting > 0) {
    const std::uint32_t link = stack[--waiting];
    if ((link & kBlockLink) == 0) {
      const WideNode& node = tree.nodes[link];
      for (unsigned bits = overlapped(node, box); bits != 0;) stack[waiting++] = node.child[takeLowest(bits)];
      continue;
    }
    const std::uint32_t number = link & ~kBlockLink;
    const WideBlock& block = tree.blocks[number];
    unsigned bits = withinReach(block, blockQuery(block, query)) & usedLanes(tree, number);
    while (bits != 0) visit(block.primitive[takeLowest(bits)]);
  }
}

struct Waiting {
  std::uint32_t link;
  float entry;
};

// Puts the children that are entered on the stack, the earliest on top.
HWY_INLINE std::size_t push(const WideNode& node, const BoxQuery& box, Waiting* stack, std::size_t waiting) {
  HWY_ALIGN float entry[kWide];
  unsigned bits = entered(node, box, entry);
  const std::size_t base = waiting;
  while (bits != 0) {
    const std::size_t lane = takeLowest(bits);
    std::size_t at = waiting++;
    for (; at > base && stack[at - 1].entry < entry[lane]; --at) stack[at] = stack[at - 1];
    stack[at] = {node.child[lane], entry[lane]};
  }
  return waiting;
}

void sweep(const WideTree& tree, const WideQuery& query, FunctionRef<double(std::uint32_t, double)> visit) {
  BoxQuery box = boxQuery(tree, query);
  Waiting stack[kWideStackSize];
  std::size_t waiting = 0;
  double limit = 1;
  stack[waiting++] = {tree.root, 0};
  while (waiting > 0) {
    const Waiting now = stack[--waiting];
    if (now.entry > box.limit) continue;
    if ((now.link & kBlockLink) == 0) {
      waiting = push(tree.nodes[now.link], box, stack, waiting);
      continue;
    }
    const std::uint32_t number = now.link & ~kBlockLink;
    const WideBlock& block = tree.blocks[number];
    HWY_ALIGN float entry[kWide];
    unsigned bits = touched(block, blockQuery(block, query), box.limit, entry) & usedLanes(tree, number);
    while (bits != 0) {
      const std::size_t lane = takeEarliest(bits, entry);
      if (entry[lane] > box.limit) break;
      const double sooner = visit(block.primitive[lane], limit);
      if (sooner < limit) setLimit(box, limit = sooner);
    }
  }
}

}  // namespace

void overlapFor(const WideTree& tree, const WideQuery& query, FunctionRef<void(std::uint32_t)> visit) {
  overlap(tree, query, visit);
}
void sweepFor(const WideTree& tree, const WideQuery& query, FunctionRef<double(std::uint32_t, double)> visit) {
  sweep(tree, query, visit);
}

}  // namespace HWY_NAMESPACE
}  // namespace hl
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hl {

HWY_EXPORT(overlapFor);
HWY_EXPORT(sweepFor);

void overlapWide(const WideTree& tree, const WideQuery& query, FunctionRef<void(std::uint32_t)> visit) {
  HWY_DYNAMIC_DISPATCH(overlapFor)(tree, query, visit);
}

void sweepWide(const WideTree& tree, const WideQuery& query, FunctionRef<double(std::uint32_t, double)> visit) {
  HWY_DYNAMIC_DISPATCH(sweepFor)(tree, query, visit);
}

}  // namespace hl
#endif  // HWY_ONCE

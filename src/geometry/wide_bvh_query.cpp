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
constexpr unsigned kAllLanes = (1u << kLanes) - 1;

struct V3 {
  V x, y, z;
  HWY_INLINE V3(V x_, V y_, V z_) : x(x_), y(y_), z(z_) {}
  // One vector at a time: GCC 12 else copies with wider moves, which then wait for the narrower stores before them.
  HWY_INLINE V3(const V3& other) : x(other.x), y(other.y), z(other.z) {}
  V3& operator=(const V3&) = delete;
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

// By axis of a node's frame; the fourth is of no use.
using Axes = hn::CappedTag<float, 4>;
constexpr Axes kAxes;
constexpr std::size_t kAxisLanes = hn::MaxLanes(kAxes);

using PerAxis = hn::Vec<Axes>;

// A vector of the hierarchy in the frame of a node, from one axis on.
HWY_INLINE PerAxis framed(const WideNode& node, std::size_t lane, const float (&v)[4]) {
  const hn::Rebind<std::int16_t, Axes> packed;
  const hn::RebindToSigned<Axes> whole;
  const auto part = [&](std::size_t axis) HWY_ATTR {
    const PerAxis column = hn::ConvertTo(kAxes, hn::PromoteTo(whole, hn::Load(packed, node.frame[axis] + lane)));
    return hn::Mul(column, hn::Set(kAxes, v[axis]));
  };
  return hn::Mul(hn::Add(hn::Add(part(0), part(1)), part(2)), hn::Set(kAxes, 1 / kFrameOne));
}

// The box of the way up to the limit, in the frame of a node or that of the hierarchy.
struct Way {
  HWY_ALIGN float min[4], max[4];
};

// The same, and when the sphere enters and leaves the boxes: on each axis at (bound[near] - near_from) * per_motion and
// at (bound[1 - near] - far_from) * per_motion, times as fractions of the motion.
struct TimedWay : Way {
  HWY_ALIGN float near_from[4], far_from[4], per_motion[4];
  int near[3];
};

HWY_INLINE void setEnd(Way& way, std::size_t lane, PerAxis from, PerAxis motion, float limit) {
  const PerAxis end = hn::Add(from, hn::Mul(motion, hn::Set(kAxes, limit)));
  hn::Store(hn::Min(from, end), kAxes, way.min + lane);
  hn::Store(hn::Max(from, end), kAxes, way.max + lane);
}

HWY_INLINE void setTimes(TimedWay& way, std::size_t lane, PerAxis from, PerAxis motion, float reach) {
  const PerAxis least = hn::Set(kAxes, 1e-30f);  // an axis without motion: finite, so that zero times it is zero
  const PerAxis toward = hn::CopySign(hn::Set(kAxes, reach), motion);
  hn::Store(hn::Add(from, toward), kAxes, way.near_from + lane);
  hn::Store(hn::Sub(from, toward), kAxes, way.far_from + lane);
  const PerAxis distinct = hn::CopySign(hn::Max(hn::Abs(motion), least), motion);
  hn::Store(hn::Div(hn::Set(kAxes, 1.0f), distinct), kAxes, way.per_motion + lane);
}

HWY_INLINE void setNear(TimedWay& way) {
  for (int axis = 0; axis < 3; ++axis) way.near[axis] = way.per_motion[axis] < 0 ? 1 : 0;
}

HWY_INLINE void setEnd(Way& way, const BoxQuery& query) {
  for (std::size_t lane = 0; lane < 4; lane += kAxisLanes)
    setEnd(way, lane, hn::Load(kAxes, query.from + lane), hn::Load(kAxes, query.motion + lane), query.limit);
}

HWY_INLINE void setTimes(TimedWay& way, const BoxQuery& query) {
  for (std::size_t lane = 0; lane < 4; lane += kAxisLanes)
    setTimes(way, lane, hn::Load(kAxes, query.from + lane), hn::Load(kAxes, query.motion + lane), query.reach);
  setNear(way);
}

HWY_INLINE void turn(Way& way, const BoxQuery& query, const WideNode& node) {
  for (std::size_t lane = 0; lane < 4; lane += kAxisLanes)
    setEnd(way, lane, framed(node, lane, query.from), framed(node, lane, query.motion), query.limit);
}

HWY_INLINE void turn(TimedWay& way, const BoxQuery& query, const WideNode& node) {
  for (std::size_t lane = 0; lane < 4; lane += kAxisLanes) {
    const PerAxis from = framed(node, lane, query.from), motion = framed(node, lane, query.motion);
    setEnd(way, lane, from, motion, query.limit);
    setTimes(way, lane, from, motion, query.reach);
  }
  setNear(way);
}

// Square of the distance between the box of the way and the boxes from `lane` on.
HWY_INLINE V distance2(const WideNode& node, std::size_t lane, const Way& way) {
  V sum2 = hn::Zero(kFloats);
  for (int axis = 0; axis < 3; ++axis) {
    const V low = hn::Load(kFloats, node.bound[0][axis] + lane);
    const V high = hn::Load(kFloats, node.bound[1][axis] + lane);
    const V above = hn::Sub(low, hn::Set(kFloats, way.max[axis]));
    const V below = hn::Sub(hn::Set(kFloats, way.min[axis]), high);
    const V apart = hn::Max(hn::Max(above, below), hn::Zero(kFloats));
    sum2 = hn::Add(sum2, hn::Mul(apart, apart));
  }
  return sum2;
}

HWY_INLINE unsigned overlapped(const WideNode& node, const BoxQuery& query, const Way& way) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kWide; lane += kLanes) {
    const Mask in = hn::Le(distance2(node, lane, way), hn::Set(kFloats, query.reach2));
    bits |= bitsOf(in) << lane;
  }
  return bits;
}

// Which boxes the sphere may enter up to the limit, and when.
HWY_INLINE unsigned entered(const WideNode& node, const BoxQuery& query, const TimedWay& way, float* entry) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kWide; lane += kLanes) {
    V enter = hn::Zero(kFloats);
    V leave = hn::Set(kFloats, query.limit);
    for (int axis = 0; axis < 3; ++axis) {
      const V near = hn::Load(kFloats, node.bound[way.near[axis]][axis] + lane);
      const V far = hn::Load(kFloats, node.bound[1 - way.near[axis]][axis] + lane);
      const V per_motion = hn::Set(kFloats, way.per_motion[axis]);
      enter = hn::Max(enter, hn::Mul(hn::Sub(near, hn::Set(kFloats, way.near_from[axis])), per_motion));
      leave = hn::Min(leave, hn::Mul(hn::Sub(far, hn::Set(kFloats, way.far_from[axis])), per_motion));
    }
    const Mask near_way = hn::Le(distance2(node, lane, way), hn::Set(kFloats, query.reach2));
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

// The primitives of some lanes of a block, and what of their nearest points does not depend on where one looks from.
struct Corners {
  V3 a, b, c, ab, ac, normal;
  V ab2, ac2, ab_ac;
};

HWY_INLINE Corners cornersOf(const WideBlock& block, std::size_t lane) {
  const auto corner = [&](std::size_t i) HWY_ATTR {
    const auto& axes = block.vertex[i];
    return V3{coordinate(axes[0] + lane), coordinate(axes[1] + lane), coordinate(axes[2] + lane)};
  };
  const V3 a = corner(0), b = corner(1), c = corner(2), ab = b - a, ac = c - a;
  return {a, b, c, ab, ac, cross(ab, ac), dot(ab, ab), dot(ac, ac), dot(ab, ac)};
}

// Of a point a + v ab + w ac.
struct Weights {
  V v, w;
};

// The place on an edge nearest to the eye, as a part of the edge, and the square of its distance.
struct OnEdge {
  V s, distance2;
};

// An edge of length2 from a corner at distance2; `along` is the product of the edge and the way from there to the eye.
HWY_INLINE OnEdge onEdge(V distance2, V along, V length2) {
  const V positive = hn::Max(length2, hn::Set(kFloats, 1e-30f));  // of a point: then `along` is zero
  const V s = hn::Min(hn::Max(hn::Div(along, positive), hn::Zero(kFloats)), hn::Set(kFloats, 1.0f));
  const V twice = hn::Sub(hn::Add(along, along), hn::Mul(s, length2));
  return {s, hn::Sub(distance2, hn::Mul(s, twice))};
}

HWY_INLINE Weights nearestOnEdges(const Corners& p, V distance2, V along_ab, V along_ac) {
  const V zero = hn::Zero(kFloats);
  const OnEdge ab = onEdge(distance2, along_ab, p.ab2);
  const OnEdge ac = onEdge(distance2, along_ac, p.ac2);
  const V b_distance2 = hn::Add(hn::Sub(distance2, hn::Add(along_ab, along_ab)), p.ab2);
  const V along_bc = hn::Add(hn::Sub(along_ac, along_ab), hn::Sub(p.ab2, p.ab_ac));
  const OnEdge bc = onEdge(b_distance2, along_bc, hn::Sub(hn::Add(p.ab2, p.ac2), hn::Add(p.ab_ac, p.ab_ac)));
  const Mask by_ac = hn::Lt(ac.distance2, ab.distance2);
  const Mask by_bc = hn::Lt(bc.distance2, hn::Min(ab.distance2, ac.distance2));
  const V v = hn::IfThenElse(by_ac, zero, ab.s);
  const V w = hn::IfThenElse(by_ac, ac.s, zero);
  return {hn::IfThenElse(by_bc, hn::Sub(hn::Set(kFloats, 1.0f), bc.s), v), hn::IfThenElse(by_bc, bc.s, w)};
}

// A direction from the eye toward the point of the primitive nearest to it, of any length; a is the way from the eye to
// its first corner. However rough it is, what follows from it is true: see Plane.
HWY_INLINE V3 towards(const Corners& p, const V3& a) {
  const V zero = hn::Zero(kFloats);
  const V along_ab = hn::Neg(dot(a, p.ab));
  const V along_ac = hn::Neg(dot(a, p.ac));
  const Weights edge = nearestOnEdges(p, dot(a, a), along_ab, along_ac);
  const V3 on_edge = sum(a, sum(scaled(p.ab, edge.v), scaled(p.ac, edge.w)));
  // Inside the face the weights, times the determinant, are positive and their sum is less than it.
  const V v = hn::Sub(hn::Mul(p.ac2, along_ab), hn::Mul(p.ab_ac, along_ac));
  const V w = hn::Sub(hn::Mul(p.ab2, along_ac), hn::Mul(p.ab_ac, along_ab));
  const V determinant = hn::Sub(hn::Mul(p.ab2, p.ac2), hn::Mul(p.ab_ac, p.ab_ac));
  const Mask inside = hn::And(hn::Gt(hn::Min(v, w), zero), hn::Lt(hn::Add(v, w), determinant));
  const V side = hn::CopySign(hn::Set(kFloats, 1.0f), dot(a, p.normal));
  return choose(inside, scaled(p.normal, side), on_edge);
}

// A plane that separates: with n = `toward`, the primitive lies at n . x >= nearest, the sphere about the eye at
// n . x <= edge. Any n proves that they are apart when nearest > edge; that nearest in distance proves the most.
struct Plane {
  V nearest, edge;
};

HWY_INLINE Plane planeAlong(const V3& toward, const Corners& p, const V3& eye, V reach) {
  const V nearest = hn::Min(hn::Min(dot(toward, p.a - eye), dot(toward, p.b - eye)), dot(toward, p.c - eye));
  return {nearest, hn::Mul(reach, hn::Sqrt(dot(toward, toward)))};
}

// Which primitives of the block may be within reach.
HWY_INLINE unsigned withinReach(const WideBlock& block, const BlockQuery& query) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kWide; lane += kLanes) {
    const Corners corners = cornersOf(block, lane);
    const V3 eye = same(query.from);
    const Plane plane = planeAlong(towards(corners, corners.a - eye), corners, eye, hn::Set(kFloats, query.reach));
    bits |= (bitsOf(hn::Gt(plane.nearest, plane.edge)) ^ kAllLanes) << lane;
  }
  return bits;
}

// Which primitives of the block may be touched up to the limit, and lower bounds of when. Conservative advancement
// (Mirtich 1996): no touch before the sphere crosses a separating plane, and from there the next plane tells more.
HWY_INLINE unsigned touched(const WideBlock& block, const BlockQuery& query, float limit, float* entry) {
  constexpr int kAdvances = 3;
  const V never = hn::Set(kFloats, 2.0f);
  const V latest = hn::Set(kFloats, limit);
  const V reach = hn::Set(kFloats, query.reach);
  const V3 from = same(query.from);
  const V3 motion = same(query.motion);
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kWide; lane += kLanes) {
    const Corners corners = cornersOf(block, lane);
    V time = hn::Zero(kFloats);
    for (int i = 0; i < kAdvances; ++i) {
      const V3 eye = sum(from, scaled(motion, time));
      const V3 toward = towards(corners, corners.a - eye);
      const Plane plane = planeAlong(toward, corners, eye, reach);
      const V closing = dot(toward, motion);
      const V later = hn::Add(time, hn::Div(hn::Sub(plane.nearest, plane.edge), closing));
      const V crossed = hn::IfThenElse(hn::Gt(closing, hn::Zero(kFloats)), later, never);
      time = hn::IfThenElse(hn::Gt(plane.nearest, plane.edge), crossed, time);
      if (hn::AllTrue(kFloats, hn::Gt(time, latest))) break;
    }
    // Whatever is not surely later, not-a-number too.
    bits |= (bitsOf(hn::Gt(time, latest)) ^ kAllLanes) << lane;
    hn::Store(time, kFloats, entry + lane);
  }
  return bits;
}

HWY_INLINE std::size_t takeLowest(unsigned& bits) {
  const auto lane = static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
  bits &= bits - 1;
  return lane;
}

void overlap(const WideTree& tree, const WideQuery& query, FunctionRef<void(std::uint32_t)> visit) {
  const BoxQuery box = boxQuery(tree, query);
  Way straight, turned;
  setEnd(straight, box);
  std::uint32_t stack[kWideStackSize];
  std::size_t waiting = 0;
  stack[waiting++] = tree.root;
  while (waiting > 0) {
    const std::uint32_t link = stack[--waiting];
    if ((link & kBlockLink) == 0) {
      const WideNode& node = tree.nodes[link];
      if (node.turned != 0) turn(turned, box, node);
      unsigned bits = overlapped(node, box, node.turned != 0 ? turned : straight);
      while (bits != 0) stack[waiting++] = node.child[takeLowest(bits)];
      continue;
    }
    const std::uint32_t number = link & ~kBlockLink;
    const WideBlock& block = tree.blocks[number];
    unsigned bits = withinReach(block, blockQuery(block, query)) & usedLanes(tree, number);
    while (bits != 0) visit(block.primitive[takeLowest(bits)]);
  }
}

// Walks over what lies on the way. The way is long, as goals are far, and mostly ends soon: so the first walk is over a
// part of it, and others over larger parts follow only where nothing is hit.
class Sweep {
 public:
  HWY_INLINE Sweep(const WideTree& tree, const WideQuery& query, FunctionRef<double(std::uint32_t, double)> visit)
      : tree_(tree), query_(query), visit_(visit), box_(boxQuery(tree, query)) {
    setTimes(straight_, box_);
    setEnd(straight_, box_);
  }

  void run() {
    constexpr double kLarger = 8;
    walk();
    while (limit_ == part_ && part_ < 1) {
      proposed_ = box_.limit;
      begin(std::min(1.0, kLarger * part_));
      walk();
    }
  }

 private:
  // Of a child, when its box is entered; of a primitive, a lower bound of when it is touched.
  struct Waiting {
    std::uint32_t link;
    float entry;
  };

  void walk() {
    Waiting stack[kWideStackSize];
    std::size_t waiting = 0;
    stack[waiting++] = {tree_.root, 0};
    while (waiting > 0) {
      const Waiting now = stack[--waiting];
      if (now.entry > box_.limit) continue;
      if ((now.link & kBlockLink) != 0) {
        const std::uint32_t number = now.link & ~kBlockLink;
        if (part_ == 0) begin(std::min(1.0, now.entry + firstPart(tree_.blocks[number], query_)));
        look(number);
      } else {
        waiting = push(tree_.nodes[now.link], stack, waiting);
      }
    }
    propose();
  }

  HWY_INLINE void begin(double part) { shorten(part_ = part); }

  HWY_INLINE void shorten(double limit) {
    limit_ = limit;
    setLimit(box_, limit);
    setEnd(straight_, box_);
  }

  // Puts the children that are entered on the stack, the earliest on top.
  HWY_INLINE std::size_t push(const WideNode& node, Waiting* stack, std::size_t waiting) {
    HWY_ALIGN float entry[kWide];
    if (node.turned != 0) turn(turned_, box_, node);
    unsigned bits = entered(node, box_, node.turned != 0 ? turned_ : straight_, entry);
    const std::size_t base = waiting;
    while (bits != 0) {
      const std::size_t lane = takeLowest(bits);
      insert(stack, base, waiting++, {node.child[lane], entry[lane]},
             [](float one, float other) { return one < other; });
    }
    return waiting;
  }

  HWY_INLINE void look(std::uint32_t number) {
    const WideBlock& block = tree_.blocks[number];
    HWY_ALIGN float entry[kWide];
    unsigned bits = touched(block, blockQuery(block, query_), box_.limit, entry) & usedLanes(tree_, number);
    while (bits != 0) {
      const std::size_t lane = takeLowest(bits);
      if (entry[lane] <= proposed_) continue;
      insert(candidates_, 0, candidate_count_++, {block.primitive[lane], entry[lane]},
             [](float one, float other) { return one > other; });
      if (candidate_count_ == kMostCandidates) propose();
    }
  }

  // The earliest first, as each impact found spares those after it: so candidates wait until the walk has ended or
  // there are too many.
  HWY_INLINE void propose() {
    for (std::size_t i = 0; i < candidate_count_ && candidates_[i].entry <= box_.limit; ++i) {
      const double sooner = visit_(candidates_[i].link, limit_);
      if (sooner < limit_) shorten(sooner);
    }
    candidate_count_ = 0;
  }

  // Keeps list[from..count] in order.
  template <typename Before>
  static HWY_INLINE void insert(Waiting* list, std::size_t from, std::size_t count, const Waiting& one,
                                const Before& before) {
    for (; count > from && before(list[count - 1].entry, one.entry); --count) list[count] = list[count - 1];
    list[count] = one;
  }

  static constexpr std::size_t kMostCandidates = 48;

  const WideTree& tree_;
  const WideQuery& query_;
  FunctionRef<double(std::uint32_t, double)> visit_;
  BoxQuery box_;
  TimedWay straight_, turned_;
  double limit_ = 1;
  double part_ = 0;      // the limit that the walk began with; 0: no block met yet
  float proposed_ = -1;  // what is entered up to here has been proposed
  std::size_t candidate_count_ = 0;
  Waiting candidates_[kMostCandidates];
};

}  // namespace

void overlapFor(const WideTree& tree, const WideQuery& query, FunctionRef<void(std::uint32_t)> visit) {
  overlap(tree, query, visit);
}
void sweepFor(const WideTree& tree, const WideQuery& query, FunctionRef<double(std::uint32_t, double)> visit) {
  Sweep(tree, query, visit).run();
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

// Finds the primitives of a few blocks that a sphere may touch, all at once. It uses lower bounds of the distance, from
// planes that separate the sphere from each primitive. Part of wide_bvh_query.cpp, compiled with it for each
// instruction set.
#if defined(HL_GEOMETRY_WIDE_BVH_BLOCK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HL_GEOMETRY_WIDE_BVH_BLOCK_INL_H
#undef HL_GEOMETRY_WIDE_BVH_BLOCK_INL_H
#else
#define HL_GEOMETRY_WIDE_BVH_BLOCK_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/wide_bvh_float_query.h"

HWY_BEFORE_NAMESPACE();
namespace hl {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// A vector holds the primitives of two blocks if the processor has enough lanes, else a part of one block.
using D = hn::CappedTag<float, 2 * kWide>;
using V = hn::Vec<D>;
using Mask = hn::Mask<D>;
constexpr D kFloats;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
constexpr unsigned kAllLanes = (1u << kLanes) - 1;

struct V3 {
  V x, y, z;
  HWY_INLINE V3(V a, V b, V c) : x(a), y(b), z(c) {}
  // Copies one vector at a time: otherwise GCC 12 uses wider moves, which wait for the narrower stores before them.
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

HWY_INLINE unsigned bitsOf(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kFloats, mask, bytes);
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
}

// Blocks that are tested together, each with the query in its coordinates. Lanes count through all blocks. After an odd
// number of blocks the last one is repeated.
constexpr std::size_t kFewBlocks = 4;
constexpr std::size_t kFewLanes = kFewBlocks * kWide;

struct FewBlocks {
  const WideBlock* block[kFewBlocks];
  BlockQuery query[kFewBlocks];
  std::size_t count;

  std::size_t lanes() const { return count * kWide; }
  std::uint32_t primitive(std::size_t lane) const { return block[lane / kWide]->primitive[lane % kWide]; }
};

// The vector that starts at `lane`, from part(block number, its first lane, floats): from one block, or one half from
// each of two blocks.
template <typename Part>
HWY_INLINE V ofBlocks(std::size_t lane, const Part& part) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kLanes > kWide) {
    const hn::Half<D> half;
    return hn::Combine(kFloats, part(lane / kWide + 1, 0, half), part(lane / kWide, 0, half));
  }
#endif
  if constexpr (kLanes <= kWide) return part(lane / kWide, lane % kWide, kFloats);
}

HWY_INLINE V coordinate(const FewBlocks& blocks, std::size_t lane, std::size_t vertex, std::size_t axis) {
  return ofBlocks(lane, [&](std::size_t which, std::size_t from, auto floats) HWY_ATTR {
    const hn::Rebind<std::int16_t, decltype(floats)> packed;
    const hn::RebindToSigned<decltype(floats)> whole;
    return hn::ConvertTo(floats,
                         hn::PromoteTo(whole, hn::Load(packed, blocks.block[which]->vertex[vertex][axis] + from)));
  });
}

// number(query) for the query in the coordinates of each block.
template <typename Number>
HWY_INLINE V ofQueries(const FewBlocks& blocks, std::size_t lane, const Number& number) {
  return ofBlocks(lane, [&](std::size_t which, std::size_t, auto floats)
                            HWY_ATTR { return hn::Set(floats, number(blocks.query[which])); });
}

HWY_INLINE V3 ofQueries(const FewBlocks& blocks, std::size_t lane, float (BlockQuery::*vector)[3]) {
  const auto part = [&](int axis) HWY_ATTR {
    return ofQueries(blocks, lane, [&](const BlockQuery& query) { return (query.*vector)[axis]; });
  };
  return {part(0), part(1), part(2)};
}

HWY_INLINE V reachOf(const FewBlocks& blocks, std::size_t lane) {
  return ofQueries(blocks, lane, [](const BlockQuery& query) { return query.reach; });
}

// The primitives of some lanes, with the terms of their nearest points that do not depend on the eye (the sphere's
// centre).
struct Corners {
  V3 a, b, c, ab, ac, normal;
  V ab2, ac2, bc2, ab_ac;
  V per_ab2, per_ac2, per_bc2;
};

// The reciprocal of a squared length. If the length is 0, as for a point, it is only multiplied by 0.
HWY_INLINE V perSquare(V length2) {
  return hn::Div(hn::Set(kFloats, 1.0f), hn::Max(length2, hn::Set(kFloats, 1e-30f)));
}

HWY_INLINE Corners cornersOf(const FewBlocks& blocks, std::size_t lane) {
  const auto corner = [&](std::size_t i) HWY_ATTR {
    return V3{coordinate(blocks, lane, i, 0), coordinate(blocks, lane, i, 1), coordinate(blocks, lane, i, 2)};
  };
  const V3 a = corner(0), b = corner(1), c = corner(2), ab = b - a, ac = c - a;
  const V ab2 = dot(ab, ab), ac2 = dot(ac, ac), ab_ac = dot(ab, ac);
  const V bc2 = hn::Sub(hn::Add(ab2, ac2), hn::Add(ab_ac, ab_ac));
  return {a, b, c, ab, ac, cross(ab, ac), ab2, ac2, bc2, ab_ac, perSquare(ab2), perSquare(ac2), perSquare(bc2)};
}

// Weights of a point a + v ab + w ac.
struct Weights {
  V v, w;
};

// The point on an edge nearest to the eye, as a fraction of the edge, and its squared distance.
struct OnEdge {
  V s, distance2;
};

// For an edge of squared length length2, from a vertex at squared distance distance2; `along`: the dot product of the
// edge and the vector from the vertex to the eye.
HWY_INLINE OnEdge onEdge(V distance2, V along, V length2, V per_length2) {
  const V s = hn::Min(hn::Max(hn::Mul(along, per_length2), hn::Zero(kFloats)), hn::Set(kFloats, 1.0f));
  const V twice = hn::Sub(hn::Add(along, along), hn::Mul(s, length2));
  return {s, hn::Sub(distance2, hn::Mul(s, twice))};
}

HWY_INLINE Weights nearestOnEdges(const Corners& p, V distance2, V along_ab, V along_ac) {
  const V zero = hn::Zero(kFloats);
  const OnEdge ab = onEdge(distance2, along_ab, p.ab2, p.per_ab2);
  const OnEdge ac = onEdge(distance2, along_ac, p.ac2, p.per_ac2);
  const V b_distance2 = hn::Add(hn::Sub(distance2, hn::Add(along_ab, along_ab)), p.ab2);
  const V along_bc = hn::Add(hn::Sub(along_ac, along_ab), hn::Sub(p.ab2, p.ab_ac));
  const OnEdge bc = onEdge(b_distance2, along_bc, p.bc2, p.per_bc2);
  const Mask by_ac = hn::Lt(ac.distance2, ab.distance2);
  const Mask by_bc = hn::Lt(bc.distance2, hn::Min(ab.distance2, ac.distance2));
  const V v = hn::IfThenElse(by_ac, zero, ab.s);
  const V w = hn::IfThenElse(by_ac, ac.s, zero);
  return {hn::IfThenElse(by_bc, hn::Sub(hn::Set(kFloats, 1.0f), bc.s), v), hn::IfThenElse(by_bc, bc.s, w)};
}

// A vector of any length from the eye toward the nearest point of the primitive; `a` is the vector from the eye to the
// first vertex. The result may be inaccurate: any direction gives a valid bound, see Plane.
HWY_INLINE V3 towards(const Corners& p, const V3& a) {
  const V zero = hn::Zero(kFloats);
  const V along_ab = hn::Neg(dot(a, p.ab));
  const V along_ac = hn::Neg(dot(a, p.ac));
  const Weights edge = nearestOnEdges(p, dot(a, a), along_ab, along_ac);
  const V3 on_edge = sum(a, sum(scaled(p.ab, edge.v), scaled(p.ac, edge.w)));
  // Inside the face the weights, times the determinant, are positive, and their sum is less than the determinant.
  const V v = hn::Sub(hn::Mul(p.ac2, along_ab), hn::Mul(p.ab_ac, along_ac));
  const V w = hn::Sub(hn::Mul(p.ab2, along_ac), hn::Mul(p.ab_ac, along_ab));
  const V determinant = hn::Sub(hn::Mul(p.ab2, p.ac2), hn::Mul(p.ab_ac, p.ab_ac));
  const Mask inside = hn::And(hn::Gt(hn::Min(v, w), zero), hn::Lt(hn::Add(v, w), determinant));
  const V side = hn::CopySign(hn::Set(kFloats, 1.0f), dot(a, p.normal));
  return choose(inside, scaled(p.normal, side), on_edge);
}

// A separating plane: with n = `toward`, the primitive lies at n . x >= nearest and the sphere about the eye at n . x
// <= edge. Any n with nearest > edge proves that they are disjoint; the n toward the nearest point gives the best
// bound.
struct Plane {
  V nearest, edge;
};

HWY_INLINE Plane planeAlong(const V3& toward, const Corners& p, const V3& eye, V reach) {
  const V nearest = hn::Min(hn::Min(dot(toward, p.a - eye), dot(toward, p.b - eye)), dot(toward, p.c - eye));
  return {nearest, hn::Mul(reach, hn::Sqrt(dot(toward, toward)))};
}

// Bits of the primitives that may be within reach.
HWY_INLINE unsigned withinReach(const FewBlocks& blocks) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < blocks.lanes(); lane += kLanes) {
    const Corners corners = cornersOf(blocks, lane);
    const V3 eye = ofQueries(blocks, lane, &BlockQuery::from);
    const Plane plane = planeAlong(towards(corners, corners.a - eye), corners, eye, reachOf(blocks, lane));
    bits |= (bitsOf(hn::Gt(plane.nearest, plane.edge)) ^ kAllLanes) << lane;
  }
  return bits;
}

// Conservative advancement (Mirtich 1996) of the sphere toward the primitives of one vector: there is no contact before
// the sphere crosses a separating plane, and at that point a new plane gives a better bound.
class Advance {
 public:
  HWY_INLINE Advance(const FewBlocks& blocks, std::size_t lane)
      : corners_(cornersOf(blocks, lane)),
        from_(ofQueries(blocks, lane, &BlockQuery::from)),
        motion_(ofQueries(blocks, lane, &BlockQuery::motion)),
        reach_(reachOf(blocks, lane)),
        time_(hn::Zero(kFloats)) {}

  // Returns whether another step can change the result before `latest`.
  HWY_INLINE bool step(V latest) {
    const V3 eye = sum(from_, scaled(motion_, time_));
    const V3 toward = towards(corners_, corners_.a - eye);
    const Plane plane = planeAlong(toward, corners_, eye, reach_);
    const V closing = dot(toward, motion_);
    const V never = hn::Set(kFloats, 2.0f);
    const V later = hn::Add(time_, hn::Div(hn::Sub(plane.nearest, plane.edge), closing));
    const V crossed = hn::IfThenElse(hn::Gt(closing, hn::Zero(kFloats)), later, never);
    const Mask apart = hn::Gt(plane.nearest, plane.edge);
    time_ = hn::IfThenElse(apart, crossed, time_);
    return !hn::AllFalse(kFloats, hn::And(apart, hn::Le(time_, latest)));
  }

  // Bits of the primitives that may be touched up to `latest`, and lower bounds of their times.
  HWY_INLINE unsigned touched(V latest, float* entry) const {
    hn::Store(time_, kFloats, entry);
    return bitsOf(hn::Gt(time_, latest)) ^ kAllLanes;  // all that are not certainly later, including NaN
  }

 private:
  const Corners corners_;
  const V3 from_, motion_;
  const V reach_;
  V time_;
};

// Interleaves several vectors, as each step depends on the previous one: one vector alone would leave the processor
// idle.
template <typename... Advances>
HWY_INLINE void advance(V latest, Advances&... all) {
  constexpr int kSteps = 3;
  for (int i = 0; i < kSteps; ++i) {
    if ((... | unsigned{all.step(latest)}) == 0) return;  // no ||, so that all of them make a step
  }
}

// Bits of the primitives that may be touched up to the limit, and lower bounds of their times.
HWY_INLINE unsigned touched(const FewBlocks& blocks, float limit, float* entry) {
  const V latest = hn::Set(kFloats, limit);
  unsigned bits = 0;
  std::size_t lane = 0;
  for (; lane + kLanes < blocks.lanes(); lane += 2 * kLanes) {
    Advance one(blocks, lane), other(blocks, lane + kLanes);
    advance(latest, one, other);
    bits |= one.touched(latest, entry + lane) << lane;
    bits |= other.touched(latest, entry + lane + kLanes) << (lane + kLanes);
  }
  if (lane < blocks.lanes()) {
    Advance last(blocks, lane);
    advance(latest, last);
    bits |= last.touched(latest, entry + lane) << lane;
  }
  return bits;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hl
HWY_AFTER_NAMESPACE();

#endif  // HL_GEOMETRY_WIDE_BVH_BLOCK_INL_H

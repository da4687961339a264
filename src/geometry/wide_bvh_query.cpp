// Compiled once for each instruction set (foreach_target includes this file again). Multiplications and additions stay
// apart, never fused, so that all sets round alike.
#include "geometry/wide_bvh_query.h"

// Their vectors have no size at compile time, so they cannot be members.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// The scalar code too, everywhere, so that it is tested everywhere.
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/wide_bvh_query.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/wide_bvh_block-inl.h"
#include "geometry/wide_bvh_float_query.h"

HWY_BEFORE_NAMESPACE();
namespace hl {
namespace HWY_NAMESPACE {
namespace {

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

  // All children that are entered come from memory at once, not one after the other: of ten million triangles' few are
  // in a cache.
  HWY_INLINE void prefetch(std::uint32_t link) const {
    if ((link & kBlockLink) != 0) {
      prefetch(tree_.blocks[link & ~kBlockLink]);
    } else {
      prefetch(tree_.nodes[link]);
    }
  }

  template <typename Part>
  static HWY_INLINE void prefetch(const Part& part) {
    constexpr std::size_t kCacheLine = 64;
    const auto* bytes = reinterpret_cast<const std::byte*>(&part);
    for (std::size_t at = 0; at < sizeof(Part); at += kCacheLine) hwy::Prefetch(bytes + at);
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
      prefetch(node.child[lane]);
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
      if (wasProposed(block.primitive[lane])) continue;
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
      if (proposed_count_ < kMostCandidates) proposed_[proposed_count_++] = candidates_[i].link;
    }
    candidate_count_ = 0;
  }

  // By an earlier walk. When it was entered would not tell: the box of its block may have been entered later, and then
  // no walk has looked at it. One that did not fit in is proposed again, which does no harm.
  HWY_INLINE bool wasProposed(std::uint32_t primitive) const {
    const std::uint32_t* end = proposed_ + proposed_count_;
    return std::find(proposed_, end, primitive) != end;
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
  double part_ = 0;  // the limit that the walk began with; 0: no block met yet
  std::size_t candidate_count_ = 0;
  Waiting candidates_[kMostCandidates];
  std::size_t proposed_count_ = 0;
  std::uint32_t proposed_[kMostCandidates];
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

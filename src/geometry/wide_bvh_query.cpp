// Compiled once for each instruction set (foreach_target includes this file again). Multiplications and additions are
// never fused, so that all instruction sets round alike.
#include "geometry/wide_bvh_query.h"

#include <algorithm>
#include <iterator>
#include <utility>

// Vectors of these sets have no size at compile time, so they cannot be members.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// Also compiles the scalar code on every machine, so that it is tested.
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/wide_bvh_query.cpp"
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

// Numbers of blocks that are tested together.
struct FewNumbers {
  std::uint32_t block[kFewBlocks];
  std::size_t count;
};

HWY_INLINE unsigned usedLanes(const WideTree& tree, const FewNumbers& numbers) {
  unsigned used = 0;
  for (std::size_t i = 0; i < numbers.count; ++i) used |= usedLanes(tree, numbers.block[i]) << (i * kWide);
  return used;
}

HWY_INLINE void setBlocks(FewBlocks& blocks, const WideTree& tree, const WideQuery& query, const FewNumbers& numbers) {
  blocks.count = numbers.count;
  for (std::size_t i = 0; i < numbers.count; ++i) {
    blocks.block[i] = &tree.blocks[numbers.block[i]];
    blocks.query[i] = blockQuery(*blocks.block[i], query);
  }
  if (numbers.count % 2 == 0) return;
  blocks.block[numbers.count] = blocks.block[numbers.count - 1];
  blocks.query[numbers.count] = blocks.query[numbers.count - 1];
}

// The boxes of a node.
using Boxes = hn::CappedTag<float, kWide>;
constexpr Boxes kBoxes;
constexpr std::size_t kBoxLanes = hn::MaxLanes(kBoxes);

// By axis of a node's frame; the fourth is unused.
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

// Bounds of the way up to the limit, in the frame of a node or of the hierarchy.
struct Way {
  HWY_ALIGN float min[4], max[4];
};

HWY_INLINE void setEnd(Way& way, std::size_t lane, PerAxis from, PerAxis motion, float limit) {
  const PerAxis end = hn::Add(from, hn::Mul(motion, hn::Set(kAxes, limit)));
  hn::Store(hn::Min(from, end), kAxes, way.min + lane);
  hn::Store(hn::Max(from, end), kAxes, way.max + lane);
}

HWY_INLINE void setEnd(Way& way, const BoxQuery& query) {
  for (std::size_t lane = 0; lane < 4; lane += kAxisLanes)
    setEnd(way, lane, hn::Load(kAxes, query.from + lane), hn::Load(kAxes, query.motion + lane), query.limit);
}

HWY_INLINE void turn(Way& way, const BoxQuery& query, const WideNode& node) {
  for (std::size_t lane = 0; lane < 4; lane += kAxisLanes)
    setEnd(way, lane, framed(node, lane, query.from), framed(node, lane, query.motion), query.limit);
}

// Squared distance between the bounds of the way and the boxes from `lane` on.
HWY_INLINE hn::Vec<Boxes> distance2(const WideNode& node, std::size_t lane, const Way& way) {
  auto sum2 = hn::Zero(kBoxes);
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = hn::Load(kBoxes, node.bound[0][axis] + lane);
    const auto high = hn::Load(kBoxes, node.bound[1][axis] + lane);
    const auto above = hn::Sub(low, hn::Set(kBoxes, way.max[axis]));
    const auto below = hn::Sub(hn::Set(kBoxes, way.min[axis]), high);
    const auto apart = hn::Max(hn::Max(above, below), hn::Zero(kBoxes));
    sum2 = hn::Add(sum2, hn::Mul(apart, apart));
  }
  return sum2;
}

// The positions of the set bits of each number, the lowest first.
struct SetBits {
  std::uint8_t of[1 << kBoxLanes][kWide] = {};

  constexpr SetBits() {
    for (std::size_t bits = 0; bits < std::size(of); ++bits) {
      std::size_t count = 0;
      for (std::uint8_t bit = 0; bit < kBoxLanes; ++bit) {
        if ((bits >> bit & 1) != 0) of[bits][count++] = bit;
      }
    }
  }
};
constexpr SetBits kSetBits;

// Appends the links of the children that the sphere may enter to a list of `count` links; returns the new length. It
// writes a whole vector, whose elements beyond the new length are meaningless. (On processors without a compress
// instruction Highway's Compress uses a table, which GCC copies to the stack each time: a kilobyte per node.)
HWY_INLINE std::size_t addOverlapped(const WideNode& node, const BoxQuery& query, const Way& way, std::uint32_t* links,
                                     std::size_t count) {
  const hn::RebindToUnsigned<Boxes> whole;
  const hn::Rebind<std::uint8_t, Boxes> bytes;
  for (std::size_t lane = 0; lane < kWide; lane += kBoxLanes) {
    std::uint8_t in[8] = {};
    hn::StoreMaskBits(kBoxes, hn::Le(distance2(node, lane, way), hn::Set(kBoxes, query.reach2)), in);
    const auto order = hn::PromoteTo(whole, hn::LoadU(bytes, kSetBits.of[in[0]]));
    const auto links_in = hn::TableLookupLanes(hn::Load(whole, node.child + lane), hn::IndicesFromVec(whole, order));
    hn::StoreU(links_in, whole, links + count);
    count += hwy::PopCount(in[0]);
  }
  return count;
}

HWY_INLINE std::size_t takeLowest(unsigned& bits) {
  const auto lane = static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
  bits &= bits - 1;
  return lane;
}

// Calls look() for all blocks whose boxes the sphere may enter up to the limit, a few at a time; look() may reduce the
// limit. The waiting nodes form a queue (first in, first out): the next node then does not depend on the result of the
// last test, and the processor can work on both at once. If too many wait, the last one is taken, as in a depth-first
// traversal, which keeps few waiting. Returns the number of boxes and triangles visited.
template <typename Look>
HWY_INLINE std::size_t forEachFew(const WideTree& tree, const BoxQuery& query, const Look& look) {
  constexpr std::size_t kMaxWaiting = 256;
  std::uint32_t links[kMaxWaiting + kWide + kWideStackSize];
  std::size_t first = 0, end = 0, looked = 0;
  links[end++] = tree.root;
  FewNumbers numbers{{}, 0};
  Way straight, turned;
  setEnd(straight, query);
  while (first < end) {
    looked += kWide;
    const std::uint32_t link = end <= kMaxWaiting ? links[first++] : links[--end];
    if (isBlock(link)) {
      numbers.block[numbers.count++] = link & ~kBlockLink;
      if (numbers.count == kFewBlocks) {
        look(numbers);
        numbers.count = 0;
      }
      continue;
    }
    const WideNode& node = tree.nodes[link];
    if (node.turned != 0) turn(turned, query, node);
    end = addOverlapped(node, query, node.turned != 0 ? turned : straight, links, end);
  }
  if (numbers.count > 0) look(numbers);
  return looked;
}

// When it stops, no other box is near enough.
std::size_t overlap(const WideTree& tree, const WideQuery& query, FunctionRef<bool(ElementId)> stop) {
  BoxQuery box = boxQuery(tree, query);
  return forEachFew(tree, box, [&](const FewNumbers& numbers) HWY_ATTR {
    if (box.reach2 < 0) return;
    FewBlocks blocks;
    setBlocks(blocks, tree, query, numbers);
    unsigned bits = withinReach(blocks) & usedLanes(tree, numbers);
    while (bits != 0 && box.reach2 >= 0) box.reach2 = stop(blocks.primitive(takeLowest(bits))) ? -1 : box.reach2;
  });
}

// Searches a first part of the way, and larger parts only if nothing is hit: goals are far away, and most ways end
// soon.
class Sweep {
 public:
  HWY_INLINE Sweep(const WideTree& tree, const WideQuery& query, FunctionRef<double(ElementId, double)> visit)
      : tree_(tree), query_(query), visit_(visit), box_(boxQuery(tree, query)) {}

  std::size_t run(double first_part) {
    std::size_t looked = 0;
    constexpr double kLarger = 8;
    for (double part = first_part;; part = std::min(1.0, kLarger * part)) {
      shorten(std::min(part, soonest_));
      proposed_before_ = proposed_count_;
      looked += forEachFew(tree_, box_, [this](const FewNumbers& numbers) HWY_ATTR { look(numbers); });
      propose();
      if (soonest_ <= part || part >= 1) return looked;
    }
  }

 private:
  // `entry` is a lower bound of the time at which it is touched.
  struct Candidate {
    std::uint32_t primitive;
    float entry;
  };

  HWY_INLINE void shorten(double limit) {
    limit_ = limit;
    setLimit(box_, limit);
  }

  HWY_INLINE void look(const FewNumbers& numbers) {
    FewBlocks blocks;
    setBlocks(blocks, tree_, query_, numbers);
    HWY_ALIGN float entry[kFewLanes];
    unsigned bits = touched(blocks, box_.limit, entry) & usedLanes(tree_, numbers);
    while (bits != 0) {
      const std::size_t lane = takeLowest(bits);
      const std::uint32_t primitive = blocks.primitive(lane);
      if (wasProposed(primitive)) continue;
      candidates_[candidate_count_++] = {primitive, entry[lane]};
      if (candidate_count_ == kMaxCandidates) proposeMany();
    }
  }

  // Proposes the earliest candidate first, as an impact removes all later candidates. So candidates wait until the
  // traversal ends or there are too many. Most are removed, so they are not sorted.
  HWY_INLINE void propose() {
    for (; candidate_count_ > 0; --candidate_count_) {
      Candidate* const end = candidates_ + candidate_count_;
      Candidate* earliest = candidates_;
      for (Candidate* one = candidates_ + 1; one < end; ++one) earliest = one->entry < earliest->entry ? one : earliest;
      if (earliest->entry > box_.limit) break;
      propose(earliest->primitive);
      *earliest = end[-1];
    }
    candidate_count_ = 0;
  }

  // Proposes the earliest first. If it removes fewer than half of the others, very many primitives are touched, and
  // choosing takes longer than it saves: then all are proposed in sequence.
  void proposeMany() {
    const auto sooner = [](const Candidate& a, const Candidate& b) { return a.entry < b.entry; };
    Candidate* end = candidates_ + candidate_count_;
    Candidate* const earliest = std::min_element(candidates_, end, sooner);
    const std::uint32_t primitive = earliest->primitive;
    *earliest = *--end;
    propose(primitive);
    end = std::remove_if(candidates_, end, [this](const Candidate& one) { return one.entry > box_.limit; });
    candidate_count_ = static_cast<std::size_t>(end - candidates_);
    if (candidate_count_ <= kMaxCandidates / 2) return;
    for (const Candidate* one = candidates_; one < end; ++one) {
      if (one->entry <= box_.limit) propose(one->primitive);
    }
    candidate_count_ = 0;
  }

  HWY_INLINE void propose(std::uint32_t primitive) {
    soonest_ = std::min(soonest_, visit_(primitive, soonest_));
    if (soonest_ < limit_) shorten(soonest_);
    if (proposed_count_ < kMaxCandidates) proposed_[proposed_count_++] = primitive;
  }

  // Whether an earlier traversal proposed it. The time at which it was entered does not show this: the box of its block
  // may have been entered later, and then no traversal has tested it. A candidate that did not fit into the list is
  // proposed again, which does no harm.
  HWY_INLINE bool wasProposed(std::uint32_t primitive) const {
    const std::uint32_t* end = proposed_ + proposed_before_;
    return std::find(proposed_, end, primitive) != end;
  }

  static constexpr std::size_t kMaxCandidates = 48;

  const WideTree& tree_;
  const WideQuery& query_;
  FunctionRef<double(ElementId, double)> visit_;
  BoxQuery box_;
  double limit_ = 1;    // limit of the part that is searched
  double soonest_ = 1;  // earliest impact; by rounding it may be a little beyond the part in which it is proposed
  std::size_t candidate_count_ = 0;
  Candidate candidates_[kMaxCandidates];
  std::size_t proposed_count_ = 0, proposed_before_ = 0;  // in total; by earlier traversals
  std::uint32_t proposed_[kMaxCandidates];
};

}  // namespace

std::size_t overlapFor(const WideTree& tree, const WideQuery& query, FunctionRef<bool(ElementId)> stop) {
  return overlap(tree, query, stop);
}
std::size_t sweepFor(const WideTree& tree, const WideQuery& query, double first_part,
                     FunctionRef<double(ElementId, double)> visit) {
  return Sweep(tree, query, visit).run(first_part);
}

}  // namespace HWY_NAMESPACE
}  // namespace hl
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hl {

HWY_EXPORT(overlapFor);
HWY_EXPORT(sweepFor);

std::size_t overlapWide(const WideTree& tree, const WideQuery& query, FunctionRef<bool(ElementId)> stop) {
  return HWY_DYNAMIC_DISPATCH(overlapFor)(tree, query, stop);
}

std::size_t sweepWide(const WideTree& tree, const WideQuery& query, double first_part,
                      FunctionRef<double(ElementId, double)> visit) {
  return HWY_DYNAMIC_DISPATCH(sweepFor)(tree, query, first_part, visit);
}

}  // namespace hl
#endif  // HWY_ONCE

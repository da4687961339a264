// RecentPrimitives: a cache of the primitives read last. A tick reads the same few in each sweep and at its end, and
// the next tick usually reads them again.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>

#include "geometry/primitive.h"
#include "scene/primitive_id.h"

namespace hl {

/// For one thread; RT-safe. The capacity is that of one of the two types below.
class RecentPrimitives {
 public:
  RecentPrimitives(const RecentPrimitives&) = delete;
  RecentPrimitives& operator=(const RecentPrimitives&) = delete;

  /// The following reads are from the snapshot with this identity, at this time. Clears the cache if either has
  /// changed.
  void readFrom(std::uint64_t snapshot, std::int64_t moment) {
    if (snapshot_ != snapshot || moment_ != moment) forget();
    snapshot_ = snapshot;
    moment_ = moment;
  }

  /// Returns the primitive; calls read() if it is not in the cache. The reference is valid until the next call.
  template <typename Read>
  const Primitive& get(PrimitiveId id, const Read& read) {
    const std::size_t slot = (id.element * kSpread + id.instance * kStride) >> shift_;
    if (of_[slot] != id) {
      std::construct_at(&slots_[slot].primitive, read());
      of_[slot] = id;
    }
    return slots_[slot].primitive;
  }

 protected:
  // Uninitialised until it is read: clearing all slots would cost as much as reading some primitives.
  union Slot {
    Slot() {}  // NOLINT: = default would be deleted by the union
    Primitive primitive;
  };
  static constexpr PrimitiveId kNone{0xffffffff, ~ElementId{0}};

  RecentPrimitives() = default;
  ~RecentPrimitives() = default;
  void use(PrimitiveId* of, Slot* slots, std::size_t count) {
    of_ = of;
    slots_ = slots;
    count_ = count;
    shift_ = 64 - std::countr_zero(count);
    forget();
  }
  void forget() { std::fill(of_, of_ + count_, kNone); }

 private:
  // 2^64 divided by the golden ratio: neighbours get slots far from each other (D. Knuth, The Art of Computer
  // Programming, 6.4). Numbers of elements have gaps: cells of a grid have room for more triangles than there are.
  static constexpr ElementId kSpread = 0x9e3779b97f4a7c15;
  static constexpr ElementId kStride = 0xd1b54a32d192ed03;  // the same element of other instances gets another slot

  PrimitiveId* of_ = nullptr;
  Slot* slots_ = nullptr;
  std::size_t count_ = 0;
  int shift_ = 0;
  std::uint64_t snapshot_ = 0;  // 0: no snapshot has this identity
  std::int64_t moment_ = 0;
};

/// `kSlots`: a power of two.
template <std::size_t kSlots>
class RecentPrimitivesOf final : public RecentPrimitives {
 public:
  // If the cache takes several pages, all are written once here, so that no tick causes a page fault.
  RecentPrimitivesOf() {
    constexpr std::size_t kPage = 4096;
    if constexpr (sizeof(primitives_) > kPage)
      std::memset(static_cast<void*>(primitives_.data()), 0, sizeof(primitives_));
    use(ids_.data(), primitives_.data(), kSlots);
  }

 private:
  std::array<PrimitiveId, kSlots> ids_;
  std::array<Slot, kSlots> primitives_;
};

/// For one query or a few: a tick usually reads fewer primitives.
using FewRecentPrimitives = RecentPrimitivesOf<32>;
/// For many ticks. Where a thousand primitives meet, each query of a tick reads all of them.
using ManyRecentPrimitives = RecentPrimitivesOf<1024>;

}  // namespace hl

// RecentPrimitives: the primitives read last. A tick reads the same few in each of its sweeps, and where they end; so,
// mostly, does the next tick.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>

#include "geometry/primitive.h"
#include "scene/primitive_id.h"

namespace hl {

/// For one thread; RT-safe. Its room is that of one of the two below.
class RecentPrimitives {
 public:
  RecentPrimitives(const RecentPrimitives&) = delete;
  RecentPrimitives& operator=(const RecentPrimitives&) = delete;

  /// What follows is of the snapshot of this identity, at this moment: forgets what is here of another one.
  void readFrom(std::uint64_t snapshot, std::int64_t moment) {
    if (snapshot_ != snapshot || moment_ != moment) forget();
    snapshot_ = snapshot;
    moment_ = moment;
  }

  /// read() gives the primitive when it is not here. The reference is good until the next call.
  template <typename Read>
  const Primitive& get(PrimitiveId id, const Read& read) {
    const std::size_t slot = (id.element + kStride * id.instance) & last_;
    if (of_[slot] != id) {
      std::construct_at(&slots_[slot].primitive, read());
      of_[slot] = id;
    }
    return slots_[slot].primitive;
  }

 protected:
  // Left uninitialised until it is read: clearing all of them would cost as much as reading some.
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
    last_ = count - 1;
    forget();
  }
  void forget() { std::fill(of_, of_ + last_ + 1, kNone); }

 private:
  static constexpr ElementId kStride = 11;  // sends the same element of neighbouring instances to other slots

  PrimitiveId* of_ = nullptr;
  Slot* slots_ = nullptr;
  std::size_t last_ = 0;
  std::uint64_t snapshot_ = 0;  // none has this
  std::int64_t moment_ = 0;
};

/// `kSlots`: a power of two.
template <std::size_t kSlots>
class RecentPrimitivesOf final : public RecentPrimitives {
 public:
  // Where it takes several pages all are written once, so that no tick is the first to touch one.
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

/// For one question or a few: mostly a tick reads fewer.
using FewRecentPrimitives = RecentPrimitivesOf<32>;
/// For tick after tick: where a thousand primitives meet, each of its questions reads all of them.
using ManyRecentPrimitives = RecentPrimitivesOf<1024>;

}  // namespace hl

// RecentPrimitives: the primitives read last. A tick reads the same few in each of its sweeps, and where they end; so,
// mostly, does the next tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "geometry/primitive.h"

namespace hl {

/// A primitive of one instance of a snapshot.
struct PrimitiveId {
  std::uint32_t instance = 0;
  std::uint32_t element = 0;  ///< index into its shape's primitives
  bool operator==(const PrimitiveId&) const = default;
};

/// For one thread; RT-safe.
class RecentPrimitives {
 public:
  RecentPrimitives() { of_.fill(kNone); }

  /// What follows is of the snapshot of this identity, at this moment: forgets what is here of another one.
  void readFrom(std::uint64_t snapshot, std::int64_t moment) {
    if (snapshot_ != snapshot || moment_ != moment) of_.fill(kNone);
    snapshot_ = snapshot;
    moment_ = moment;
  }

  /// read() gives the primitive when it is not here. The reference is good until the next call.
  template <typename Read>
  const Primitive& get(PrimitiveId id, const Read& read) {
    const std::size_t slot = (id.element + kStride * id.instance) % kSlots;
    if (of_[slot] != id) {
      std::construct_at(&slots_[slot].primitive, read());
      of_[slot] = id;
    }
    return slots_[slot].primitive;
  }

 private:
  static constexpr std::size_t kSlots = 32;
  static constexpr std::uint32_t kStride = 11;  // sends the same element of neighbouring instances to other slots
  static constexpr PrimitiveId kNone{0xffffffff, 0xffffffff};

  // Left uninitialised until it is read: clearing all of them would cost as much as reading some.
  union Slot {
    Slot() {}  // NOLINT: = default would be deleted by the union
    Primitive primitive;
  };
  std::uint64_t snapshot_ = 0;  // none has this
  std::int64_t moment_ = 0;
  std::array<PrimitiveId, kSlots> of_;
  std::array<Slot, kSlots> slots_;
};

}  // namespace hl

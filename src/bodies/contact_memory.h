// Contact memory: the impulses of the last step and where they acted, from which the next step begins (warm start). A
// contact is known again by its place, not by the features that meet there: a block that slides over the seams of a
// mesh, or stands flush on another, changes them in each step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "base/vec.h"
#include "bodies/permute.h"

namespace hl {

/// Keys of the two that touch; b is 0 for the fixed scene.
struct ContactPair {
  std::uint64_t a = 0, b = 0;
  auto operator<=>(const ContactPair&) const = default;
};

struct RememberedContact {
  ContactPair pair;
  Vec3 place = Vec3::Zero();    ///< m, in the frame of a; of a hand: relative to the proxy
  double pressed = 0;           ///< N s, along the normal
  Vec3 dragged = Vec3::Zero();  ///< N s, across it, world
  bool slipped = false;
  bool taken = false;  ///< a row of this step begins from it
};

/// Sorted by pair.
class ContactMemory {
 public:
  ContactMemory() = default;
  // A copy has the same room.
  ContactMemory(const ContactMemory& other) { *this = other; }
  ContactMemory& operator=(const ContactMemory& other) {
    reserve(other.contacts_.capacity());
    contacts_ = other.contacts_;
    return *this;
  }
  void reserve(std::size_t contacts) {
    contacts_.reserve(contacts);
    order_.reserve(contacts_.capacity());
  }
  /// The one nearest to `place` within `near` (m) that is not taken; null: none. RT-safe.
  RememberedContact* find(const ContactPair& pair, const Vec3& place, double near) {
    auto at = std::lower_bound(contacts_.begin(), contacts_.end(), pair,
                               [](const RememberedContact& one, const ContactPair& p) { return one.pair < p; });
    RememberedContact* best = nullptr;
    double least = near * near;
    for (; at != contacts_.end() && at->pair == pair; ++at) {
      const double square = (at->place - place).squaredNorm();
      if (at->taken || square > least) continue;
      least = square;
      best = &*at;
    }
    return best;
  }
  /// RT-safe within the reserved room.
  void copyFrom(const ContactMemory& other) {
    contacts_.clear();
    for (const RememberedContact& contact : other.contacts_) add(contact);
  }
  void clear() { contacts_.clear(); }
  std::span<const RememberedContact> all() const { return contacts_; }
  std::size_t room() const { return contacts_.capacity(); }
  /// RT-safe within the reserved room; beyond it the contact is forgotten.
  void add(const RememberedContact& contact) {
    if (contacts_.size() < contacts_.capacity()) contacts_.push_back(contact);
  }
  /// No row of a step has begun from any of them. RT-safe.
  void release() {
    for (RememberedContact& contact : contacts_) contact.taken = false;
  }
  /// Those for which `belongs` is true go to `other`, behind its own of the same pair, as far as there is room.
  /// RT-safe.
  template <typename Belongs>
  void moveTo(ContactMemory& other, Belongs belongs) {
    std::size_t kept = 0;
    order_.clear();  // of those that go
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (belongs(contacts_[i])) order_.push_back(static_cast<std::uint32_t>(i));
    }
    other.merge(contacts_, order_);
    std::size_t gone = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (gone < order_.size() && order_[gone] == i)
        ++gone;
      else
        contacts_[kept++] = contacts_[i];
    }
    contacts_.resize(kept);
  }
  /// After the last add(). Contacts of one pair keep their order. RT-safe.
  void sort() {
    const auto before = [](const RememberedContact& x, const RememberedContact& y) { return x.pair < y.pair; };
    if (std::is_sorted(contacts_.begin(), contacts_.end(), before)) return;
    order_.resize(contacts_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t x, std::uint32_t y) {
      return std::tie(contacts_[x].pair, x) < std::tie(contacts_[y].pair, y);
    });
    permute(contacts_.data(), contacts_.size(), [&](std::size_t i) -> std::uint32_t& { return order_[i]; });
  }

 private:
  // Both lists are sorted: what is last is put in its place first, so that nothing is overwritten that is still needed.
  void merge(const std::vector<RememberedContact>& from, std::span<const std::uint32_t> numbers) {
    std::size_t own = contacts_.size(), coming = std::min(numbers.size(), contacts_.capacity() - own);
    contacts_.resize(own + coming);
    for (std::size_t at = contacts_.size(); coming > 0; --at) {
      const RememberedContact& last = from[numbers[coming - 1]];
      const bool is_last = own == 0 || !(last.pair < contacts_[own - 1].pair);
      contacts_[at - 1] = is_last ? last : contacts_[own - 1];
      --(is_last ? coming : own);
    }
  }

  std::vector<RememberedContact> contacts_;
  std::vector<std::uint32_t> order_;  // room for numbers of contacts_
};

}  // namespace hl

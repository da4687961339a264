// Contact memory: the impulses of the last step and where they acted, from which the next step begins (warm start). A
// contact is known again by its place, not by the features that meet there: a block that slides over the seams of a
// mesh, or stands flush on another, changes them in each step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/vec.h"

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
    contacts_.reserve(other.contacts_.capacity());
    contacts_ = other.contacts_;
    return *this;
  }
  void reserve(std::size_t contacts) { contacts_.reserve(contacts); }
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
  /// Those for which `belongs` is true go to `other`. RT-safe.
  template <typename Belongs>
  void moveTo(ContactMemory& other, Belongs belongs) {
    std::size_t kept = 0;
    for (const RememberedContact& contact : contacts_) {
      if (belongs(contact))
        other.add(contact);
      else
        contacts_[kept++] = contact;
    }
    contacts_.resize(kept);
    other.sort();
  }
  /// After the last add(). Contacts of one pair keep their order. RT-safe.
  void sort() {
    for (std::size_t i = 1; i < contacts_.size(); ++i) {
      for (std::size_t j = i; j > 0 && contacts_[j].pair < contacts_[j - 1].pair; --j)
        std::swap(contacts_[j], contacts_[j - 1]);
    }
  }

 private:
  std::vector<RememberedContact> contacts_;
};

}  // namespace hl

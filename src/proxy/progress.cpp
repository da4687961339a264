#include "proxy/progress.h"

#include <algorithm>

#include "proxy/tolerances.h"

namespace hl {

bool Progress::idleAt(const Vec3& position, const Goal& goal) {
  const bool gains = !nearest_ || goal.nearer(position, *nearest_);
  idle_ = gains ? 0 : idle_ + 1;
  if (gains) nearest_ = position;
  return idle_ >= convergence::kMaxIdle;
}

// The plane of a face does not change when the proxy moves. The planes of edges and vertices turn, so they do not
// settle.
void Progress::settleOn(const ContactSet& set) {
  for (const Contact& contact : set.contacts) {
    if (contact.feature != Feature::kFace) return settled_on_.clear();
    settled_on_.push(contact.primitive);
  }
}

bool Progress::sameFaces(const ContactSet& set) const {
  const auto same = [](PrimitiveId primitive, const Contact& contact) {
    return contact.feature == Feature::kFace && contact.primitive == primitive;
  };
  return std::equal(settled_on_.begin(), settled_on_.end(), set.contacts.begin(), set.contacts.end(), same);
}

}  // namespace hl

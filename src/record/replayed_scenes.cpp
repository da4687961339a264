#include "record/replayed_scenes.h"

#include <algorithm>

namespace hl {

void ReplayedScenes::readOn() {
  if (!read_on_()) throw Error("the recording lacks a scene that it touches");
}

bool ReplayedScenes::hasBodies(std::uint64_t identity) {
  for (;; readOn()) {
    const auto known = has_bodies_.find(identity);
    if (known != has_bodies_.end()) return known->second;
  }
}

std::uint64_t ReplayedScenes::placeOf(std::uint64_t identity, std::size_t follower) {
  for (std::uint64_t place = next_[follower];; ++place) {
    while (place - gone_ >= scenes_.size()) readOn();
    if (scenes_[place - gone_].identity == identity) return place;
  }
}

void ReplayedScenes::passed(std::size_t follower) {
  ++next_[follower];
  for (const std::uint64_t first = *std::min_element(next_.begin(), next_.end()); gone_ < first; ++gone_)
    scenes_.pop_front();
}

}  // namespace hl

#include "page/page_holds.h"

#include <limits>

namespace hl {

void PageHolds::hear(PageNumber page, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  heard_ns_[page] = now_ns;
}

void PageHolds::take(PageNumber page, std::size_t device, What what) {
  const std::lock_guard lock(mutex_);
  holders_[{device, what}] = page;
}

void PageHolds::leave(std::size_t device, What what) {
  const std::lock_guard lock(mutex_);
  holders_.erase({device, what});
}

void PageHolds::gone(PageNumber page) {
  const std::lock_guard lock(mutex_);
  letGoOf(page, std::numeric_limits<std::int64_t>::max());
  heard_ns_.erase(page);
}

void PageHolds::letGoOfSilent(std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  for (const auto& [page, heard_ns] : heard_ns_) letGoOf(page, now_ns - heard_ns);
}

void PageHolds::letGoOf(PageNumber page, std::int64_t silence_ns) {
  std::erase_if(holders_, [&](const auto& hold) {
    const auto& [place, holder] = hold;
    if (holder != page || silence_ns <= silent_ns(place.second)) return false;
    let_go_(place.first, place.second);
    return true;
  });
}

}  // namespace hl

// PageHolds: which page holds which simulated hand, and its buttons. A page that has gone, or that nothing is heard of,
// lets go: the hand of a browser that was ended must not go on pressing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <utility>

#include "page/feed_callbacks.h"

namespace hl {

/// Any thread.
class PageHolds {
 public:
  enum class What { kHand, kButtons };
  /// How long nothing is heard of a page that holds it. Such a page says so again four times in a second
  /// (moved_hands.ts), on a busy machine less often. Buttons may be a dead man's switch.
  static constexpr std::int64_t silent_ns(What what) { return what == What::kHand ? 3'000'000'000 : 800'000'000; }
  using LetGo = std::function<void(std::size_t device, What what)>;

  /// Not called again once this is destroyed; must call nothing here.
  explicit PageHolds(LetGo let_go) : let_go_(std::move(let_go)) {}

  void hear(PageNumber page, std::int64_t now_ns);
  /// Of the page that was heard; another one that held it does so no more.
  void take(PageNumber page, std::size_t device, What what);
  void leave(std::size_t device, What what);
  void gone(PageNumber page);
  void letGoOfSilent(std::int64_t now_ns);

 private:
  using Place = std::pair<std::size_t, What>;

  void letGoOf(PageNumber page, std::int64_t silence_ns);  // holding mutex_

  const LetGo let_go_;
  std::mutex mutex_;  // of the next
  std::map<Place, PageNumber> holders_;
  std::map<PageNumber, std::int64_t> heard_ns_;
};

}  // namespace hl

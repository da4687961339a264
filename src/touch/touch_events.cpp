#include "touch/touch_events.h"

#include <algorithm>

namespace hl {

void TouchEvents::leave(std::size_t felt) {
  events_.push({felt_[felt].last_ns, felt_[felt].object, false, felt_[felt].position_W});
  felt_[felt] = felt_[felt_.size() - 1];
  felt_.resize(felt_.size() - 1);
}

void TouchEvents::come(std::int64_t now_ns, const ObjectName& object, const Vec3& position_W) {
  const auto earlier = [](const Felt& a, const Felt& b) { return a.last_ns < b.last_ns; };
  if (felt_.size() == felt_.capacity()) {
    const auto* longest_ago = std::min_element(felt_.begin(), felt_.end(), earlier);
    leave(static_cast<std::size_t>(longest_ago - felt_.begin()));
  }
  felt_.push({object, now_ns, position_W});
  events_.push({now_ns, object, true, position_W});
}

void TouchEvents::follow(std::int64_t now_ns, const FixedVector<ObjectName, kMaxActive>& touched,
                         const Vec3& position_W) {
  for (const ObjectName& object : touched) {
    const auto is_it = [&](const Felt& felt) { return felt.object.key == object.key; };
    auto* known = std::find_if(felt_.begin(), felt_.end(), is_it);
    if (known == felt_.end()) {
      come(now_ns, object, position_W);
    } else {
      known->last_ns = now_ns;
      known->position_W = position_W;
    }
  }
  for (std::size_t i = felt_.size(); i-- > 0;) {
    if (now_ns - felt_[i].last_ns > kLetGo_ns) leave(i);
  }
}

}  // namespace hl

#include "line/link.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hl::line {

namespace {

std::int64_t nanoseconds(double ms) { return std::llround(1e6 * ms); }

}  // namespace

// In [0, 1), the same with every C++ library: its distributions are not.
double Link::uniform() { return std::ldexp(static_cast<double>(random_() >> 11U), -53); }

void Link::cut(bool cut) {
  cut_ = cut;
  if (!cut) return;
  counts_.cut += waiting_.size();
  waiting_.clear();
}

void Link::put(Packet packet, std::int64_t now_ns) {
  ++counts_.taken;
  // Both for each packet: what happens to one does not depend on the settings for those before it.
  const bool lost = 100 * uniform() < settings_.loss_percent;
  const double jitter_ms = settings_.jitter_ms * (2 * uniform() - 1);
  if (cut_) {
    ++counts_.cut;
  } else if (lost) {
    ++counts_.lost;
  } else if (waiting_.size() >= kMaxWaiting) {
    ++counts_.full;
  } else {
    std::int64_t sent_ns = now_ns;
    if (settings_.rate_Mbit_s > 0) {
      const double way_ms = 8e-3 * static_cast<double>(packet.size()) / settings_.rate_Mbit_s;
      sent_ns = rate_free_ns_ = std::max(now_ns, rate_free_ns_) + nanoseconds(way_ms);
    }
    std::int64_t due_ns = sent_ns + nanoseconds(settings_.delay_ms + jitter_ms);
    if (!settings_.reorder) due_ns = std::max(due_ns, last_due_ns_);
    last_due_ns_ = due_ns;
    waiting_.emplace(due_ns, std::move(packet));
  }
}

std::optional<Packet> Link::take(std::int64_t now_ns) {
  if (due_ns() > now_ns) return std::nullopt;
  ++counts_.given;
  return std::move(waiting_.extract(waiting_.begin()).mapped());
}

LinkCounts Link::counts() const {
  LinkCounts counts = counts_;
  counts.waiting = waiting_.size();
  return counts;
}

}  // namespace hl::line

#include "share/hand_pushes.h"

#include <algorithm>

#include "base/clock.h"

namespace hl {

namespace {

// Between two steps that are farther apart nobody knows what was pressed.
constexpr std::int64_t kLongestStep_ns = 10'000'000;

}  // namespace

// What the object does to the hand, the hand does to the object.
void HandPushes::add(const ServoMoment& moment, double step_s, std::map<std::uint32_t, Sum>& sums) const {
  for (const FeltContact& contact : moment.contacts) {
    if (contact.session != others_) continue;
    Sum& sum = sums[contact.object];
    const Vec3 impulse_N_s = -contact.force_N * step_s;
    sum.impulse_N_s += impulse_N_s;
    sum.weighted_W += impulse_N_s.norm() * contact.point_W;
    sum.weight_N_s += impulse_N_s.norm();
    sum.duration_s += step_s;
  }
}

void HandPushes::addSteps(const TouchSession& hand, Read& read, std::map<std::uint32_t, Sum>& sums) const {
  const LogRing<ServoMoment>& moments = hand.moments();
  const std::uint64_t end = moments.pushed();
  if (end - read.next > moments.room()) read.next = end - moments.room();
  for (; read.next < end; ++read.next) {
    ServoMoment moment;
    if (!moments.read(read.next, moment)) continue;
    const std::int64_t step_ns = moment.time_ns - std::exchange(read.time_ns, moment.time_ns);
    if (step_ns > 0 && step_ns < kLongestStep_ns) add(moment, seconds(step_ns), sums);
  }
}

std::vector<ItemPush> HandPushes::take(TouchServer& server, const ReplicasHere& replicas) {
  std::map<std::uint32_t, Sum> sums;
  read_.resize(server.devices());
  for (std::size_t i = 0; i < read_.size(); ++i) addSteps(server.device(i), read_[i], sums);
  std::vector<ItemPush> pushes;
  for (const auto& [number, sum] : sums) {
    const std::optional<ItemId> id = replicas.idOf(number);
    if (!id || !(sum.weight_N_s > 0)) continue;
    const Vec3 point_O = replicas.poseOf(*id).toObject(sum.weighted_W / sum.weight_N_s);
    pushes.push_back({*id, sum.impulse_N_s, point_O, sum.duration_s});
  }
  return pushes;
}

}  // namespace hl

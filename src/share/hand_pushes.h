// HandPushes: what the hands of this server press on objects of others, gathered from the steps of their servos.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "session/touch_server.h"
#include "share/replicas_here.h"
#include "share/shared_world.h"

namespace hl {

/// One thread.
class HandPushes {
 public:
  explicit HandPushes(std::uint32_t others) : others_(others) {}

  /// Of the steps since the last call. `others`: see LocalScene.
  std::vector<ItemPush> take(TouchServer& server, const ReplicasHere& replicas);

 private:
  struct Sum {
    Vec3 impulse_N_s = Vec3::Zero();
    Vec3 weighted_W = Vec3::Zero();  // points, each times the size of its impulse
    double weight_N_s = 0, duration_s = 0;
  };
  struct Read {
    std::uint64_t next = 0;  // moment
    std::int64_t time_ns = 0;
  };
  void add(const ServoMoment& moment, double step_s, std::map<std::uint32_t, Sum>& sums) const;
  void addSteps(const TouchSession& hand, Read& read, std::map<std::uint32_t, Sum>& sums) const;

  const std::uint32_t others_;
  std::vector<Read> read_;  // by hand
};

}  // namespace hl

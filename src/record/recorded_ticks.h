// Ticks of the proxy as a recording holds them: all that goes into one and comes out of it.
#pragma once

#include <recording.pb.h>

#include <cstdint>
#include <span>
#include <vector>

#include "touch/proxy_loop.h"

namespace hl {

struct TickRecord {
  TickRequest in;
  std::uint64_t scene = 0;  ///< identity of the snapshot
  ServoTarget target;
  Vec3 proxy = Vec3::Zero();  ///< world
  std::uint64_t contacts = 0;
  std::int64_t work_ns = 0;
  int used_up_at = 0;            ///< as in TickReport
  std::uint64_t world_hash = 0;  ///< worldHash() after the tick
};

/// What seldom changes from tick to tick.
struct TickContext {
  ProxyCommands commands;
  SpringOfServo spring;
  std::uint64_t scene = 0;
};

/// Of how many of the bodies' steps there is a hash: of all (of more than 100 bodies of each hundredth), or of each
/// hundredth.
enum class HashedSteps { kAll, kSome };
/// hashOf() of the bodies after a tick; 0 where there are none, or this step has no hash. RT-safe.
std::uint64_t worldHash(const ProxyLoop& proxy, HashedSteps hashed);

/// Consecutive ticks, at least one; `first` is the number of the first.
void toProto(std::span<const TickRecord> records, std::uint64_t first, proto::ProxyTicks& out);
/// Throws hl::Error when the message does not fit.
std::vector<TickRecord> fromProto(const proto::ProxyTicks& in);

}  // namespace hl

// ShareView: a shared world as its server knows it, for pages, metrics and logs.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "share/shared_world.h"

namespace hl {

/// Another server that is there.
struct PeerView {
  std::string name;
  double round_trip_ms = 0;
  double playout_ms = 0;  ///< how long after it was so what it publishes is shown
};

struct ShareView {
  std::string world, name;                  ///< of the world; of this server in it
  std::string ended;                        ///< why it is not shared now, in one line; empty: it is
  std::uint64_t starts = 0;                 ///< times that hl-share was started again, after it had ended
  ShareCounts counts{};                     ///< the last ones, while it is not shared
  std::vector<PeerView> peers{};            ///< by name
  std::vector<proto::OtherDevice> hands{};  ///< of other servers, with the name of each; by server, then by number
};

/// Any thread.
using ReadShare = std::function<ShareView()>;

}  // namespace hl

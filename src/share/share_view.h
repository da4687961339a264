// ShareView: a shared world as its server knows it, for pages, metrics and logs.
#pragma once

#include <hl.pb.h>

#include <functional>
#include <string>
#include <vector>

#include "share/shared_world.h"

namespace hl {

/// Another server that is there.
struct PeerView {
  std::string name;
  double round_trip_ms = 0;
  double playout_ms = 0;  ///< how long after it was so what it tells is shown
};

struct ShareView {
  std::string world, name;                  ///< of the world; of this server in it
  std::string ended;                        ///< why it shares no more, in one line; empty: it does
  ShareCounts counts{};                     ///< the last ones, once it has ended
  std::vector<PeerView> peers{};            ///< by name
  std::vector<proto::OtherDevice> hands{};  ///< of other servers, with the name of each; by server, then by number
};

/// Any thread.
using ReadShare = std::function<ShareView()>;

}  // namespace hl

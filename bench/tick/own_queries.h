// HL's own queries, asked the way the peers are.
#pragma once

#include <memory>

#include "scene/snapshot.h"
#include "tick/peer.h"

namespace hl::bench {

/// The snapshot must outlive it.
std::unique_ptr<Peer> makeOwnQueries(const Snapshot& snapshot);

}  // namespace hl::bench

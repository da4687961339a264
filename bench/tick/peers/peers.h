// The other libraries that were built in.
#pragma once

#include <memory>
#include <span>

#include "tick/peer.h"

namespace hl::bench {

struct PeerKind {
  const char* name;
  std::unique_ptr<Peer> (*make)(const Mesh& mesh);  ///< builds its hierarchy; the mesh must outlive it
};

/// Empty when HL was built without them (HL_BENCH_PEERS).
std::span<const PeerKind> peers();

std::unique_ptr<Peer> makeEmbree(const Mesh& mesh);
std::unique_ptr<Peer> makeBullet(const Mesh& mesh);
std::unique_ptr<Peer> makeFcl(const Mesh& mesh);
std::unique_ptr<Peer> makeCgal(const Mesh& mesh);

}  // namespace hl::bench

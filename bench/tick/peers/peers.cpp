#include "tick/peers/peers.h"

#include <array>

namespace hl::bench {

std::span<const PeerKind> peers() {
  static constexpr std::array<PeerKind, 4> kPeers{
      {{"embree", makeEmbree}, {"cgal", makeCgal}, {"fcl", makeFcl}, {"bullet", makeBullet}}};
  return kPeers;
}

}  // namespace hl::bench

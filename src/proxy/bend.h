// Bend: what meshes that change their shape do to the proxy. Between two snapshots a mesh is in no place, so it would
// leave the proxy on its other side. As an object does that moves (carry.h), it pushes the proxy instead, and takes it
// along by friction.
#pragma once

#include "proxy/proxy.h"

namespace hl {

/// In the first tick of a snapshot: moves the proxy to the side of each bent mesh on which it was in the snapshot
/// before. It stays where it is while nothing meets it; where friction holds it, it stays where it is on the mesh. A
/// mesh that was farther from it than kMostBendRadii is not looked for, and nothing is done where the last tick was not
/// of the snapshot before. RT-safe; looks at what is near some times.
void bend(ProxyState& state, const SceneAt& scene, const ProxySettings& settings);

inline constexpr double kMostBendRadii = 16;

}  // namespace hl

#include "cubes/body_engine.h"

namespace hl::bench {

std::span<const BodyEngineKind> bodyPeers() { return {}; }

}  // namespace hl::bench

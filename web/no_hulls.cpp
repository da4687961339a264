// In a browser there is no qhull, and no scene with bodies that would need it.
#include "base/error.h"
#include "bodies/convex_hull.h"

namespace hl {

Hull hullOf(std::span<const Vec3>) { throw Error("hulls of bodies are made by a server only"); }

}  // namespace hl

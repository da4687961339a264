// What HL itself reads of X3D files: the nodes that it says in other words, its prototypes, and its rigid bodies.
#include <string>
#include <vector>

#include "io/x3d_bodies.h"
#include "io/x3d_plain.h"
#include "io/x3d_prototypes.h"
#include "refusal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  hl::fuzz::takes([&] {
    std::vector<std::string> warnings;
    const std::string expanded = hl::withoutPrototypes(text, warnings);
    hl::fuzz::require(!hl::plainX3d(expanded, warnings).empty());
    if (!hl::speaksOfBodies(expanded)) return;
    const hl::SceneModel scene = hl::readX3dBodies(expanded, [](const std::string&) { return hl::Model(); });
    for (const hl::SceneBody& body : scene.bodies) hl::fuzz::require(body.pose.origin.allFinite());
  });
  return 0;
}

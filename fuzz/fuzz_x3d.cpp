// What HL itself reads of X3D files: the nodes that it says in other words, its prototypes, and its rigid bodies.
#include <string>
#include <vector>

#include "io/x3d_bodies.h"
#include "io/x3d_plain.h"
#include "refusal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  hl::fuzz::takes([&] {
    std::vector<std::string> warnings;
    const std::string plain = hl::plainX3d(text, warnings);
    if (!hl::speaksOfBodies(plain)) return;
    const hl::SceneModel scene = hl::readX3dBodies(plain, [](const std::string&) { return hl::Model(); });
    for (const hl::SceneBody& body : scene.bodies) hl::fuzz::require(body.pose.origin.allFinite());
  });
  return 0;
}

// What HL itself reads of glTF files: what it checks and changes before its reader has them, and the extensions that
// say how an object feels. The first byte chooses text or GLB.
#include "io/gltf_haptics.h"
#include "io/plain_gltf.h"
#include "refusal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string ending = data[0] % 2 == 0 ? ".gltf" : ".glb";
  const std::string path = hl::fuzz::fileOf("a" + ending, data + 1, size - 1);
  hl::fuzz::takes([&] {
    const hl::GltfHaptics haptics = hl::readGltfHaptics(hl::gltfJson(path), path);
    for (const auto& [node, material] : haptics.material_of_node)
      hl::fuzz::require(material < haptics.materials.size());
    for (const hl::Material& material : haptics.materials) {
      hl::fuzz::require(material.stiffness >= 0 && material.stiffness <= 1 && material.static_friction >= 0 &&
                        material.dynamic_friction >= 0);
      for (const hl::TextureUse& use : material.textures)
        hl::fuzz::require(!use.used() || use.texture < haptics.textures.size());
    }
  });
  hl::fuzz::takes([&] {
    std::vector<std::string> warnings;
    const std::optional<std::string> plain = hl::plainGltf({path, ending}, warnings);
    // What was made plain is plain.
    if (plain) hl::fuzz::require(!hl::plainGltf({hl::test::fileWith("b" + ending, *plain), ending}, warnings));
  });
  return 0;
}

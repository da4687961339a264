// What HL itself reads of glTF files: the extensions that say how an object feels. The first byte chooses text or GLB.
#include "io/check_gltf.h"
#include "io/gltf_haptics.h"
#include "refusal.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string path = hl::fuzz::fileOf(data[0] % 2 == 0 ? "a.gltf" : "a.glb", data + 1, size - 1);
  hl::fuzz::takes([&] {
    const std::string text = hl::gltfJson(path);
    hl::checkGltf(text);
    const hl::GltfHaptics haptics = hl::readGltfHaptics(text, path);
    for (const auto& [node, material] : haptics.material_of_node)
      hl::fuzz::require(material < haptics.materials.size());
    for (const hl::Material& material : haptics.materials) {
      hl::fuzz::require(material.stiffness >= 0 && material.stiffness <= 1 && material.static_friction >= 0 &&
                        material.dynamic_friction >= 0);
      for (const hl::TextureUse& use : material.textures)
        hl::fuzz::require(!use.used() || use.texture < haptics.textures.size());
    }
  });
  return 0;
}

#include "page/layout_materials.h"

namespace hl {

void addMaterials(const Surfaces& surfaces, proto::PlacedMesh& placed) {
  if (surfaces.materials.size() > kMaxLayoutMaterials) return;
  for (const Material& material : surfaces.materials) {
    proto::Surfaces& out = *placed.add_materials();
    const google::protobuf::Reflection& reflection = *out.GetReflection();
    for (std::size_t i = 0; i < kNumbers; ++i) {
      if (material.textureOf(kQuantityInfo[i].quantity).used()) continue;
      const auto& field = *proto::Surfaces::descriptor()->FindFieldByName(kQuantityInfo[i].field);
      reflection.SetDouble(&out, &field, material.*kMaterialNumbers[i]);
    }
    out.set_smooth(material.smooth);
  }
}

}  // namespace hl

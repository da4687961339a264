// A triangle of its own vertices, for models that are drawn at random.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "scene/model.h"

namespace hl::soak {

inline void addTriangle(Model& model, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  model.positions.insert(model.positions.end(), {a, b, c});
  model.triangles.push_back({first, first + 1, first + 2});
}

}  // namespace hl::soak

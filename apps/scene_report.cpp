#include "scene_report.h"

#include "bodies/scene_world.h"

namespace hl {

std::vector<std::string> warningsOf(const Snapshot& snapshot) {
  std::vector<std::string> warnings = snapshot.warnings, of_bodies = bodyWarnings(snapshot);
  warnings.insert(warnings.end(), of_bodies.begin(), of_bodies.end());
  return warnings;
}

std::uint64_t trianglesOf(const Shape& shape) {
  const bool counted = shape.source && shape.source->kind() == PrimitiveKind::kTriangle;
  return counted ? shape.elements() : shape.model.triangles.size();
}

}  // namespace hl

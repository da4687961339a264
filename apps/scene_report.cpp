#include "scene_report.h"

#include "bodies/scene_world.h"

namespace hl {

std::vector<std::string> warningsOf(const Snapshot& snapshot) {
  std::vector<std::string> warnings = snapshot.warnings, of_bodies = bodyWarnings(snapshot);
  warnings.insert(warnings.end(), of_bodies.begin(), of_bodies.end());
  return warnings;
}

std::uint64_t trianglesOf(const Shape& shape) {
  const bool of_source = shape.source && shape.source->kind() == PrimitiveKind::kTriangle;
  return of_source ? shape.elements() : shape.model.triangles.size();
}

std::string counted(std::uint64_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace hl

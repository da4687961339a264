// The whole benchmark: every scene in every size, every motion and radius, HL and the peers on the same places.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scene/model.h"
#include "tick/feel.h"
#include "tick/finger_motion.h"
#include "tick/row.h"

namespace hl::bench {

enum class RadiusMode : std::uint8_t {
  kFixed,
  kScaled,  ///< a multiple of the mesh's mean edge
  kZoomed,  ///< the same, and the finger's motion in proportion: however fine the mesh, a tick meets as many triangles
};
inline constexpr std::array kRadiusModes{RadiusMode::kFixed, RadiusMode::kScaled, RadiusMode::kZoomed};
/// "fixed", "scaled" or "zoomed".
const char* nameOf(RadiusMode mode);

struct BenchScene {
  std::string name;
  std::vector<std::size_t> sizes;  ///< triangles, about; one for a scene that has only one
  std::function<Model(std::size_t size)> make;
  bool effects = false;  ///< also with surface effects; the model needs normals and texture coordinates
};

struct SuitePlan {
  std::vector<BenchScene> scenes;
  std::vector<FingerMotion> motions{FingerMotion::kSliding};
  std::vector<RadiusMode> radii{RadiusMode::kFixed};
  std::vector<HierarchyKind> hierarchies{HierarchyKind::kBvh};  ///< any but bvh only for sliding with a fixed radius
  double radius_m = 1e-3;                                       ///< the fixed one
  double radius_edges = 1;                                      ///< the others, in mean edges
  std::size_t ticks = 20'000;
  bool peers = false;
};

/// Where results go as soon as they are there.
struct SuiteOutput {
  std::function<void(const Row&)> row;
  std::function<void(const Growth&)> growth;         ///< after the last size of a scene
  std::function<void(const std::string&)> note;      ///< what was left out, and why
  std::function<void(const std::string&)> progress;  ///< what is being done now
};

/// Throws hl::Error for a scene that cannot be made or touched.
void runSuite(const SuitePlan& plan, const SuiteOutput& output);

}  // namespace hl::bench

// hl bench --surfaces: ticks on surfaces that are no meshes, of every kind, in one table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/output_file.h"
#include "scene/scene_model.h"
#include "tick/finger_motion.h"
#include "tick/timing.h"

namespace hl {

struct SurfaceBenchOptions {
  std::vector<std::string> kinds;  ///< names of kSurfaceKinds
  std::size_t most = 0;            ///< triangles of a field, samples of a volume, points of a cloud
  std::size_t ticks = 20'000;
  double radius_m = 1e-3;
  std::string csv;  ///< a file; empty: none
};

/// A surface, and what it takes to have it.
struct BenchSurface {
  std::string name;
  double stored = 0;  ///< samples or points in memory; 0: none
  double bytes = 0, open_s = 0;
  std::optional<double> change_ms{};  ///< to change it while it is touched: another iso value, the next frame
  std::optional<double> cell_m{};     ///< about the distance between its samples; absent: it has none
};

class SurfaceBench {
 public:
  /// Throws hl::Error if the file cannot be written.
  explicit SurfaceBench(const SurfaceBenchOptions& options);

  const SurfaceBenchOptions& options() const { return options_; }
  /// A finger slides and wanders over the scene and taps on it, with the radius of the options; and, where the surface
  /// has cells, with a radius of four of them and its motion in proportion. A row each.
  void measure(const BenchSurface& surface, const Snapshot& scene);
  void measure(const BenchSurface& surface, const Snapshot& scene, double radius_m);
  void close();

 private:
  void row(const BenchSurface& surface, const Snapshot& scene, double radius_m, bench::FingerMotion motion);

  const SurfaceBenchOptions& options_;
  std::optional<OutputFile> csv_;
};

/// Throws hl::Error where less memory than `bytes` is there.
void needMemory(double bytes, const std::string& what);
double secondsSince(std::int64_t begin_ns);
/// Of a scene with one surface.
SceneModel alone(const std::string& name, std::shared_ptr<const PrimitiveSource> source);

void benchFields(SurfaceBench& bench);
void benchVolumes(SurfaceBench& bench);
void benchImplicits(SurfaceBench& bench);
void benchDepths(SurfaceBench& bench);
void benchClouds(SurfaceBench& bench);

struct SurfaceKind {
  const char* name;
  void (*measure)(SurfaceBench& bench);
};
inline constexpr std::array<SurfaceKind, 5> kSurfaceKinds{{{"field", benchFields},
                                                           {"ct", benchVolumes},
                                                           {"sdf", benchImplicits},
                                                           {"depth", benchDepths},
                                                           {"points", benchClouds}}};
constexpr const char* nameOf(SurfaceKind kind) { return kind.name; }

/// Throws hl::Error where memory lacks, or the file cannot be written.
void runSurfaceBench(const SurfaceBenchOptions& options);

}  // namespace hl

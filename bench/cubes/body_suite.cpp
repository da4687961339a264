#include "cubes/body_suite.h"

#include <algorithm>
#include <ctime>
#include <limits>

#include "cubes/body_engine.h"

namespace hl::bench {

namespace {

constexpr int kLastSteps = 500;

std::int64_t processorTime_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1'000'000'000 * static_cast<std::int64_t>(now.tv_sec) + now.tv_nsec;
}

std::vector<CubeState> statesOf(const BodyEngine& engine, std::size_t cubes) {
  std::vector<CubeState> states;
  for (std::size_t i = 0; i < cubes; ++i) states.push_back(engine.cube(i));
  return states;
}

BodyRow measureBodies(const CubeScene& scene, const char* name, BodyEngine& engine) {
  BodyRow row{scene.name, name, {}};
  double finger_m = -kCubeHalf_m, last_J = energyOf_J(statesOf(engine, scene.cubes.size()));
  double lowest_N = std::numeric_limits<double>::infinity(), highest_N = 0;
  for (int i = 0; i < scene.steps; ++i) {
    finger_m += kBodyStep_s * scene.finger_m_s;
    const std::int64_t begin_ns = processorTime_ns();
    const double force_N = engine.step(scene.finger_m_s > 0 ? finger_m : -1);
    row.times.add(processorTime_ns() - begin_ns);
    const double now_J = energyOf_J(statesOf(engine, scene.cubes.size()));
    if (!(scene.finger_m_s > 0)) row.gained_J += std::max(0.0, now_J - last_J);
    last_J = now_J;
    if (i < scene.steps - kLastSteps) continue;
    row.force_N += force_N / kLastSteps;
    lowest_N = std::min(lowest_N, force_N);
    highest_N = std::max(highest_N, force_N);
  }
  row.ripple_N = highest_N - lowest_N;
  const std::vector<CubeState> end = statesOf(engine, scene.cubes.size());
  row.overlap_m = deepestOverlap_m(scene, end);
  for (const CubeState& cube : end) row.speed_m_s = std::max(row.speed_m_s, cube.velocity.norm());
  return row;
}

}  // namespace

void runBodySuite(bool peers, const std::function<void(const BodyRow&)>& output) {
  for (const CubeScene& scene : cubeScenes()) {
    output(measureBodies(scene, "hl", *makeOwnBodies(scene)));
    if (!peers) continue;
    for (const BodyEngineKind& kind : bodyPeers()) {
      if (scene.cubes.size() <= kind.most_cubes) output(measureBodies(scene, kind.name, *kind.make(scene)));
    }
  }
}

}  // namespace hl::bench

// Steps of bodies: stacks that stand, a pile that falls into a box, and many bodies of which few are awake. Each step
// is timed, and the percentiles are reported beside the mean.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <vector>

#include "bodies/body_step.h"

namespace hl {
namespace {

constexpr double kPeriod_s = 1e-3, kHalf_m = 0.02;

// Five sides of a box of this half width, open at the top; its floor is y = 0.
std::shared_ptr<const Snapshot> tray(double half_m, double height_m) {
  Model model;
  for (const double y : {0.0, height_m}) {
    for (const auto& [x, z] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{1, 1}, std::pair{-1, 1}})
      model.positions.emplace_back(half_m * x, y, half_m * z);
  }
  model.triangles = {{0, 2, 1}, {0, 3, 2}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    model.triangles.push_back({i, next, next + 4});
    model.triangles.push_back({i, next + 4, i + 4});
  }
  return makeSnapshot(std::move(model));
}

struct Scene {
  World world;
  std::vector<Pose> poses;

  void addCube(const Vec3& at, double turn_rad = 0) {
    const Vec3 half = Vec3::Constant(kHalf_m);
    world.bodies.push_back({world.bodies.size() + 1, massOfBox(0.1, half), boxShape(half), {0.5, 0.5, 0}});
    poses.push_back({Eigen::AngleAxisd(turn_rad, Vec3(1, 2, 3).normalized()).toRotationMatrix(), at});
  }
  void addStack(const Vec3& at, int cubes) {
    for (int i = 0; i < cubes; ++i) addCube(at + Vec3(0, (2 * i + 1) * kHalf_m, 0));
  }
};

Scene sceneIn(double half_m) {
  Scene scene;
  scene.world.fixed = tray(half_m, 2);
  return scene;
}

// Of this thread: what else the machine does is not counted.
double processorTime_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double percentile(std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

double energy_J(const World& world, const WorldState& state) {
  return kineticEnergy_J(world, state) + gravityEnergy_J(world, state);
}

template <typename Before>
void timeSteps(benchmark::State& bench, Scene scene, int settling, Before before) {
  const auto world = std::make_shared<const World>(std::move(scene.world));
  WorldState state = startWorld(*world, scene.poses);
  BodyStepper stepper(world);
  for (int i = 0; i < settling; ++i) {
    before(state);
    stepper.step(state, kPeriod_s, {}, {});
  }
  std::vector<double> times_us;
  double rows = 0, sweeps = 0, converged = 0, deepest_m = 0, gained_J = 0;
  for (auto _ : bench) {
    before(state);
    const double before_J = energy_J(*world, state);
    const double begin_s = processorTime_s();
    const BodyStepReport report = stepper.step(state, kPeriod_s, {}, {});
    const double took_s = processorTime_s() - begin_s;
    times_us.push_back(1e6 * took_s);
    bench.SetIterationTime(took_s);
    rows += report.rows;
    sweeps += report.sweeps;
    converged += report.converged ? 1 : 0;
    deepest_m = std::max(deepest_m, report.deepest);
    const double now_J = energy_J(*world, state);
    gained_J += std::max(0.0, now_J - before_J);
  }
  std::sort(times_us.begin(), times_us.end());
  bench.counters["p50_us"] = percentile(times_us, 0.5);
  bench.counters["p99.9_us"] = percentile(times_us, 0.999);
  bench.counters["rows"] = rows / static_cast<double>(times_us.size());
  bench.counters["overlap_um"] = 1e6 * deepest_m;
  bench.counters["gained_mJ"] = 1e3 * gained_J;  // sum over the steps in which the energy rose
  bench.counters["converged"] = converged / static_cast<double>(times_us.size());
  bench.counters["sweeps"] = sweeps / static_cast<double>(times_us.size());
}

void nothing(WorldState&) {}
// The first bodies; the others may sleep.
void keepAwake(WorldState& state, std::size_t bodies) {
  for (std::size_t i = 0; i < bodies; ++i) state.bodies[i].still_s = 0;
}

void tenStacksOfTen(benchmark::State& bench) {
  Scene scene = sceneIn(1);
  for (int i = 0; i < 10; ++i) scene.addStack(Vec3(0.15 * i - 0.7, 0, 0), 10);
  timeSteps(bench, std::move(scene), 100, [](WorldState& state) { keepAwake(state, 100); });
}

// Each stack is pushed in its middle every tenth step, too little to fall.
void tenStacksThatShake(benchmark::State& bench) {
  Scene scene = sceneIn(1);
  for (int i = 0; i < 10; ++i) scene.addStack(Vec3(0.15 * i - 0.7, 0, 0), 10);
  timeSteps(bench, std::move(scene), 100, [](WorldState& state) {
    if (state.steps % 10 != 0) return;
    for (std::size_t i = 5; i < 100; i += 10) state.bodies[i].velocity.x() += 0.02;
  });
}

// A hundred stacks of ten, of which five are kept awake: `awake` bodies of a thousand.
void aThousandOfWhich(benchmark::State& bench) {
  Scene scene = sceneIn(2);
  for (int i = 0; i < 100; ++i) scene.addStack(Vec3(0.15 * (i % 10) - 0.7, 0, 0.15 * (i / 10) - 0.7), 10);
  const auto awake = static_cast<std::size_t>(bench.range(0));
  timeSteps(bench, std::move(scene), 700, [awake](WorldState& state) { keepAwake(state, awake); });
}

// Falls into its box.
Scene pile(double turned_rad) {
  Scene scene = sceneIn(0.13);
  for (int i = 0; i < 100; ++i) {
    const Vec3 at(0.075 * (i % 3 - 1), 0.04 + 0.075 * (i / 9), 0.075 * (i / 3 % 3 - 1));
    scene.addCube(at, turned_rad + 0.3 * i);
  }
  return scene;
}

// From the first touch on the floor until all lies.
void pileOfAHundred(benchmark::State& bench) { timeSteps(bench, pile(0), 0, nothing); }

// Piles that begin turned otherwise, one an iteration: how many sleep after four seconds, and since when. One pile
// alone says little: the least change makes another one of it.
void pilesComeToRest(benchmark::State& bench) {
  constexpr int kSteps = 4000;
  double turned_rad = 0, piles = 0, asleep = 0, since_s = 0;
  for (auto _ : bench) {
    Scene scene = pile(turned_rad);
    const auto world = std::make_shared<const World>(std::move(scene.world));
    WorldState state = startWorld(*world, scene.poses);
    BodyStepper stepper(world);
    int last_awake = 0;
    const double begin_s = processorTime_s();
    for (int step = 0; step < kSteps; ++step) {
      if (stepper.step(state, kPeriod_s, {}, {}).awake > 0) last_awake = step;
    }
    bench.SetIterationTime((processorTime_s() - begin_s) / kSteps);
    turned_rad += 0.1;
    ++piles;
    if (last_awake + 1 == kSteps) continue;
    ++asleep;
    since_s += kPeriod_s * last_awake;
  }
  bench.counters["piles"] = piles;
  bench.counters["asleep"] = asleep;
  bench.counters["since_s"] = asleep > 0 ? since_s / asleep : 0;
}

BENCHMARK(tenStacksOfTen)->UseManualTime()->Iterations(3000)->Unit(benchmark::kMicrosecond);
BENCHMARK(tenStacksThatShake)->UseManualTime()->Iterations(3000)->Unit(benchmark::kMicrosecond);
BENCHMARK(aThousandOfWhich)->Arg(0)->Arg(50)->UseManualTime()->Iterations(3000)->Unit(benchmark::kMicrosecond);
BENCHMARK(pileOfAHundred)->UseManualTime()->Iterations(3000)->Unit(benchmark::kMicrosecond);
BENCHMARK(pilesComeToRest)->UseManualTime()->Iterations(12)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace hl

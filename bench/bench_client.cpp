// What an HL program gets from a server: how soon a large mesh can be touched, how often it can be replaced or bent,
// how many frames of moving objects are shown, and how fresh states are. Prints one line for each.
//
//   bench_client [URL] [--objects N] [--seconds S]      URL: inproc: (default), hl://HOST:PORT, hls://...
//   bench_client URL --only replace                     only replaces the mesh, ten times a second
//   bench_client URL --only depth --seconds 60          pictures of a depth camera, and as long without
#include <fmt/core.h>
#include <hl/hl.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "depth_session.h"

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void fail(const std::string& what) {
  fmt::print(stderr, "bench_client: {}: {}\n", what, hlGetString(HL_ERROR_STRING));
  std::exit(1);
}

double height(double x, double z, double phase) { return 0.02 * std::sin(40 * x + phase) * std::cos(30 * z); }

std::vector<double> terrainVertices(int side, double phase) {
  std::vector<double> vertices;
  for (int i = 0; i <= side; ++i) {
    for (int k = 0; k <= side; ++k) {
      const double x = 0.2 * i / side - 0.1, z = 0.2 * k / side - 0.1;
      vertices.insert(vertices.end(), {x, height(x, z, phase) - 0.05, z});
    }
  }
  return vertices;
}

// A hilly sheet of 2 side^2 triangles over 0.2 m x 0.2 m, as a GL program with arrays would send it.
void drawTerrain(int side, double phase) {
  const std::vector<double> vertices = terrainVertices(side, phase);
  std::vector<unsigned> indices;
  const auto at = [side](int i, int k) { return static_cast<unsigned>(i * (side + 1) + k); };
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      for (const unsigned index : {at(i, k), at(i, k + 1), at(i + 1, k), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)})
        indices.push_back(index);
    }
  }
  hlEnableClientState(HL_VERTEX_ARRAY);
  hlVertexPointer(3, HL_DOUBLE, 0, vertices.data());
  hlDrawElements(HL_TRIANGLES, static_cast<HLsizei>(indices.size()), HL_UNSIGNED_INT, indices.data());
  hlDisableClientState(HL_VERTEX_ARRAY);
}

void measureMesh(int side) {
  const auto start = Clock::now();
  drawTerrain(side, 0);
  if (hlFinishTimeout(120) == HL_FALSE) fail("the mesh was not shown");
  fmt::print("{:>9} triangles: {:.2f} s from the first call until they can be touched\n", 2 * side * side,
             secondsSince(start));
}

// The whole mesh anew each time, as programs do that know nothing of hlUpdateVertices.
void measureReplacements(int side, double seconds) {
  constexpr double kRate_Hz = 10;
  constexpr HLuint kMesh = 2;
  HLint first = 0, shown = 0;
  hlGetIntegerv(HL_FRAME_SHOWN, &first);
  const auto start = Clock::now();
  auto next = start;
  int frames = 0;
  while (secondsSince(start) < seconds) {
    hlNewObject(kMesh);
    drawTerrain(side, 0.1 * ++frames);
    hlEndObject();
    hlCallObject(kMesh);
    hlFlush();
    hlGetError();  // a server that is behind lets frames wait: that is what is measured
    hlPoll();
    next += std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / kRate_Hz));
    std::this_thread::sleep_until(next);
  }
  if (hlFinishTimeout(60) == HL_FALSE) fail("the mesh was not replaced");
  hlGetIntegerv(HL_FRAME_SHOWN, &shown);
  fmt::print("{:>9} triangles replaced: {:.1f} times/s drawn, {:.1f} times/s shown\n", 2 * side * side,
             frames / secondsSince(start), (shown - first) / secondsSince(start));
}

// One mesh that bends: all its vertices move, and again as soon as that can be felt.
void measureBending(int side, double seconds) {
  constexpr HLuint kMesh = 3;
  hlNewObject(kMesh);
  drawTerrain(side, 0);
  hlEndObject();
  hlCallObject(kMesh);
  if (hlFinishTimeout(60) == HL_FALSE) fail("the mesh was not shown");
  const auto start = Clock::now();
  std::vector<double> times_s;
  while (secondsSince(start) < seconds) {
    const std::vector<double> vertices = terrainVertices(side, 0.1 * static_cast<double>(times_s.size()));
    const auto moved = Clock::now();
    hlUpdateVertices(kMesh, 0, static_cast<HLsizei>(vertices.size() / 3), vertices.data(), nullptr);
    if (hlFinishTimeout(60) == HL_FALSE || hlGetError() != HL_NO_ERROR) fail("the mesh was not bent");
    times_s.push_back(secondsSince(moved));
  }
  std::sort(times_s.begin(), times_s.end());
  fmt::print(
      "{:>9} triangles bent: {:.0f} ms in the median from hlUpdateVertices until it is felt, {:.0f} ms at most\n",
      2 * side * side, 1e3 * times_s[times_s.size() / 2], 1e3 * times_s.back());
}

void defineBox(HLuint object) {
  hlNewObject(object);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      hlBegin(HL_QUADS);
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        double corner[3];
        corner[axis] = 0.002 * side;
        corner[(axis + 1) % 3] = 0.002 * a;
        corner[(axis + 2) % 3] = 0.002 * b;
        hlVertex3dv(corner);
      }
      hlEnd();
    }
  }
  hlEndObject();
}

void drawSwarm(int objects, double time_s) {
  for (int i = 0; i < objects; ++i) {
    hlPushMatrix();
    hlTranslated(0.01 * (i % 10) - 0.05 + 0.003 * std::sin(time_s + i), 0.01 * (i / 10 % 10) - 0.05,
                 0.01 * (i / 100) - 0.05);
    hlRotated(50 * time_s + i, 0.3, 1, 0.2);
    hlCallObject(1);
    hlPopMatrix();
  }
}

void measureFrames(int objects, double seconds) {
  defineBox(1);
  HLint first = 0, shown = 0;
  hlFinishTimeout(60);
  hlGetIntegerv(HL_FRAME_SHOWN, &first);
  const auto start = Clock::now();
  auto next = start;
  int frames = 0;
  double worst_s = 0;
  while (secondsSince(start) < seconds) {
    const auto begin = Clock::now();
    drawSwarm(objects, secondsSince(start));
    hlFlush();
    hlPoll();
    worst_s = std::max(worst_s, secondsSince(begin));
    ++frames;
    std::this_thread::sleep_until(next += std::chrono::nanoseconds(16'666'667));
  }
  if (hlFinishTimeout(60) == HL_FALSE || hlGetError() != HL_NO_ERROR) fail("frames were not shown");
  hlGetIntegerv(HL_FRAME_SHOWN, &shown);
  fmt::print(
      "{:>9} moving objects: {:.1f} frames/s drawn, {:.1f} frames/s shown; a frame takes the program at most {:.1f} "
      "ms\n",
      objects, frames / seconds, (shown - first) / secondsSince(start), 1e3 * worst_s);
}

// The clocks of two hosts differ by an unknown time: reported is how much later than the freshest state each came.
void measureStates(double seconds) {
  hlStateRate(1000);
  std::vector<double> late;
  double last_time = 0, freshest = 1e300;
  const auto start = Clock::now();
  while (secondsSince(start) < seconds) {
    hlPoll();
    HLdouble time = 0;
    hlGetDoublev(HL_STATE_TIME, &time);
    if (time != last_time) {
      last_time = time;
      late.push_back(secondsSince(start) - time);
      freshest = std::min(freshest, late.back());
    }
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  if (late.empty()) fail("no states came");
  std::sort(late.begin(), late.end());
  const auto percentile = [&](double p) {
    return 1e3 * (late[static_cast<std::size_t>(p * static_cast<double>(late.size() - 1))] - freshest);
  };
  fmt::print("{:>9.0f} states/s; later than the freshest by {:.2f} ms median, {:.2f} ms p99, {:.2f} ms at most\n",
             static_cast<double>(late.size()) / seconds, percentile(0.5), percentile(0.99), percentile(1));
}

void printServer() {
  HLint servo = 0, proxy = 0;
  hlGetIntegerv(HL_SERVO_DEADLINES_MISSED, &servo);
  hlGetIntegerv(HL_PROXY_DEADLINES_MISSED, &proxy);
  fmt::print("server: {} servo and {} proxy deadlines missed so far\n", servo, proxy);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What an HL program gets from a server.", "bench_client");
  std::string url = "inproc:";
  int objects = 1000, side = 707;
  double seconds = 5;
  std::string only;
  app.add_option("url", url, "inproc:, hl://HOST:PORT or hls://HOST:PORT")->capture_default_str();
  app.add_option("--objects", objects, "moving objects")->check(CLI::Range(1, 100'000))->capture_default_str();
  app.add_option("--side", side, "the mesh has 2 SIDE^2 triangles")->check(CLI::Range(1, 2000))->capture_default_str();
  app.add_option("--seconds", seconds, "of frames, and of states")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--only", only, "one measurement in place of all")->check(CLI::IsMember({"replace", "depth"}));
  CLI11_PARSE(app, argc, argv);
  HLcontext* context = hlCreateContext(url.c_str());
  if (context == nullptr) {
    fmt::print(stderr, "bench_client: {}\n", hlGetConnectError());
    return 2;
  }
  hlMakeCurrent(context);
  if (only == "depth" && !hl::bench::measureDepthSession(seconds)) fail("no picture was shown");
  if (only.empty()) measureMesh(side);
  if (only != "depth") measureReplacements(side, seconds);
  if (only.empty()) measureBending(side, seconds);
  if (only.empty()) measureFrames(objects, seconds);
  if (only.empty()) measureStates(seconds);
  printServer();
  hlDestroyContext(context);
  return 0;
}

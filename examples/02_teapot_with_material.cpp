// The teapot, each of its parts of another material: the body sticks, the lid is slippery, the handle is of rubber.
//
//   02_teapot_with_material [URL [SECONDS]]
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <hl/hl.hpp>
#include <string>
#include <thread>

#include "teapot_patches.h"  // Newell's 32 Bezier patches over 306 points, z up

namespace {

enum Part : HLuint { kBody = 1, kHandle, kSpout, kLid, kBottom };
constexpr std::array<const char*, 6> kNames{"nothing", "body", "handle", "spout", "lid", "bottom"};
constexpr int kSteps = 8;         // along each side of a patch
constexpr double kScale = 0.018;  // m for one of Newell's units

// Weights of a cubic's four points at t, and their derivatives.
std::array<double, 4> weights(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}
std::array<double, 4> slopes(double t) {
  const double s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

std::array<double, 3> blend(int patch, const std::array<double, 4>& u, const std::array<double, 4>& v) {
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < 16; ++i) {
    const auto& point = hl::kTeapotPoints[static_cast<std::size_t>(hl::kTeapotPatches[patch][i] - 1)];
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += u[i % 4] * v[i / 4] * point[axis];
  }
  return sum;
}

void vertexAt(int patch, double u, double v) {
  const auto a = blend(patch, slopes(u), weights(v)), b = blend(patch, weights(u), slopes(v));
  hlNormal3d(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  hlVertex3dv(blend(patch, weights(u), weights(v)).data());
}

void drawPart(Part part, int first_patch, int end_patch) {
  hlLoadName(part);
  for (int patch = first_patch; patch < end_patch; ++patch) {
    for (int row = 0; row < kSteps; ++row) {
      const hl::PrimitiveScope strip(HL_QUAD_STRIP);
      for (int column = 0; column <= kSteps; ++column) {
        for (const int side : {0, 1}) vertexAt(patch, 1.0 * column / kSteps, 1.0 * (row + side) / kSteps);
      }
    }
  }
}

void drawTeapot() {
  const hl::AttribScope materials;  // as they were, afterwards
  hlMaterialf(HL_STATIC_FRICTION, 0.5F);
  hlMaterialf(HL_DYNAMIC_FRICTION, 0.3F);
  drawPart(kBody, 0, 12);
  drawPart(kSpout, 16, 20);
  drawPart(kBottom, 28, 32);
  hlMaterialf(HL_STIFFNESS, 0.3F);
  drawPart(kHandle, 12, 16);
  hlMaterialf(HL_STIFFNESS, 1);
  hlMaterialf(HL_STATIC_FRICTION, 0);
  hlMaterialf(HL_DYNAMIC_FRICTION, 0);
  drawPart(kLid, 20, 28);
}

// Nobody holds the simulated device of inproc:, so the program moves its hand: over the lid to the spout, and on the
// other side of the knob back to the handle.
void moveHand(double t) { hlHandGoal3d(0.05 * std::sin(t), 0.035, 0.015 * std::cos(t)); }

}  // namespace

int main(int argc, char** argv) try {
  const std::string url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 15;
  hl::Context context(url);
  hlWorkspaced(0, 0.085, 0, 1);
  const HLuint teapot = hl::genObject();
  {
    const hl::ObjectScope definition(teapot);
    hlRotated(-90, 1, 0, 0);  // z up to y up
    hlScaled(kScale, kScale, kScale);
    drawTeapot();
  }
  hlCallObject(teapot);
  hlFinish();

  HLuint touched_before = 0;
  for (int i = 0; i < 60 * seconds; ++i) {
    if (url.starts_with("inproc:")) moveHand(i / 60.0);
    context.poll();
    const auto touched = static_cast<HLuint>(hl::get(HL_TOUCHED_NAME));
    if (touched != touched_before) std::printf("touching: %s\n", kNames[touched]);
    touched_before = touched;
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  hl::check();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "02_teapot_with_material: %s\n", error.what());
  return 2;
}

#include "device/force_dimension/figures.h"

#include <array>
#include <cmath>

namespace hl {

namespace {

// Forces, highest stiffness and damping, and radius of the workspace as CHAI3D assumes them
// (chai3d/chai3d, src/devices); resolutions from the vendors' sheets, unverified.
struct Figures {
  int type;
  double force_N, stiffness_N_m, damping_Ns_m, radius_m, resolution_m;
};

constexpr Figures omega(int type) { return {type, 12, 5000, 30, 0.075, 10e-6}; }
constexpr Figures sigma(int type) { return {type, 12, 4000, 30, 0.075, 10e-6}; }
constexpr Figures lambda(int type) { return {type, 12, 8000, 30, 0.1125, 10e-6}; }

constexpr std::array kFigures{
    Figures{60, 8, 3000, 20, 0.04, 60e-6},   // Falcon; the first counts for unknown ones
    Figures{63, 20, 5000, 30, 0.15, 20e-6},  // delta.3
    omega(33),
    omega(34),
    omega(35),
    omega(36),
    omega(37),
    sigma(104),
    sigma(105),
    lambda(108),
    lambda(109),
};

Figures figuresOf(int type) {
  for (const Figures& figures : kFigures) {
    if (figures.type == type) return figures;
  }
  return kFigures[0];
}

constexpr double kFastest_m_s = 3;  // a hand is slower
// Of the highest values, what a person meets at first.
constexpr double kStiffnessPart = 0.5, kDampingPart = 0.1;

}  // namespace

DeviceInfo forceDimensionFigures(int system_type) {
  const Figures figures = figuresOf(system_type);
  DeviceInfo info;
  info.workspace_max = Vec3::Constant(figures.radius_m / std::sqrt(3.0));  // the cube within the sphere
  info.workspace_min = -info.workspace_max;
  info.force_max_N = info.force_continuous_N = figures.force_N;
  info.stiffness_max_N_m = figures.stiffness_N_m;
  info.stiffness_N_m = kStiffnessPart * figures.stiffness_N_m;
  info.damping_Ns_m = kDampingPart * figures.damping_Ns_m;
  info.resolution_m = figures.resolution_m;
  info.velocity_max_m_s = kFastest_m_s;
  info.force_rate_max_N_s = figures.stiffness_N_m * kFastest_m_s;
  return info;
}

}  // namespace hl

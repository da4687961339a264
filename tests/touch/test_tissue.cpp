// Tissue that a client deforms, felt through the servo: the loop of force and frames is stable where the compliance
// told is large enough, and feels the tissue's own stiffness. E7 and E8: docs/tissue.md.
#include "tissue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/realtime_guard.h"

namespace hl {
namespace {

using test::Tissue;
using test::TissueClient;

constexpr double kK = 1000;

TissueClient clientOf(double tissue_N_m, double told_m_N, double frames_Hz = 30, int latency = 1) {
  TissueClient client;
  client.compliance_m_N = 1 / tissue_N_m;
  client.told_m_N = told_m_N;
  client.frames_Hz = frames_Hz;
  client.latency = latency;
  return client;
}

// Errors of the force at the ends of the frames after a small disturbance of the mesh.
std::vector<double> errorsAfterPush(const TissueClient& client, int frames) {
  constexpr double kForce_N = 1;
  Tissue tissue(client);
  tissue.startAt(kForce_N);
  std::vector<double> errors;
  tissue.push(1e-7);
  for (int i = 0; i < frames; ++i) errors.push_back(tissue.run(tissue.restFinger(kForce_N)) - kForce_N);
  return errors;
}

struct Row {
  double tissue_N_m;
  std::array<double, 5> factors;  // C = 0, (C_t - 1/K) / 2, .75 C_t, C_t, 2 C_t
};
const std::array<Row, 4> kTable{{{100, {-10, -1, -.29411764705882354, 0, .47619047619047616}},
                                 {200, {-5, -1, -.26315789473684209, 0, .45454545454545453}},
                                 {500, {-2, -1, -.2, 0, .4}},
                                 {3000, {-1. / 3, -1. / 3, -.066666666666666666, 0, .2}}}};

std::array<double, 5> toldOf(double tissue_N_m) {
  const double c = 1 / tissue_N_m;
  return {0, std::max(0.0, (c - 1 / kK) / 2), .75 * c, c, 2 * c};
}

// E7: f <- (delta - (C_t - C) f) / (1/K + C).
TEST(Tissue, TheErrorOfAFrameIsThatOfTheClosedForm) {
  for (const Row& row : kTable) {
    for (std::size_t i = 0; i < 5; ++i) {
      for (const double frames_Hz : {10., 30., 60.}) {
        const auto errors = errorsAfterPush(clientOf(row.tissue_N_m, toldOf(row.tissue_N_m)[i], frames_Hz), 3);
        EXPECT_GT(std::abs(errors[0]), 1e-6);
        EXPECT_NEAR(errors[1] / errors[0], row.factors[i], 1e-4 * (1 + std::abs(row.factors[i])))
            << row.tissue_N_m << " N/m, column " << i << ", " << frames_Hz << " Hz";
      }
    }
  }
}

// Whether a disturbance dies out.
bool isStable(const TissueClient& client) {
  const std::vector<double> errors = errorsAfterPush(client, 40 * client.latency);
  const auto largest = [](auto begin, auto end) {
    return std::abs(*std::max_element(begin, end, [](double a, double b) { return std::abs(a) < std::abs(b); }));
  };
  const auto third = static_cast<std::ptrdiff_t>(errors.size() / 3);
  return largest(errors.end() - third, errors.end()) < largest(errors.begin(), errors.begin() + third);
}

// E7: stable iff |C_t - C| < 1/K + C, at any rate and latency.
TEST(Tissue, TheBorderOfStabilityIsThatOfTheClosedForm) {
  for (const double tissue_N_m : {100., 200., 500.}) {
    for (const double frames_Hz : {10., 30., 60.}) {
      for (const int latency : {1, 2, 3}) {
        const double border_m_N = (1 / tissue_N_m - 1 / kK) / 2;
        EXPECT_TRUE(isStable(clientOf(tissue_N_m, 1.05 * border_m_N, frames_Hz, latency)))
            << tissue_N_m << " N/m, " << frames_Hz << " Hz, " << latency;
        EXPECT_FALSE(isStable(clientOf(tissue_N_m, .95 * border_m_N, frames_Hz, latency)))
            << tissue_N_m << " N/m, " << frames_Hz << " Hz, " << latency;
      }
    }
  }
}

// E7: what is told decides how fast it settles, never where.
TEST(Tissue, ItSettlesAtTheForceOfBothSpringsInSeries) {
  constexpr double kDepth_m = 0.005;
  const Vec3 finger(0, Tissue::kRadius_m - kDepth_m, 0);
  for (const double tissue_N_m : {100., 200., 500., 3000.}) {
    for (const double told : {.75, 1., 2.}) {
      for (const int latency : {1, 3}) {
        Tissue tissue(clientOf(tissue_N_m, told / tissue_N_m, 30, latency));
        for (int i = 0; i < 60 * latency; ++i) tissue.run(finger);
        const double expected_N = kK * kDepth_m / (1 + kK / tissue_N_m);
        EXPECT_NEAR(tissue.force_N().y() / expected_N, 1, 1e-9) << tissue_N_m << " " << told << " " << latency;
      }
    }
  }
}

// The difference of the largest and the smallest force of the last half second.
double flutter_N(Tissue& tissue, const Vec3& finger) {
  double least = 1e9, most = -1e9;
  for (double t = 0; t < 0.5; t += tissue.frame_s()) {
    tissue.run(finger);
    least = std::min(least, tissue.force_N().y());
    most = std::max(most, tissue.force_N().y());
  }
  return most - least;
}

// Tissue of 100 N/m under K = 1000 N/m at 30 Hz, three frames late. Without: `rigid` is an object whose client says
// that it does not yield.
TEST(Tissue, WhatFluttersWithoutComplianceIsStillWithIt) {
  constexpr double kTissue_N_m = 100, kDepth_m = 0.01;
  const Vec3 finger(0, Tissue::kRadius_m - kDepth_m, 0);
  const double expected_N = kK * kDepth_m / (1 + kK / kTissue_N_m);
  TissueClient rigid = clientOf(kTissue_N_m, 0, 30, 3), told = clientOf(kTissue_N_m, 1 / kTissue_N_m, 30, 3);
  TissueClient estimated = told;
  estimated.told_m_N.reset();
  for (TissueClient* client : {&rigid, &told, &estimated}) client->moving = 1;
  Tissue without(rigid), with(told), by_estimate(estimated);
  for (int i = 0; i < 90; ++i) {
    for (Tissue* tissue : {&without, &with, &by_estimate}) tissue->run(finger);
  }
  EXPECT_GT(flutter_N(without, finger), 2);
  EXPECT_LT(flutter_N(with, finger), 1e-9);
  EXPECT_LT(flutter_N(by_estimate, finger), 1e-3);
  EXPECT_NEAR(with.force_N().y(), expected_N, 1e-9);
  EXPECT_NEAR(by_estimate.force_N().y(), expected_N, 1e-3);
}

}  // namespace
}  // namespace hl

// Tissue that a client deforms, felt through the servo: the loop of force and frames is stable where the compliance
// given is large enough, and feels the tissue's own stiffness. E7 and E8: docs/tissue.md.
#include "tissue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "guard/realtime_guard.h"

namespace hl::test_tissue {
namespace {

using test::Tissue;
using test::TissueClient;

constexpr double kK = 1000;

TissueClient clientOf(double tissue_N_m, double given_m_N, double frames_Hz = 30, int latency = 1) {
  TissueClient client;
  client.compliance_m_N = 1 / tissue_N_m;
  client.given_m_N = given_m_N;
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

std::array<double, 5> givenOf(double tissue_N_m) {
  const double c = 1 / tissue_N_m;
  return {0, std::max(0.0, (c - 1 / kK) / 2), .75 * c, c, 2 * c};
}

// E7: f <- (delta - (C_t - C) f) / (1/K + C).
TEST(Tissue, TheErrorOfAFrameIsThatOfTheClosedForm) {
  for (const Row& row : kTable) {
    for (std::size_t i = 0; i < 5; ++i) {
      for (const double frames_Hz : {10., 30., 60.}) {
        const auto errors = errorsAfterPush(clientOf(row.tissue_N_m, givenOf(row.tissue_N_m)[i], frames_Hz), 3);
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

// E7: what is given decides how fast it settles, never where.
TEST(Tissue, ItSettlesAtTheForceOfBothSpringsInSeries) {
  constexpr double kDepth_m = 0.005;
  const Vec3 finger(0, Tissue::kRadius_m - kDepth_m, 0);
  for (const double tissue_N_m : {100., 200., 500., 3000.}) {
    for (const double given : {.75, 1., 2.}) {
      for (const int latency : {1, 3}) {
        Tissue tissue(clientOf(tissue_N_m, given / tissue_N_m, 30, latency));
        for (int i = 0; i < 60 * latency; ++i) tissue.run(finger);
        const double expected_N = kK * kDepth_m / (1 + kK / tissue_N_m);
        EXPECT_NEAR(tissue.force_N().y() / expected_N, 1, 1e-9) << tissue_N_m << " " << given << " " << latency;
      }
    }
  }
}

// A mesh that is pressed is a pit: the proxy rests on three of its faces, and the force of the mesh counts once. So it
// is stable and settles as a floor does, whether C is given or estimated.
TEST(Tissue, APitSettlesAsAFloorDoes) {
  constexpr double kSlope = 0.3, kTissue_N_m = 200, kDepth_m = 0.005;
  const double rest_m = Tissue::kRadius_m * std::hypot(1, kSlope);  // of its faces, that are inclined by it
  const double expected_N = kK * kDepth_m / (1 + kK / kTissue_N_m);
  TissueClient client = clientOf(kTissue_N_m, 0);
  client.surface = {};
  client.surface.positions.push_back(Vec3::Zero());
  for (std::uint32_t i = 0; i < 3; ++i) {
    const double angle = 2 * M_PI * i / 3;
    client.surface.positions.push_back(0.1 * Vec3(std::cos(angle), kSlope / 2, std::sin(angle)));
    client.surface.triangles.push_back({0, 1 + (i + 1) % 3, 1 + i});
  }
  for (const double given : {0.75, 1., 2.}) {
    client.given_m_N = given / kTissue_N_m;
    Tissue tissue(client);
    for (int i = 0; i < 60; ++i) tissue.run({0, rest_m - kDepth_m, 0});
    EXPECT_NEAR(tissue.force_N().y() / expected_N, 1, 1e-9) << given;
    tissue.push(1e-6);
    const double first_N = tissue.run({0, rest_m - kDepth_m, 0}) - expected_N;
    const double second_N = tissue.run({0, rest_m - kDepth_m, 0}) - expected_N;
    const double c = 1 / kTissue_N_m, factor = -(c - given * c) / (1 / kK + given * c);
    EXPECT_NEAR(second_N / first_N, factor, 1e-3) << given;
  }
  client.given_m_N.reset();
  client.moving = 1;
  Tissue tissue(client);
  for (int i = 0; i < 150; ++i) tissue.run({0, rest_m - kDepth_m * std::min(1.0, i / 15.0), 0});
  EXPECT_NEAR(tissue.force_N().y() / expected_N, 1, 0.02);
  EXPECT_GT(tissue.loop().state().estimate.compliance_m_N, (1 / kTissue_N_m - 1 / kK) / 2);
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
  TissueClient rigid = clientOf(kTissue_N_m, 0, 30, 3), given = clientOf(kTissue_N_m, 1 / kTissue_N_m, 30, 3);
  TissueClient estimated = given;
  estimated.given_m_N.reset();
  for (TissueClient* client : {&rigid, &given, &estimated}) client->moving = 1;
  Tissue without(rigid), with(given), by_estimate(estimated);
  for (int i = 0; i < 90; ++i) {
    for (Tissue* tissue : {&without, &with, &by_estimate}) tissue->run(finger);
  }
  EXPECT_GT(flutter_N(without, finger), 2);
  EXPECT_LT(flutter_N(with, finger), 1e-9);
  EXPECT_LT(flutter_N(by_estimate, finger), 1e-3);
  EXPECT_NEAR(with.force_N().y(), expected_N, 1e-9);
  EXPECT_NEAR(by_estimate.force_N().y(), expected_N, 1e-3);
}

// E8: a client of the Kelvin-Voigt model F = k x + b dx/dt, held at a constant depth delta from the first touch on. The
// servo's spring in series: F = (delta - x) / (1/K), so x goes to its end with the rate (K + k) / b. C = 0 is set: the
// damper keeps the mesh from following the force within a frame.
TEST(Tissue, ItCreepsAsTheModelOfKelvinAndVoigt) {
  constexpr double kTissue_N_m = 200, kDamper_Ns_m = 400, kDepth_m = 0.005, kFrames_Hz = 60;
  TissueClient client = clientOf(kTissue_N_m, 0, kFrames_Hz);
  auto x = std::make_shared<double>(0);
  client.depth = [x](double force_N, double frame_s) {  // exact for a constant force
    const double end_m = force_N / kTissue_N_m;
    return *x = end_m + (*x - end_m) * std::exp(-frame_s * kTissue_N_m / kDamper_Ns_m);
  };
  Tissue tissue(client);
  const Vec3 finger(0, Tissue::kRadius_m - kDepth_m, 0);
  tissue.step(finger);
  const double rate_per_s = (kK + kTissue_N_m) / kDamper_Ns_m;
  const double end_N = kDepth_m / (1 / kK + 1 / kTissue_N_m), begin_N = kK * kDepth_m;
  EXPECT_NEAR(tissue.force_N().y(), begin_N, 1e-9);
  for (int i = 1; i <= 90; ++i) {
    tissue.run(finger);
    const double t = i * tissue.frame_s(), expected_N = end_N + (begin_N - end_N) * std::exp(-rate_per_s * t);
    EXPECT_NEAR(tissue.force_N().y(), expected_N, 0.03 * (begin_N - end_N)) << t;
  }
  // In the logarithm the rate itself, of the frames: f <- f - K dx.
  const double a = tissue.run(finger) - end_N, b = tissue.run(finger) - end_N;
  const double per_frame = 1 - (1 - std::exp(-tissue.frame_s() * kTissue_N_m / kDamper_Ns_m)) * (1 + kK / kTissue_N_m);
  EXPECT_NEAR(b / a, per_frame, 1e-6);
}

// A load that is held: with C = C_t the creep of a free Kelvin-Voigt element, e^(-t k / b), seen at the mesh.
TEST(Tissue, UnderAConstantForceTheMeshCreepsWithItsOwnRate) {
  constexpr double kTissue_N_m = 200, kDamper_Ns_m = 50, kForce_N = 1;
  TissueClient client = clientOf(kTissue_N_m, 0, 60);
  auto x = std::make_shared<double>(0);
  client.depth = [x](double force_N, double frame_s) {
    const double end_m = force_N / kTissue_N_m;
    return *x = end_m + (*x - end_m) * std::exp(-frame_s * kTissue_N_m / kDamper_Ns_m);
  };
  Tissue tissue(client);
  const auto fingerFor = [&] { return Vec3(0, Tissue::kRadius_m - *x - kForce_N / kK, 0); };
  tissue.step(fingerFor());
  for (int i = 1; i <= 30; ++i) {
    tissue.runFollowing(fingerFor);
    const double expected_m =
        kForce_N / kTissue_N_m * (1 - std::exp(-i * tissue.frame_s() * kTissue_N_m / kDamper_Ns_m));
    EXPECT_NEAR(*x, expected_m, 1e-9) << i;
    EXPECT_NEAR(tissue.force_N().y(), kForce_N, 1e-9);
  }
}

// The finger leaves soft tissue faster than its frames come: the surface comes after it, so the force falls with the
// way, on the spring of both in series, and ends where the surface is without force. No step of it is a jump.
TEST(Tissue, TheForceOfAFingerThatLeavesFallsWithoutAJump) {
  constexpr double kTissue_N_m = 200, kForce_N = 1, kSpeed_m_s = 0.5;
  Tissue tissue(clientOf(kTissue_N_m, 1 / kTissue_N_m, 10));
  tissue.startAt(kForce_N);
  const double series_N_m = 1 / (1 / kK + 1 / kTissue_N_m);
  for (int ms = 1; ms <= 20; ++ms) {
    const double up_m = 1e-3 * ms * kSpeed_m_s;
    const Vec3 force_N = tissue.step(tissue.restFinger(kForce_N) + Vec3(0, up_m, 0));
    EXPECT_NEAR(force_N.y(), std::max(0.0, kForce_N - series_N_m * up_m), 1e-6) << ms << " ms";
  }
}

// The tangential compliance: a finger that sticks to tissue and is dragged along feels k_t in series with K.
TEST(Tissue, AStickingFingerDragsTheTissue) {
  constexpr double kTissue_N_m = 100, kDrag_m = 0.004;
  Tissue tissue(clientOf(kTissue_N_m, 1 / kTissue_N_m, 30, 2), kK, 2);
  const Vec3 pressed = Vec3(0, Tissue::kRadius_m - 0.011, 0);
  for (int i = 0; i < 40; ++i) tissue.run(pressed);
  EXPECT_NEAR(tissue.force_N().y(), 1, 1e-9);
  for (int i = 0; i < 60; ++i) tissue.run(pressed + Vec3(kDrag_m, 0, 0));
  EXPECT_NEAR(tissue.force_N().x(), -kDrag_m / (1 / kK + 1 / kTissue_N_m), 1e-9);
  EXPECT_NEAR(tissue.force_N().y(), 1, 1e-9);
}

// The material's compliance: a linear spring of 1 / C in series, for a mesh that does not move.
TEST(Tissue, TheComplianceOfAMaterialIsASpringInSeries) {
  for (const double stiffness : {1., 0.4}) {
    for (const double compliance_m_N : {0.001, 0.01}) {
      Model model = test::floorModel();
      model.materials[0].stiffness = stiffness;
      model.materials[0].compliance_m_N = compliance_m_N;
      const auto scene = makeSnapshot(std::move(model));
      ProxySettings settings;
      settings.radius = Tissue::kRadius_m;
      ProxyState state = startProxy(SceneAt(*scene, 0), settings, {0, 0.01, 0});
      for (int i = 1; i <= 20; ++i) {
        const Vec3 finger(0, Tissue::kRadius_m - 1e-4 * i, 0);
        const TickReport report = tick(state, SceneAt(*scene, i * test::kMilli_ns), settings, finger);
        const double expected_N = 1e-4 * i / (1 / (kK * stiffness) + compliance_m_N);
        EXPECT_NEAR(kK * (report.target - finger).y(), expected_N, 1e-9);
      }
    }
  }
}

// A mesh that moves by itself, as a heart does, does not follow the force: nothing is estimated, and it is felt as it
// is.
TEST(Tissue, AMeshThatMovesByItselfIsFeltAsItIs) {
  TissueClient heart;
  auto phase = std::make_shared<double>(0);
  heart.depth = [phase](double, double frame_s) {
    *phase += 2 * M_PI * 1.2 * frame_s;
    return 0.001 * (1 - std::cos(*phase));
  };
  Tissue tissue(heart);
  for (int i = 0; i < 120; ++i) {
    tissue.run({0, Tissue::kRadius_m - 0.003, 0});
    EXPECT_NEAR(tissue.force_N().y(), kK * (0.003 - 0.001 * (1 - std::cos(*phase))), 1e-9) << i;
  }
  EXPECT_EQ(tissue.loop().state().estimate.compliance_m_N, 0);
}

// The estimate of a press with a moving finger, for tissue of all stiffnesses and latencies: at least what stability
// needs, and the force of the tissue itself once the finger rests.
TEST(Tissue, TheEstimateIsStableForAllLatencies) {
  for (const double tissue_N_m : {50., 100., 200., 500., 3000.}) {
    for (const int latency : {1, 2, 3}) {
      TissueClient client = clientOf(tissue_N_m, 0, 30, latency);
      client.given_m_N.reset();
      client.moving = 1;
      Tissue tissue(client);
      const double depth_m = 1 / kK + 1 / tissue_N_m;  // 1 N
      for (int i = 0; i < 150; ++i) tissue.run({0, Tissue::kRadius_m - depth_m * std::min(1.0, i / 15.0), 0});
      EXPECT_NEAR(tissue.force_N().y(), 1, 0.02) << tissue_N_m << " N/m, " << latency;
      EXPECT_GT(tissue.loop().state().estimate.compliance_m_N, (1 / tissue_N_m - 1 / kK) / 2);
    }
  }
}

// The ledger: what the rules add is paid by the tank, whatever frames do.
TEST(Tissue, TheRulesAddNoMoreThanTheTankHolds) {
  for (const bool given : {true, false}) {
    TissueClient client = clientOf(100, 0.01, 30, 3);
    if (!given) client.given_m_N.reset();
    client.moving = 1;
    Tissue tissue(client);
    for (int i = 0; i < 200; ++i)
      tissue.run({0, Tissue::kRadius_m - 0.008 * (1 + std::sin(0.37 * i)) + 0.002 * std::sin(1.9 * i), 0});
    const Ledger& ledger = tissue.loop().state().ledger;
    EXPECT_GE(ledger.tank_J, 0);
    EXPECT_LE(ledger.injected_J, kTankStart_J + ledger.dissipated_J);
  }
}

TEST(Tissue, StepsAllocateNothing) {
  for (const bool given : {true, false}) {
    TissueClient client = clientOf(100, 0.01, 30, 1);
    if (!given) client.given_m_N.reset();
    Tissue tissue(client);
    for (int i = 0; i < 20; ++i) {
      tissue.frameOnly();
      const RealtimeGuard guard;
      for (int ms = 0; ms < 33; ++ms) tissue.step({0, Tissue::kRadius_m - 0.001 * (i % 7), 0});
    }
    EXPECT_NE(tissue.loop().state().estimate.key == 0, !given);
  }
}

}  // namespace
}  // namespace hl::test_tissue

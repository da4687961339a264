// Bezier and NURBS patches: on their surface, within the stated error, without cracks; and touched.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

#include "base/error.h"
#include "patches.h"
#include "proxy/proxy.h"
#include "scene/scene_model.h"
#include "surfaces/bezier_piece.h"
#include "surfaces/patch_mesh.h"
#include "teapot_patches.h"

namespace hl::test_patches {
namespace {

using Bits = std::array<double, 3>;
Bits bitsOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Sides of triangles that have no other beside them with the same bits, whichever way either turns.
std::size_t openSides(const PatchMesh& mesh) {
  std::map<std::pair<Bits, Bits>, int> sides;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Bits a = bitsOf(mesh.positions[t[k]]), b = bitsOf(mesh.positions[t[(k + 1) % 3]]);
      ++sides[{std::min(a, b), std::max(a, b)}];
    }
  }
  std::size_t open = 0;
  for (const auto& [side, count] : sides) open += count == 2 ? 0 : 1;
  return open;
}

PatchMesh meshOf(const std::vector<NurbsPatch>& patches, double error_m) {
  return meshPatches(planPatches(patches, error_m));
}

// Of the middles of triangles and of their sides, from a sphere around the origin.
double worstOf(const PatchMesh& mesh, double radius) {
  double worst = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    for (const Vec3& p : {Vec3((a + b + c) / 3), Vec3((a + b) / 2), Vec3((b + c) / 2), Vec3((c + a) / 2)})
      worst = std::max(worst, std::abs(p.norm() - radius));
  }
  return worst;
}

std::vector<NurbsPatch> octants(double radius) {
  std::vector<NurbsPatch> patches;
  for (int i = 0; i < 8; ++i)
    patches.push_back(test::octant(radius, Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return patches;
}

TEST(Patches, ARationalSphereIsClosedRoundAndWithinItsError) {
  constexpr double kR = 0.025;
  for (const double error_m : {1e-5, 2e-6}) {
    for (const auto& patches : {std::vector{test::spherePatch(kR)}, octants(kR)}) {
      const PatchMesh mesh = meshOf(patches, error_m);
      EXPECT_EQ(openSides(mesh), 0u);
      EXPECT_LE(mesh.error_m, error_m);
      const double worst = worstOf(mesh, kR);
      EXPECT_LE(worst, mesh.error_m);
      EXPECT_GT(worst, mesh.error_m / 20);  // the bound is not far from the truth
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        ASSERT_NEAR(mesh.positions[i].norm(), kR, 1e-15);
        ASSERT_LT(mesh.normals[i].cross(mesh.positions[i]).norm(), 2e-5 * kR) << mesh.positions[i].transpose();
      }
    }
  }
}

// Where a side has no length the normal is that of the surface.
TEST(Patches, NormalsAtAPoleAreThoseOfTheSphere) {
  const BezierPiece piece(bezierNetOf(test::octant(2, Vec3(1, 1, 1))), 0, 0);
  for (const double u : {0.0, 0.3, 1.0}) EXPECT_LT(std::abs(std::abs(piece.normal(u, 1).y()) - 1), 1e-9) << u;
}

NurbsPatch randomPatch(std::mt19937_64& random, std::uint32_t order_u, std::uint32_t order_v) {
  std::uniform_real_distribution<double> place(-1, 1), weight(0.3, 3);
  NurbsPatch patch;
  patch.order_u = order_u;
  patch.order_v = order_v;
  for (std::uint32_t i = 0; i < order_u * order_v; ++i)
    patch.points.push_back({{place(random), place(random), place(random)}, weight(random)});
  return patch;
}

// The largest distance from the surface to the mesh's own linear interpolation of it, on a fine grid of parameters.
TEST(Patches, RandomOnesAreWithinTheirError) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 20; ++round) {
    const NurbsPatch patch = randomPatch(random, 2 + round % 4, 2 + round / 5);
    const PatchPlan plan = planPatches({patch}, 0.02);
    const BezierPiece piece(plan.nets[0], 0, 0);
    const PatchPlan::Piece& cells = plan.pieces[0];
    double worst = 0;
    for (int k = 0; k < 2000; ++k) {
      std::uniform_real_distribution<double> part(0, 1);
      const double u = part(random) * cells.n_u, v = part(random) * cells.n_v;
      const double i = std::floor(u), j = std::floor(v), du = u - i, dv = v - j;
      const auto at = [&](double x, double y) { return piece.point(x / cells.n_u, y / cells.n_v); };
      const Vec3 a = at(i, j), b = at(i + 1, j + 1);
      const Vec3 flat = du > dv ? Vec3(a + (du - dv) * (at(i + 1, j) - a) + dv * (b - a))
                                : Vec3(a + (dv - du) * (at(i, j + 1) - a) + du * (b - a));
      worst = std::max(worst, (flat - at(u, v)).norm());
    }
    EXPECT_LE(worst, plan.error_m) << round;
    EXPECT_LE(plan.error_m, 0.02) << round;
  }
}

// Knots become pieces, which changes no point: de Boor's recursion is the judge.
TEST(Patches, PiecesOfANurbsSurfaceAreTheSameSurface) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-1, 1);
  NurbsPatch patch;
  patch.order_u = 4;
  patch.order_v = 2;
  patch.knots_u = {-1, 0, 0.5, 1, 2, 2, 3.5, 4, 6, 7};  // not clamped, one of them twice
  for (int i = 0; i < 12; ++i) patch.points.push_back({{place(random), place(random), place(random)}, 1 + 0.1 * i});
  const std::vector<double>& t = patch.knots_u;
  const std::function<double(std::size_t, std::size_t, double)> basis = [&](std::size_t i, std::size_t k, double x) {
    if (k == 1) return x >= t[i] && x < t[i + 1] ? 1.0 : 0.0;
    const double a = t[i + k - 1] - t[i], b = t[i + k] - t[i + 1];
    return (a > 0 ? (x - t[i]) / a * basis(i, k - 1, x) : 0) +
           (b > 0 ? (t[i + k] - x) / b * basis(i + 1, k - 1, x) : 0);
  };
  const BezierNet net = bezierNetOf(patch);
  ASSERT_EQ(net.piecesU(), 2u);
  for (int k = 0; k < 100; ++k) {
    const double part = (k + 0.5) / 100, x = 1 + part * 2.5;  // from the 4th knot to the 4th from the end
    const std::size_t piece = part < net.breaks_u[1] ? 0 : 1;
    const double u = (part - net.breaks_u[piece]) / (net.breaks_u[piece + 1] - net.breaks_u[piece]);
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        const ControlPoint& p = patch.points[j * 6 + i];
        sum += basis(i, 4, x) * (j == 0 ? 0.75 : 0.25) * p.weight * Eigen::Vector4d(p.at.x(), p.at.y(), p.at.z(), 1);
      }
    }
    EXPECT_LT((BezierPiece(net, piece, 0).point(u, 0.25) - sum.head<3>() / sum.w()).norm(), 1e-12) << k;
  }
}

// Two patches with one side in common, whichever side of each it is and whichever way it goes.
TEST(Patches, CommonSidesHaveTheSameBits) {
  std::mt19937_64 random(3);
  for (std::size_t of_first = 0; of_first < 4; ++of_first) {
    for (std::size_t of_second = 0; of_second < 4; ++of_second) {
      for (const bool backward : {false, true}) {
        const NurbsPatch first = randomPatch(random, 4, 4);
        NurbsPatch second = randomPatch(random, 4, 4);
        std::vector<ControlPoint> side = BezierPiece(bezierNetOf(first), 0, 0).side(of_first);
        if (backward) std::reverse(side.begin(), side.end());
        constexpr std::array<std::array<std::size_t, 2>, 4> kBeginAndStep{{{0, 1}, {3, 4}, {12, 1}, {0, 4}}};
        const auto [begin, step] = kBeginAndStep[of_second];
        for (std::size_t i = 0; i < 4; ++i) second.points[begin + i * step] = side[i];
        const std::size_t alone = openSides(meshOf({first}, 0.05)), both = openSides(meshOf({first, second}, 0.05));
        const PatchPlan plan = planPatches({first, second}, 0.05);
        const std::size_t cells = plan.pieces[0].n_u + plan.pieces[0].n_v + plan.pieces[1].n_u + plan.pieces[1].n_v;
        const std::size_t common = of_first % 2 == 0 ? plan.pieces[0].n_u : plan.pieces[0].n_v;
        EXPECT_EQ(both, 2 * cells - 2 * common) << alone << " " << of_first << " " << of_second << " " << backward;
      }
    }
  }
}

// Of Newell's 32 patches, the body alone: it is open at its rim, and nowhere else.
TEST(Patches, TheTeapotsBodyIsOpenAtItsRimAlone) {
  std::vector<NurbsPatch> body;
  for (std::size_t i = 0; i < 12; ++i) {
    NurbsPatch patch;
    for (const int number : kTeapotPatches[i]) {
      const auto& p = kTeapotPoints[static_cast<std::size_t>(number - 1)];
      patch.points.push_back({{0.03 * p[0], 0.03 * p[1], 0.03 * p[2]}});
    }
    body.push_back(patch);
  }
  const PatchPlan plan = planPatches(body, 2e-6);
  const std::size_t around = plan.pieces[0].n_u;
  EXPECT_EQ(openSides(meshPatches(plan)), 2 * 4 * around);  // above, and below, where the bottom begins
  EXPECT_GT(around, 10u);
}

Model modelOf(PatchMesh mesh) {
  Model model;
  model.positions = std::move(mesh.positions);
  model.normals = std::move(mesh.normals);
  model.triangles = std::move(mesh.triangles);
  return model;
}

TEST(PatchTouch, ABallRestsOneRadiusFromASphereAllRound) {
  const PatchMesh mesh = meshOf({test::spherePatch(0.025)}, 1e-5);
  const auto scene = makeSnapshot(SceneModel(modelOf(mesh)));
  ProxySettings settings;
  settings.radius = 1e-3;
  ProxyState state = startProxy(*scene, settings, Vec3(0, 0.03, 0));
  double worst = 0;
  for (int i = 0; i < 600; ++i) {
    const double turn = 0.05 * i, lift = 1.57 * std::cos(0.012 * i);
    tick(state, *scene, settings,
         0.024 * Vec3(std::cos(turn) * std::cos(lift), std::sin(lift), std::sin(turn) * std::cos(lift)));
    if (i > 20) worst = std::max(worst, std::abs(state.position.norm() - 0.026));
  }
  EXPECT_LE(worst, mesh.error_m);
}

TEST(PatchTouch, ABallInABoreRestsOneRadiusInside) {
  const PatchMesh mesh = meshOf({test::tube(5e-3, 0.02)}, 1e-6);
  const auto scene = makeSnapshot(SceneModel(modelOf(mesh)));
  ProxySettings settings;
  settings.radius = 1e-3;
  settings.work_cap = kNoWorkCap;
  for (int k = 0; k < 12; ++k) {
    ProxyState state = startProxy(*scene, settings, Vec3::Zero());
    const Vec3 finger = 9e-3 * Vec3(std::cos(0.5 * k + 0.1), 0, std::sin(0.5 * k + 0.1));
    for (int i = 0; i < 300; ++i) tick(state, *scene, settings, std::min(1.0, i / 200.0) * finger);
    const double from_axis = std::hypot(state.position.x(), state.position.z());
    EXPECT_NEAR(from_axis, 4e-3, 1.5 * mesh.error_m) << k;
    EXPECT_NEAR(1000 * (finger - state.position).norm(), 5, 2e-3) << k;  // N at 1000 N/m
  }
}

TEST(Patches, WhatMakesNoSurfaceIsRefusedWithOneLine) {
  const auto refusal = [](NurbsPatch patch) -> std::string {
    try {
      planPatches({std::move(patch)}, 1e-5);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto changed = [](const std::function<void(NurbsPatch&)>& change) {
    NurbsPatch patch = test::spherePatch(0.02);
    change(patch);
    return patch;
  };
  const double nan = std::nan("");
  for (const NurbsPatch& bad : {
           changed([](auto& p) { p.order_u = 1; }),
           changed([](auto& p) { p.order_v = 9; }),
           changed([](auto& p) { p.points.pop_back(); }),
           changed([](auto& p) { p.points[3].weight = 0; }),
           changed([](auto& p) { p.points[3].weight = 1e9; }),
           changed([&](auto& p) { p.points[3].weight = nan; }),
           changed([&](auto& p) { p.points[3].at.y() = nan; }),
           changed([&](auto& p) { p.knots_u[4] = nan; }),
           changed([](auto& p) { p.knots_u[4] = 7; }),
           changed([](auto& p) { p.knots_u.assign(12, 1); }),
           changed([](auto& p) {
             p.knots_u = {0, 1};
           }),
           changed([](auto& p) { p.knots_u = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3}; }),
           NurbsPatch{},
       })
    EXPECT_TRUE(refusal(bad).starts_with("patches[0]: ")) << refusal(bad);
  EXPECT_NE(refusal(changed([](auto& p) {
              for (ControlPoint& point : p.points) point.at *= 1e6;
            })).find("patchError"),
            std::string::npos);
}

}  // namespace
}  // namespace hl::test_patches

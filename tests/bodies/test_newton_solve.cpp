// Newton's method against sweeps without end, and its matrix against a dense one.
#include "bodies/newton_solve.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "bodies/row_solver.h"
#include "draws.h"

namespace hl::test_newton_solve {
namespace {

constexpr double kPeriod_s = 1e-3;

Block6 blockOfDraws(test::Draws& draws) {
  Block6 block;
  for (int i = 0; i < 36; ++i) block(i) = draws.between(-1, 1);
  return block;
}

// Bodies in a row, in a ring, and coupled at random; not symmetric, with a heavy diagonal.
TEST(BlockLu, SolvesWhatADenseMatrixSolves) {
  test::Draws draws(1);
  BlockLu sparse;
  for (int run = 0; run < 100; ++run) {
    const auto rows = static_cast<std::size_t>(draws.between(1, 20));
    const Eigen::Index size = 6 * static_cast<Eigen::Index>(rows);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
    sparse.begin(rows);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (j + 1 == i || draws.between(0, 1) < 0.1) pairs.emplace_back(i, j);
      }
    }
    for (const auto& [i, j] : pairs) sparse.couple(i, j);
    ASSERT_TRUE(sparse.order());
    sparse.clear();
    const auto add = [&](std::size_t i, std::size_t j, const Block6& block) {
      sparse.at(i, j) += block;
      dense.block<6, 6>(6 * static_cast<Eigen::Index>(i), 6 * static_cast<Eigen::Index>(j)) += block;
    };
    for (std::size_t i = 0; i < rows; ++i) add(i, i, blockOfDraws(draws) + 30 * Block6::Identity());
    for (const auto& [i, j] : pairs) {
      add(i, j, blockOfDraws(draws));
      add(j, i, blockOfDraws(draws));
    }
    for (std::size_t i = 0; i < rows; ++i) {
      sparse.right(i) = blockOfDraws(draws).col(0);
      right.segment<6>(6 * static_cast<Eigen::Index>(i)) = sparse.right(i);
    }
    ASSERT_TRUE(sparse.factor());
    sparse.solve();
    const Eigen::VectorXd expected = dense.partialPivLu().solve(right);
    for (std::size_t i = 0; i < rows; ++i)
      EXPECT_LT((sparse.right(i) - expected.segment<6>(6 * static_cast<Eigen::Index>(i))).norm(), 1e-12) << run;
  }
}

TEST(BlockLu, SaysThatASingularMatrixHasNoSolution) {
  BlockLu matrix;
  matrix.begin(2);
  matrix.couple(0, 1);
  ASSERT_TRUE(matrix.order());
  matrix.clear();
  matrix.at(0, 0) = Block6::Identity();
  EXPECT_FALSE(matrix.factor());
}

// Cubes on one another that move at random, each with four contacts beneath; the lowest on what is fixed.
struct Stack {
  Stack(test::Draws& draws, int cubes, double friction) {
    const double half = 0.02;
    for (int i = 0; i < cubes; ++i) {
      Node& node = nodes.emplace_back();
      const double mass_kg = std::pow(10, draws.between(-2, 0));
      node.velocity = draws.between(0, 0.1) * draws.direction() + Vec3(0, 0, -0.01);
      node.spin = draws.between(0, 1) * draws.direction();
      node.inverse_mass = 1 / mass_kg;
      node.inverse_inertia = Mat3::Identity() / (mass_kg * 2 * half * half / 3);
      node.centre = Vec3(0, 0, (2 * i + 1) * half);
      for (const double x : {-half, half}) {
        for (const double y : {-half, half}) addRow(i, Vec3(x, y, -half), half, friction);
      }
    }
    for (Row& row : rows) prepareRow(row, nodes);
  }
  void addRow(int cube, const Vec3& arm, double half, double friction) {
    Row& row = rows.emplace_back();
    row.a = cube;
    row.b = cube == 0 ? Row::kFixed : cube - 1;
    row.arm_a = arm;
    row.arm_b = arm + Vec3(0, 0, 2 * half);
    row.friction = friction;
  }
  // The largest change that a sweep makes, over the largest impulse.
  double missed() const {
    Stack copy = *this;
    RowSolverLimits limits;
    limits.sweeps = 1;
    return RowSolver(nodes.size()).solve(copy.rows, {}, copy.nodes, kPeriod_s, limits).change;
  }

  std::vector<Node> nodes;
  std::vector<Row> rows;
};

bool solvedByNewton(Stack& stack) {
  NewtonSolve newton(stack.nodes.size(), stack.rows.size());
  return newton.begin(stack.rows, stack.nodes) && newton.solve(stack.rows, stack.nodes, kPeriod_s, 50);
}

bool solvedBySweeps(Stack& stack) {
  RowSolverLimits limits;
  limits.sweeps = 200'000;
  return RowSolver(stack.nodes.size()).solve(stack.rows, {}, stack.nodes, kPeriod_s, limits).converged;
}

// A solution is one for both, whether found or not: of a solve that says so, a sweep changes nothing.
TEST(NewtonSolve, WhatItSaysIsSolvedIsSolvedForASweepToo) {
  test::Draws draws(2);
  int solved = 0;
  for (int run = 0; run < 500; ++run) {
    Stack stack(draws, 1 + run % 10, run % 5 * 0.25);
    if (!solvedByNewton(stack)) continue;
    ++solved;
    EXPECT_LT(stack.missed(), 1e-9) << run;
    for (const Row& row : stack.rows) {
      EXPECT_GE(row.pressed, 0);
      EXPECT_LE(row.dragged.norm(), row.friction * row.pressed * (1 + 1e-12) + 1e-18);
      EXPECT_LT(std::abs(row.normal.dot(row.dragged)), 1e-12 * (row.pressed + 1e-12));
    }
  }
  EXPECT_GT(solved, 350);
}

// Where the velocities have one solution: without friction.
TEST(NewtonSolve, FindsTheVelocitiesThatSweepsFind) {
  test::Draws draws(3);
  int compared = 0;
  for (int run = 0; run < 100; ++run) {
    Stack newton(draws, 1 + run % 5, 0);
    Stack sweeps = newton;
    if (!solvedByNewton(newton) || !solvedBySweeps(sweeps)) continue;
    ++compared;
    for (std::size_t i = 0; i < newton.nodes.size(); ++i) {
      EXPECT_LT((newton.nodes[i].velocity - sweeps.nodes[i].velocity).norm(), 1e-8) << run;
      EXPECT_LT((newton.nodes[i].spin - sweeps.nodes[i].spin).norm(), 1e-6) << run;
    }
  }
  EXPECT_GT(compared, 80);
}

// The velocities are those that the impulses make, whether it is solved or not.
TEST(NewtonSolve, ChangesVelocitiesByItsImpulsesAlone) {
  test::Draws draws(4);
  for (int run = 0; run < 200; ++run) {
    Stack stack(draws, 1 + run % 10, 0.6);
    std::vector<Node> expected = stack.nodes;
    for (const Row& row : stack.rows) applyImpulse(row, expected, -impulseOf(row));
    NewtonSolve newton(stack.nodes.size(), stack.rows.size());
    ASSERT_TRUE(newton.begin(stack.rows, stack.nodes));
    newton.solve(stack.rows, stack.nodes, kPeriod_s, run % 20);
    for (const Row& row : stack.rows) applyImpulse(row, expected, impulseOf(row));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_LT((stack.nodes[i].velocity - expected[i].velocity).norm(), 1e-10) << run;
      EXPECT_LT((stack.nodes[i].spin - expected[i].spin).norm(), 1e-8) << run;
    }
  }
}

// Gravity on a cube that slides: Coulomb's force against its velocity, to the last digits, in a few steps.
TEST(NewtonSolve, ASlidingCubeTakesFewSteps) {
  test::Draws draws(5);
  Stack stack(draws, 1, 0.3);
  stack.nodes[0].velocity = Vec3(0.5, 0, -0.01);
  stack.nodes[0].spin.setZero();
  const double mass_kg = 1 / stack.nodes[0].inverse_mass;
  NewtonSolve newton(1, 4);
  ASSERT_TRUE(newton.begin(stack.rows, stack.nodes));
  ASSERT_TRUE(newton.solve(stack.rows, stack.nodes, kPeriod_s, 20));
  EXPECT_LE(newton.steps(), 5);
  EXPECT_NEAR(stack.nodes[0].velocity.x(), 0.5 - 0.3 * 0.01, 1e-12);
  double pressed = 0;
  for (const Row& row : stack.rows) pressed += row.pressed;
  EXPECT_NEAR(pressed, 0.01 * mass_kg, 1e-12);
}

}  // namespace
}  // namespace hl::test_newton_solve

#include "bodies/row_solver.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// Velocity at the row's point for an impulse there: K with v = K P.
Mat3 mobility(const Row& row, std::span<const Node> nodes) {
  Mat3 sum = Mat3::Zero();
  const auto add = [&](int number, const Vec3& arm) {
    if (number == Row::kFixed) return;
    const Node& node = nodes[static_cast<std::size_t>(number)];
    Mat3 cross;
    cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    sum += node.inverse_mass * Mat3::Identity() + cross * node.inverse_inertia * cross.transpose();
  };
  add(row.a, row.arm_a);
  add(row.b, row.arm_b);
  return sum;
}

// The larger eigenvalue of K in the plane across the normal: trace and determinant of the projected matrix.
double largestAcross(const Mat3& mobility, const Vec3& normal) {
  const Mat3 plane = Mat3::Identity() - normal * normal.transpose();
  const Mat3 across = plane * mobility * plane;
  const double trace = across.trace();
  const double squares = (across * across).trace();  // sum of the squared eigenvalues
  const double spread = std::max(0.0, 2 * squares - trace * trace);
  return (trace + std::sqrt(spread)) / 2;
}

Vec3 acrossOf(const Vec3& v, const Vec3& normal) { return v - normal.dot(v) * normal; }

inline double demand(const Row& row, double period_s) {
  return std::max(row.least_velocity, -std::max(row.gap, 0.0) / period_s);
}

inline Vec3 velocityOf(const Row& row, std::span<const Node> nodes) {
  const Vec3 velocity = nodes[static_cast<std::size_t>(row.a)].velocityAt(row.arm_a);
  return velocity - (row.b == Row::kFixed ? row.carried : nodes[static_cast<std::size_t>(row.b)].velocityAt(row.arm_b));
}

inline void push(const Row& row, std::span<Node> nodes, const Vec3& impulse) {
  nodes[static_cast<std::size_t>(row.a)].push(impulse, row.arm_a);
  if (row.b != Row::kFixed) nodes[static_cast<std::size_t>(row.b)].push(-impulse, row.arm_b);
}

// Returns the change of the row's impulse.
Vec3 solveRow(Row& row, std::span<Node> nodes, double period_s) {
  Vec3 velocity = velocityOf(row, nodes);
  const double pressed =
      std::max(0.0, row.pressed + row.normal_step * (demand(row, period_s) - row.normal.dot(velocity)));
  Vec3 change = (pressed - row.pressed) * row.normal;
  velocity += (pressed - row.pressed) * row.response;
  row.pressed = pressed;
  if (row.friction > 0 || row.dragged != Vec3::Zero()) {
    const Vec3 wanted = row.dragged - row.drag_step * acrossOf(velocity, row.normal);
    const double most = row.friction * row.pressed;
    row.slipping = wanted.squaredNorm() > most * most;
    const Vec3 dragged = row.slipping ? limited(wanted, most) : wanted;
    change += dragged - row.dragged;
    row.dragged = dragged;
  }
  push(row, nodes, change);
  return change;
}

// Goes on along the last direction; `part` is |g|^2 over the last |g|^2. Where the changes grow, it begins anew.
void searchOn(std::span<Row> rows, std::span<Node> nodes, double part) {
  for (Row& row : rows) {
    if (part > 1) {
      row.search = row.change;
      continue;
    }
    const Vec3 way = part * row.search;
    row.pressed += row.normal.dot(way);
    row.dragged += acrossOf(way, row.normal);
    push(row, nodes, way);
    row.search = way + row.change;
  }
}

}  // namespace

RowSolverLimits limitsFor(std::size_t rows) {
  constexpr int kMostUpdates = 20'000;  // of single rows, some 2 ms
  constexpr int kMostSweeps = 1000, kLeastSweeps = 20;
  RowSolverLimits limits;
  limits.sweeps = std::clamp(kMostUpdates / static_cast<int>(rows + 1), kLeastSweeps, kMostSweeps);
  return limits;
}

double demandOf(const Row& row, double period_s) { return demand(row, period_s); }

Vec3 relativeVelocity(const Row& row, std::span<const Node> nodes) { return velocityOf(row, nodes); }

void applyImpulse(const Row& row, std::span<Node> nodes, const Vec3& impulse) { push(row, nodes, impulse); }

void prepareRow(Row& row, std::span<Node> nodes) {
  const Mat3 k = mobility(row, nodes);
  row.response = k * row.normal;
  row.normal_step = 1 / row.normal.dot(row.response);
  row.drag_step = 1 / largestAcross(k, row.normal);
  row.dragged = limited(acrossOf(row.dragged, row.normal), row.friction * row.pressed);
  applyImpulse(row, nodes, row.pressed * row.normal + row.dragged);
}

int solveRows(std::span<Row> rows, const JointPart& joints, std::span<Node> nodes, double period_s,
              const RowSolverLimits& limits) {
  double last_square = 0;
  for (Row& row : rows) row.search.setZero();
  for (int sweep = 1; sweep <= limits.sweeps; ++sweep) {
    double square = 0, changed = 0, largest = 0;
    if (!joints.numbers.empty()) joints.set->sweep(joints.numbers, nodes, period_s);
    for (const std::uint32_t number : joints.numbers) {
      const JointBlock& joint = joints.set->blocks[number];
      const BlockSweep swept = sweepOf(joint);
      square += swept.change;
      if (swept.change > joint.least_change * joint.least_change) changed = std::max(changed, swept.change);
      largest = std::max(largest, swept.largest);
    }
    for (Row& row : rows) {
      row.change = solveRow(row, nodes, period_s);
      square += row.change.squaredNorm();
      changed = std::max(changed, row.change.squaredNorm());
      largest = std::max(largest, row.pressed * row.pressed);
    }
    if (changed <= limits.done * limits.done * largest) return sweep;
    if (sweep == limits.sweeps) break;
    const double part = last_square > 0 ? square / last_square : 2;
    if (!joints.numbers.empty()) joints.set->searchOn(joints.numbers, nodes, part, part > 1);
    searchOn(rows, nodes, part);
    last_square = square;
  }
  return limits.sweeps;
}

}  // namespace hl

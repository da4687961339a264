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

// The larger eigenvalue of K in the plane across the normal.
double largestAcross(const Mat3& mobility, const Vec3& normal) {
  const Vec3 one = normal.unitOrthogonal(), other = normal.cross(one);
  const Vec3 of_one = mobility * one;
  const double xx = one.dot(of_one), xy = other.dot(of_one), yy = other.dot(mobility * other);
  return (xx + yy) / 2 + std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
}

Vec3 acrossOf(const Vec3& v, const Vec3& normal) { return v - normal.dot(v) * normal; }

// Goes on along the last direction of the search by `part` of it, |g|^2 over the last |g|^2: what that does to the
// nodes is done already. Where the changes grow, the search begins anew.
inline void searchOn(Row& row, double part) {
  if (part > 1) {
    row.search = row.change;
    return;
  }
  const Vec3 way = part * row.search;
  const double along = row.normal.dot(way);
  row.pressed += along;
  row.dragged += way - along * row.normal;
  row.search = way + row.change;
}

// Sets the change of the row's impulse.
inline void solveRow(Row& row, std::span<Node> nodes) {
  Vec3 velocity = relativeVelocity(row, nodes);
  const double pressed = std::max(0.0, row.pressed + row.normal_step * (row.demand - row.normal.dot(velocity)));
  const double more = pressed - row.pressed;
  row.pressed = pressed;
  row.change = more * row.normal;
  if (row.friction > 0 || row.dragged != Vec3::Zero()) {
    velocity += more * row.response;
    const Vec3 wanted = row.dragged - row.drag_step * acrossOf(velocity, row.normal);
    const double most = row.friction * row.pressed;
    row.slipping = wanted.squaredNorm() > most * most;
    const Vec3 dragged = row.slipping ? limited(wanted, most) : wanted;
    row.change += dragged - row.dragged;
    row.dragged = dragged;
  }
  applyImpulse(row, nodes, row.change);
}

}  // namespace

void prepareRow(Row& row, std::span<Node> nodes) {
  const Mat3 k = mobility(row, nodes);
  row.response = k * row.normal;
  row.normal_step = 1 / row.normal.dot(row.response);
  row.drag_step = 1 / largestAcross(k, row.normal);
  row.dragged = limited(acrossOf(row.dragged, row.normal), row.friction * row.pressed);
  applyImpulse(row, nodes, impulseOf(row));
}

RowSolver::RowSolver(std::size_t most_nodes) : is_met_(most_nodes) { motions_.reserve(most_nodes); }

void RowSolver::add(int node, std::span<const Node> nodes) {
  if (node == Row::kFixed) return;
  const auto i = static_cast<std::size_t>(node);
  if (is_met_[i] != 0 || nodes[i].inverse_mass == 0) return;
  is_met_[i] = 1;
  motions_.emplace_back().node = node;
}

void RowSolver::begin(std::span<Row> rows, std::span<const Node> nodes, double period_s) {
  for (const Motion& motion : motions_) is_met_[static_cast<std::size_t>(motion.node)] = 0;
  motions_.clear();
  for (Row& row : rows) {
    row.search.setZero();
    row.change.setZero();
    row.demand = demandOf(row, period_s);
    add(row.a, nodes);
    add(row.b, nodes);
  }
}

void RowSolver::sweepJoints(const JointPart& joints, std::span<Node> nodes, double period_s, Swept& swept) {
  joints.set->sweep(joints.numbers, nodes, period_s);
  for (const std::uint32_t number : joints.numbers) {
    const JointBlock& joint = joints.set->blocks[number];
    const BlockSweep one = sweepOf(joint);
    swept.sum += one.change;
    if (one.change > joint.least_change * joint.least_change) swept.changed = std::max(swept.changed, one.change);
    swept.largest = std::max(swept.largest, one.largest);
  }
}

// The search of the last sweep goes on in the same pass over the rows.
void RowSolver::sweepRows(std::span<Row> rows, std::span<Node> nodes, double part, Swept& swept) {
  for (Motion& motion : motions_) {
    const Node& node = nodes[static_cast<std::size_t>(motion.node)];
    motion.velocity = node.velocity;
    motion.spin = node.spin;
  }
  for (Row& row : rows) {
    hl::searchOn(row, part);
    solveRow(row, nodes);
    const double square = row.change.squaredNorm();
    swept.sum += square;
    swept.changed = std::max(swept.changed, square);
    swept.largest = std::max(swept.largest, row.pressed * row.pressed);
  }
}

// The motions of the nodes are linear in the impulses, so that the rows need not push again.
void RowSolver::searchOn(std::span<Node> nodes, double part) {
  for (Motion& motion : motions_) {
    Node& node = nodes[static_cast<std::size_t>(motion.node)];
    const Vec3 velocity = node.velocity - motion.velocity, spin = node.spin - motion.spin;
    if (part > 1) {
      motion.search_velocity = velocity;
      motion.search_spin = spin;
      continue;
    }
    motion.search_velocity *= part;
    motion.search_spin *= part;
    node.velocity += motion.search_velocity;
    node.spin += motion.search_spin;
    motion.search_velocity += velocity;
    motion.search_spin += spin;
  }
}

RowSolver::Report RowSolver::solve(std::span<Row> rows, const JointPart& joints, std::span<Node> nodes, double period_s,
                                   const RowSolverLimits& limits) {
  constexpr double kAnew = 2;
  begin(rows, nodes, period_s);
  Report report;
  double last_sum = 0, part = kAnew;
  while (report.sweeps < limits.sweeps) {
    Swept swept;
    if (!joints.numbers.empty()) sweepJoints(joints, nodes, period_s, swept);
    sweepRows(rows, nodes, part, swept);
    ++report.sweeps;
    report.change = swept.changed > 0 ? std::sqrt(swept.changed / swept.largest) : 0;
    report.converged = swept.changed <= limits.done * limits.done * swept.largest;
    if (report.converged || report.sweeps == limits.sweeps) break;
    part = last_sum > 0 ? swept.sum / last_sum : kAnew;
    searchOn(nodes, part);
    if (!joints.numbers.empty()) joints.set->searchOn(joints.numbers, nodes, part, part > 1);
    last_sum = swept.sum;
  }
  return report;
}

}  // namespace hl

#include "bodies/newton_solve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bodies/row_solver.h"

namespace hl {

namespace {

// The weight of what must not move over the mass of its row: asked for once, it leaves a part of the error of about one
// over it, times the square of the height of a stack.
constexpr double kWeight = 1e6;
constexpr int kTimesAsked = 2;
// Of the largest impulse: a solution, and what rounding may leave of one where steps do not come nearer any more.
constexpr double kDone = 1e-11, kDoneButForRounding = 1e-10;
// A part of a step is taken if it takes this part of it off the distance; it is halved so often to find one.
constexpr double kTakenOff = 0.1;
constexpr int kHalvings = 6;
// Where the first step comes no nearer, a solution takes so many.
constexpr int kStepsFromFar = 10;

// m [arm]x, and [arm]x m.
Mat3 rowsCrossed(const Mat3& m, const Vec3& arm) {
  Mat3 crossed;
  for (int i = 0; i < 3; ++i) crossed.row(i) = m.row(i).cross(arm);
  return crossed;
}
Mat3 columnsCrossed(const Vec3& arm, const Mat3& m) {
  Mat3 crossed;
  for (int i = 0; i < 3; ++i) crossed.col(i) = arm.cross(m.col(i));
  return crossed;
}

// Adds `sign` J_x' D J_y of a row, with J = (1, -[arm]x). `turned`: D [arm_y]x.
void addBlock(Block6& block, double sign, const Mat3& stiffness, const Mat3& turned, const Vec3& arm_x) {
  block.topLeftCorner<3, 3>() += sign * stiffness;
  block.topRightCorner<3, 3>() -= sign * turned;
  block.bottomLeftCorner<3, 3>() += sign * columnsCrossed(arm_x, stiffness);
  block.bottomRightCorner<3, 3>() -= sign * columnsCrossed(arm_x, turned);
}

double weightOf(const Row& row) { return kWeight * row.drag_step; }

}  // namespace

NewtonSolve::NewtonSolve(std::size_t most_nodes, std::size_t most_rows) : local_(most_nodes, -1) {
  motions_.reserve(most_nodes);
  contacts_.reserve(most_rows);
}

// A hand has no inertia, and does not turn: any will do.
void NewtonSolve::number(std::span<const Row> rows, std::span<const Node> nodes) {
  for (const Motion& motion : motions_) local_[static_cast<std::size_t>(motion.node)] = -1;
  motions_.clear();
  for (const Row& row : rows) {
    for (const int number : {row.a, row.b}) {
      if (number == Row::kFixed || moves(number)) continue;
      const Node& node = nodes[static_cast<std::size_t>(number)];
      if (node.inverse_mass == 0) continue;
      local_[static_cast<std::size_t>(number)] = static_cast<int>(motions_.size());
      Motion& motion = motions_.emplace_back();
      motion.node = number;
      motion.mass_kg = 1 / node.inverse_mass;
      if (node.inverse_inertia != Mat3::Zero()) motion.inertia = node.inverse_inertia.inverse();
    }
  }
}

bool NewtonSolve::begin(std::span<const Row> rows, std::span<const Node> nodes) {
  constexpr std::size_t kUpdatesOfRow = 4, kUpdatesOfProduct = 3;  // as measured
  number(rows, nodes);
  if (motions_.size() > BlockLu::kMaxRows) return false;
  matrix_.begin(motions_.size());
  for (const Row& row : rows) {
    if (moves(row.a) && moves(row.b)) matrix_.couple(localOf(row.a), localOf(row.b));
  }
  if (!matrix_.order()) return false;
  updates_of_step_ = static_cast<int>(kUpdatesOfRow * rows.size() + kUpdatesOfProduct * matrix_.products());
  return true;
}

void NewtonSolve::start(std::span<const Row> rows, std::span<const Node> nodes, double period_s) {
  for (Motion& motion : motions_) {
    const Node& node = nodes[static_cast<std::size_t>(motion.node)];
    motion.begun = {node.velocity, node.spin};
  }
  contacts_.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    contacts_[i].demand = demandOf(rows[i], period_s);
    contacts_[i].begun = contacts_[i].impulse = contacts_[i].best.impulse = impulseOf(rows[i]);
  }
  best_.sum_J = best_.largest = std::numeric_limits<double>::infinity();
}

NewtonSolve::Distance NewtonSolve::look(std::span<const Row> rows, std::span<const Node> nodes) {
  Distance distance;
  double changed = 0, largest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Contact& contact = contacts_[i];
    contact.place = placeInCone(rows[i], contact.impulse, relativeVelocity(rows[i], nodes), contact.demand);
    const double square = (contact.place.impulse - contact.impulse).squaredNorm();
    distance.sum_J += square / rows[i].drag_step;
    changed = std::max(changed, square);
    largest = std::max(largest, contact.place.impulse.squaredNorm());
  }
  if (changed > 0) distance.largest = std::sqrt(changed / largest);
  return distance;
}

// In their cones, without the change that the projection asks for: all rows at once would change too much.
void NewtonSolve::keepBest(std::span<const Row> rows, const Distance& distance) {
  if (!(distance.sum_J < best_.sum_J)) return;
  best_ = distance;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    contacts_[i].best = placeInCone(rows[i], contacts_[i].impulse, Vec3::Zero(), 0);
    contacts_[i].best.state = contacts_[i].place.state;
  }
}

void NewtonSolve::addRow(const Row& row, const Mat3& stiffness) {
  const bool a_moves = moves(row.a), b_moves = moves(row.b);
  const std::size_t a = a_moves ? localOf(row.a) : 0, b = b_moves ? localOf(row.b) : 0;
  const Mat3 turned_a = rowsCrossed(stiffness, row.arm_a), turned_b = rowsCrossed(stiffness, row.arm_b);
  if (a_moves) addBlock(matrix_.at(a, a), 1, stiffness, turned_a, row.arm_a);
  if (b_moves) addBlock(matrix_.at(b, b), 1, stiffness, turned_b, row.arm_b);
  if (!a_moves || !b_moves) return;
  addBlock(matrix_.at(a, b), -1, stiffness, turned_b, row.arm_a);
  addBlock(matrix_.at(b, a), -1, stiffness, turned_a, row.arm_b);
}

bool NewtonSolve::assemble(std::span<const Row> rows) {
  matrix_.clear();
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    Block6& block = matrix_.at(i, i);
    block.topLeftCorner<3, 3>() += motions_[i].mass_kg * Mat3::Identity();
    block.bottomRightCorner<3, 3>() += motions_[i].inertia;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (contacts_[i].place.state == ConePlace::State::kApart) continue;
    addRow(rows[i], impulsePerVelocity(rows[i], contacts_[i].place, weightOf(rows[i])));
  }
  return matrix_.factor();
}

// Adds J' impulse to the right sides.
void NewtonSolve::push(const Row& row, const Vec3& impulse) {
  const auto add = [&](int node, const Vec3& arm, const Vec3& one) {
    if (!moves(node)) return;
    Vec6& right = matrix_.right(localOf(node));
    right.head<3>() += one;
    right.tail<3>() += arm.cross(one);
  };
  add(row.a, row.arm_a, impulse);
  add(row.b, row.arm_b, -impulse);
}

// The right sides become the momenta that the bodies have gained, from their velocities: what a solve was rounded by is
// found by the next one.
void NewtonSolve::takeMomenta(std::span<const Node> nodes) {
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const Motion& motion = motions_[i];
    const Node& node = nodes[static_cast<std::size_t>(motion.node)];
    matrix_.right(i) << motion.mass_kg * (motion.begun.linear - node.velocity),
        motion.inertia * (motion.begun.spin - node.spin);
  }
}

// J dv
Vec3 NewtonSolve::moved(const Row& row) {
  const auto at = [&](int node, const Vec3& arm) -> Vec3 {
    if (!moves(node)) return Vec3::Zero();
    const Vec6& change = matrix_.right(localOf(node));
    return change.head<3>() + change.tail<3>().cross(arm);
  };
  return at(row.a, row.arm_a) - at(row.b, row.arm_b);
}

// A weight makes much of what a velocity was rounded by: what the change leaves is taken from what was missed before.
void NewtonSolve::ask(std::span<const Row> rows, std::span<Node> nodes) {
  const auto asked = [&](std::size_t i) {
    return impulseAskedFor(rows[i], contacts_[i].place, contacts_[i].impulse, contacts_[i].missed, weightOf(rows[i]));
  };
  takeMomenta(nodes);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    contacts_[i].missed = contacts_[i].demand * rows[i].normal - relativeVelocity(rows[i], nodes);
    push(rows[i], asked(i) - contacts_[i].begun);
  }
  matrix_.solve();
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    Node& node = nodes[static_cast<std::size_t>(motions_[i].node)];
    node.velocity += matrix_.right(i).head<3>();
    node.spin += matrix_.right(i).tail<3>();
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    contacts_[i].missed -= moved(rows[i]);
    contacts_[i].impulse = asked(i);
  }
}

void NewtonSolve::goWhole(std::span<const Row> rows, std::span<Node> nodes) {
  for (Motion& motion : motions_) {
    const Node& node = nodes[static_cast<std::size_t>(motion.node)];
    motion.last = {node.velocity, node.spin};
  }
  for (Contact& contact : contacts_) contact.last = contact.impulse;
  for (int time = 0; time < kTimesAsked; ++time) ask(rows, nodes);
  for (Motion& motion : motions_) {
    const Node& node = nodes[static_cast<std::size_t>(motion.node)];
    motion.change = {node.velocity - motion.last.linear, node.spin - motion.last.spin};
  }
  for (Contact& contact : contacts_) contact.change = contact.impulse - contact.last;
}

// Velocities are linear in the impulses: a part of both belongs together.
NewtonSolve::Distance NewtonSolve::goPart(std::span<const Row> rows, std::span<Node> nodes, double part) {
  for (const Motion& motion : motions_) {
    Node& node = nodes[static_cast<std::size_t>(motion.node)];
    node.velocity = motion.last.linear + part * motion.change.linear;
    node.spin = motion.last.spin + part * motion.change.spin;
  }
  for (Contact& contact : contacts_) contact.impulse = contact.last + part * contact.change;
  return look(rows, nodes);
}

// By the largest part that comes nearer, or the one that is nearest.
NewtonSolve::Distance NewtonSolve::goOn(std::span<const Row> rows, std::span<Node> nodes, const Distance& from) {
  goWhole(rows, nodes);
  double nearest_J = std::numeric_limits<double>::infinity(), nearest = 1, part = 1;
  for (int time = 0; time <= kHalvings; ++time, part /= 2) {
    const Distance distance = goPart(rows, nodes, part);
    if (distance.sum_J <= (1 - kTakenOff * part) * from.sum_J) return distance;
    if (!(distance.sum_J < nearest_J)) continue;
    nearest_J = distance.sum_J;
    nearest = part;
  }
  return goPart(rows, nodes, nearest);
}

// The best impulses are in their cones; the velocities that belong to them are made anew.
void NewtonSolve::finish(std::span<Row> rows, std::span<Node> nodes) {
  for (const Motion& motion : motions_) {
    Node& node = nodes[static_cast<std::size_t>(motion.node)];
    node.velocity = motion.begun.linear;
    node.spin = motion.begun.spin;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Row& row = rows[i];
    const Vec3& impulse = contacts_[i].best.impulse;
    applyImpulse(row, nodes, impulse - impulseOf(row));
    row.pressed = std::max(0.0, row.normal.dot(impulse));
    row.dragged = impulse - row.normal.dot(impulse) * row.normal;
    row.slipping = contacts_[i].best.state == ConePlace::State::kSlips;
  }
}

// From where the rows are. False: no nearer to a solution than they may be, or farther.
bool NewtonSolve::comeNear(std::span<Row> rows, std::span<Node> nodes, double period_s, int most_steps) {
  start(rows, nodes, period_s);
  const Distance begun = look(rows, nodes);
  Distance distance = begun, last;
  keepBest(rows, distance);
  while (steps_ < most_steps && distance.largest > kDone && assemble(rows)) {
    ++steps_;
    last = distance;
    distance = goOn(rows, nodes, last);
    keepBest(rows, distance);
    if (distance.sum_J > begun.sum_J && most_steps < kStepsFromFar) break;
    if (best_.largest <= kDoneButForRounding && distance.largest > last.largest / 2) break;
  }
  finish(rows, nodes);
  return best_.largest <= kDoneButForRounding;
}

// The velocities of a step are rounded by its matrix; those that its impulses make may be farther from a solution. A
// second solve, from there, is a small one.
bool NewtonSolve::solve(std::span<Row> rows, std::span<Node> nodes, double period_s, int most_steps) {
  constexpr int kSolves = 3;
  steps_ = 0;
  for (int time = 0; time < kSolves; ++time) {
    if (!comeNear(rows, nodes, period_s, most_steps)) return false;
    for (Contact& contact : contacts_) contact.impulse = contact.best.impulse;
    if (look(rows, nodes).largest <= kDoneButForRounding) return true;
  }
  return false;
}

}  // namespace hl

#include "bodies/direct_solve.h"

#include <algorithm>
#include <cmath>

#include "bodies/row_solver.h"

namespace hl {

namespace {

// The weight of a row over its own mass: each round leaves a part of the error of about one over it, times the square
// of the height of the stack.
constexpr double kWeight = 1e6;
constexpr int kMultiplierRounds = 3;

Mat3 crossOf(const Vec3& v) {
  Mat3 cross;
  cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return cross;
}

bool sticks(const Row& row) { return row.friction > 0 && !row.slipping; }
double weightOf(const Row& row) { return kWeight * row.drag_step; }

// w J_x' J_y of a row that sticks: J = (1, -[arm]x).
Block6 stickingBlock(const Vec3& arm_x, const Vec3& arm_y, double weight) {
  const Mat3 x = crossOf(arm_x), y = crossOf(arm_y);
  Block6 block;
  block.topLeftCorner<3, 3>() = weight * Mat3::Identity();
  block.topRightCorner<3, 3>() = -weight * y;
  block.bottomLeftCorner<3, 3>() = weight * x;
  block.bottomRightCorner<3, 3>() = -weight * x.lazyProduct(y);
  return block;
}

// The same of one along whose normal alone it is held.
Block6 normalBlock(const Row& row, const Vec3& arm_x, const Vec3& arm_y, double weight) {
  Vec6 x, y;
  x << row.normal, arm_x.cross(row.normal);
  y << row.normal, arm_y.cross(row.normal);
  return weight * x * y.transpose();
}

Block6 blockOf(const Row& row, const Vec3& arm_x, const Vec3& arm_y) {
  return sticks(row) ? stickingBlock(arm_x, arm_y, weightOf(row)) : normalBlock(row, arm_x, arm_y, weightOf(row));
}

// How far the row may go along `search`: until it pulls, or, where it sticks, until it slips.
double allowedPart(const Row& row) {
  const double along = row.normal.dot(row.search);
  const double pulls = along < 0 ? std::min(1.0, row.pressed / -along) : 1;
  if (!sticks(row)) return pulls;
  const Vec3 across = row.search - along * row.normal;
  const double square = row.friction * row.friction;
  const double a = across.squaredNorm() - square * along * along;
  const double b = row.dragged.dot(across) - square * row.pressed * along;
  const double c = std::min(0.0, row.dragged.squaredNorm() - square * row.pressed * row.pressed);
  if (a + 2 * b + c <= 0) return pulls;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return std::min(pulls, b > 0 ? -c / (b + root) : (root - b) / a);
}

Vec3 held(const Row& row, const Vec3& v) { return sticks(row) ? v : Vec3(row.normal.dot(v) * row.normal); }

}  // namespace

void DirectSolve::number(std::span<const Row> rows, std::span<const Node> nodes) {
  for (const int node : numbers_) local_[static_cast<std::size_t>(node)] = -1;
  numbers_.clear();
  for (const Row& row : rows) {
    for (const int node : {row.a, row.b}) {
      if (moves(node) || node == Row::kFixed || nodes[static_cast<std::size_t>(node)].inverse_mass == 0) continue;
      local_[static_cast<std::size_t>(node)] = static_cast<int>(numbers_.size());
      numbers_.push_back(node);
    }
  }
}

// A hand has no inertia, and does not turn.
void DirectSolve::addMasses(std::span<const Node> nodes) {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const Node& node = nodes[static_cast<std::size_t>(numbers_[i])];
    bool transposed = false;
    Block6& block = matrix_.at(i, i, transposed);
    block.topLeftCorner<3, 3>() += 1 / node.inverse_mass * Mat3::Identity();
    const bool turns = node.inverse_inertia != Mat3::Zero();
    block.bottomRightCorner<3, 3>() += turns ? Mat3(node.inverse_inertia.inverse()) : Mat3(Mat3::Identity());
  }
}

void DirectSolve::addRow(const Row& row) {
  if (!(row.pressed > 0)) return;
  bool transposed = false;
  const std::size_t a = localOf(row.a);
  matrix_.at(a, a, transposed) += blockOf(row, row.arm_a, row.arm_a);
  if (!moves(row.b)) return;
  const std::size_t b = localOf(row.b);
  matrix_.at(b, b, transposed) += blockOf(row, row.arm_b, row.arm_b);
  Block6& between = matrix_.at(a, b, transposed);
  between -= transposed ? blockOf(row, row.arm_b, row.arm_a) : blockOf(row, row.arm_a, row.arm_b);
}

bool DirectSolve::assemble(std::span<const Row> rows, std::span<const Node> nodes) {
  number(rows, nodes);
  if (numbers_.size() > BlockCholesky::kMostRows) return false;
  matrix_.begin(numbers_.size());
  for (const Row& row : rows) {
    if (row.pressed > 0 && moves(row.b)) matrix_.couple(localOf(row.a), localOf(row.b));
  }
  if (!matrix_.order()) return false;
  addMasses(nodes);
  for (const Row& row : rows) addRow(row);
  return matrix_.factor();
}

// Adds J' impulse to the right sides.
void DirectSolve::push(const Row& row, const Vec3& impulse) {
  Vec6& a = matrix_.right(localOf(row.a));
  a.head<3>() += impulse;
  a.tail<3>() += row.arm_a.cross(impulse);
  if (!moves(row.b)) return;
  Vec6& b = matrix_.right(localOf(row.b));
  b.head<3>() -= impulse;
  b.tail<3>() -= row.arm_b.cross(impulse);
}

// J dv
Vec3 DirectSolve::moved(const Row& row) {
  const Vec6& a = matrix_.right(localOf(row.a));
  Vec3 velocity = a.head<3>() + a.tail<3>().cross(row.arm_a);
  if (!moves(row.b)) return velocity;
  const Vec6& b = matrix_.right(localOf(row.b));
  return velocity - b.head<3>() - b.tail<3>().cross(row.arm_b);
}

void DirectSolve::improve(std::span<Row> rows, std::span<Node> nodes, double period_s) {
  const auto residual = [&](const Row& row) {
    return held(row, demandOf(row, period_s) * row.normal - relativeVelocity(row, nodes));
  };
  for (std::size_t i = 0; i < numbers_.size(); ++i) matrix_.right(i).setZero();
  for (Row& row : rows) {
    if (row.pressed <= 0) continue;
    row.change = residual(row);
    push(row, weightOf(row) * row.change);
  }
  matrix_.solve();
  for (Row& row : rows) {
    if (row.pressed <= 0) continue;
    row.change = weightOf(row) * (row.change - held(row, moved(row)));
    row.search += row.change;
  }
  for (const Row& row : rows) {
    if (row.pressed > 0) applyImpulse(row, nodes, row.change);
  }
}

// What the rows began with must not change in between: it says which rows are held. So the sums go into `search`. The
// objective falls all the way to the solution, so that a part of it is safe as well.
bool DirectSolve::solve(std::span<Row> rows, std::span<Node> nodes, double period_s) {
  if (!assemble(rows, nodes)) return false;
  for (Row& row : rows) row.search.setZero();
  for (int round = 0; round < kMultiplierRounds; ++round) improve(rows, nodes, period_s);
  double part = 1;
  for (const Row& row : rows) part = std::min(part, allowedPart(row));
  for (Row& row : rows) {
    if (part < 1) applyImpulse(row, nodes, (part - 1) * row.search);
    const double along = row.normal.dot(row.search);
    row.dragged += part * (row.search - along * row.normal);
    row.pressed = std::max(0.0, row.pressed + part * along);
  }
  return true;
}

}  // namespace hl

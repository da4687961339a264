#include "bodies/block_cholesky.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// In place, the lower triangle; what is above it stays. False: not positive definite.
bool factorBlock(Block6& a) {
  for (int j = 0; j < 6; ++j) {
    double diagonal = a(j, j);
    for (int k = 0; k < j; ++k) diagonal -= a(j, k) * a(j, k);
    if (!(diagonal > 0)) return false;
    a(j, j) = std::sqrt(diagonal);
    for (int i = j + 1; i < 6; ++i) {
      double sum = a(i, j);
      for (int k = 0; k < j; ++k) sum -= a(i, k) * a(j, k);
      a(i, j) = sum / a(j, j);
    }
  }
  return true;
}

// x L' = b, row by row of b.
void divideByTransposed(const Block6& l, Block6& b) {
  for (int j = 0; j < 6; ++j) {
    for (int k = 0; k < j; ++k) b.col(j) -= l(j, k) * b.col(k);
    b.col(j) /= l(j, j);
  }
}

void solveLower(const Block6& l, Vec6& x) {
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= l(i, k) * x[k];
    x[i] /= l(i, i);
  }
}

void solveUpper(const Block6& l, Vec6& x) {
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) x[i] -= l(k, i) * x[k];
    x[i] /= l(i, i);
  }
}

}  // namespace

void BlockCholesky::begin(std::size_t rows) {
  rows_ = rows;
  used_ = 0;
  for (std::size_t i = 0; i < rows; ++i) neighbours_[i].reset();
}

bool BlockCholesky::order() {
  Rows left;
  for (std::size_t i = 0; i < rows_; ++i) left[i] = true;
  for (std::size_t turn = 0; turn < rows_; ++turn) {
    std::size_t best = 0, least = kMostRows + 1;
    for (std::size_t i = 0; i < rows_; ++i) {
      const std::size_t degree = left[i] ? neighbours_[i].count() : kMostRows + 1;
      if (degree < least) {
        least = degree;
        best = i;
      }
    }
    left[best] = false;
    turn_[best] = static_cast<std::uint8_t>(turn);
    row_at_[turn] = static_cast<std::uint8_t>(best);
    neighbours_[best] &= left;
    for (std::size_t i = 0; i < rows_; ++i) {
      if (!neighbours_[best][i]) continue;
      neighbours_[i] |= neighbours_[best];
      neighbours_[i][i] = neighbours_[i][best] = false;
    }
  }
  for (std::size_t turn = 0; turn < rows_; ++turn) {
    auto& places = place_[turn];
    begin_[turn] = static_cast<std::uint16_t>(used_);
    for (std::size_t later = turn; later < rows_; ++later) {
      if (later != turn && !neighbours_[row_at_[turn]][row_at_[later]]) continue;
      if (used_ == kMostBlocks) return false;
      places[later] = static_cast<std::int16_t>(used_);
      later_[used_] = static_cast<std::uint8_t>(later);
      blocks_[used_++].setZero();
    }
  }
  begin_[rows_] = static_cast<std::uint16_t>(used_);
  return true;
}

// Stored at (earlier, later) is the block of the lower triangle, row `later`, column `earlier`.
Block6& BlockCholesky::at(std::size_t i, std::size_t j, bool& transposed) {
  const std::size_t turn_i = turn_[i], turn_j = turn_[j];
  transposed = turn_i < turn_j;
  return blocks_[static_cast<std::size_t>(place_[std::min(turn_i, turn_j)][std::max(turn_i, turn_j)])];
}

bool BlockCholesky::factor() {
  for (std::size_t turn = 0; turn < rows_; ++turn) {
    const std::size_t begin = begin_[turn], end = begin_[turn + 1];
    if (!factorBlock(blocks_[begin])) return false;
    for (std::size_t i = begin + 1; i < end; ++i) divideByTransposed(blocks_[begin], blocks_[i]);
    for (std::size_t j = begin + 1; j < end; ++j) {
      for (std::size_t i = j; i < end; ++i) {
        Block6& into = blocks_[static_cast<std::size_t>(place_[later_[j]][later_[i]])];
        into.noalias() -= blocks_[i].lazyProduct(blocks_[j].transpose());
      }
    }
  }
  return true;
}

void BlockCholesky::solve() {
  for (std::size_t turn = 0; turn < rows_; ++turn) {
    Vec6& here = right_[row_at_[turn]];
    solveLower(blocks_[begin_[turn]], here);
    for (std::size_t i = begin_[turn] + 1u; i < begin_[turn + 1]; ++i)
      right_[row_at_[later_[i]]].noalias() -= blocks_[i] * here;
  }
  for (std::size_t turn = rows_; turn-- > 0;) {
    Vec6& here = right_[row_at_[turn]];
    for (std::size_t i = begin_[turn] + 1u; i < begin_[turn + 1]; ++i)
      here.noalias() -= blocks_[i].transpose() * right_[row_at_[later_[i]]];
    solveUpper(blocks_[begin_[turn]], here);
  }
}

}  // namespace hl

// Block LU: solves A x = b for a matrix of 6 x 6 blocks, most of which are 0: one row of blocks for each body of an
// island, two blocks for each pair that touches. Bodies with few neighbours are eliminated first (minimum degree: A.
// George, J. W. H. Liu, The evolution of the minimum degree ordering algorithm, SIAM Review 31, 1989), so that a stack
// of n bodies costs n steps. Friction makes A unsymmetric, but for large coefficients it stays near a positive definite
// one: there is a choice of the pivot within a block of the diagonal alone.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace hl {

using Block6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Room for any matrix that it takes; RT-safe but for the constructor. By one thread at a time.
class BlockLu {
 public:
  static constexpr std::size_t kMaxRows = 128, kMaxBlocks = 1024;

  BlockLu() : lower_(kMaxBlocks), upper_(kMaxBlocks), right_(kMaxRows) {}
  /// A matrix of so many rows of blocks, <= kMaxRows.
  void begin(std::size_t rows);
  /// Sets that the blocks (i, j) and (j, i) are not 0.
  void couple(std::size_t i, std::size_t j) { neighbours_[i][j] = neighbours_[j][i] = true; }
  /// After all couple(): places for all blocks. False: there is no room for them.
  bool order();
  /// After order(): how many products of blocks factor() takes.
  std::size_t products() const { return products_; }
  /// Makes all blocks 0, for other values in the same places.
  void clear();
  /// Block (i, j) of A, to add to.
  Block6& at(std::size_t i, std::size_t j);
  /// After all blocks are added. False: there is no solution.
  bool factor();
  Vec6& right(std::size_t i) { return right_[i]; }
  /// The right sides become the solution.
  void solve();

 private:
  using Rows = std::bitset<kMaxRows>;
  void chooseTurns();

  std::size_t rows_ = 0, used_ = 0, products_ = 0;
  std::array<Rows, kMaxRows> neighbours_;                            // then: those eliminated later
  std::array<std::uint8_t, kMaxRows> turn_{};                        // when a row is eliminated
  std::array<std::uint8_t, kMaxRows> row_at_{};                      // which row then is
  std::vector<std::array<std::int16_t, kMaxRows>> place_{kMaxRows};  // [earlier][later] of a block
  // Of rows that are eliminated later, the column of the earlier one, and its row; on the diagonal in `lower_` alone,
  // which then holds the inverse.
  std::vector<Block6> lower_, upper_;
  std::vector<Vec6> right_;
  // The later neighbours of the row that is eliminated at a turn, in the order of their turns; first itself.
  std::array<std::uint16_t, kMaxRows + 1> begin_{};
  std::array<std::uint8_t, kMaxBlocks> later_{};
};

}  // namespace hl

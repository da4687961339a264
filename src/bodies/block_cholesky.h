// Block Cholesky: solves A x = b for a symmetric positive definite matrix of 6 x 6 blocks, most of which are 0: one row
// of blocks for each body of an island, one block for each pair that touches. Bodies with few neighbours are eliminated
// first (minimum degree: A. George, J. W. H. Liu, The evolution of the minimum degree ordering algorithm, SIAM Review
// 31, 1989), so that a stack of n bodies costs n steps.
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
class BlockCholesky {
 public:
  static constexpr std::size_t kMostRows = 128, kMostBlocks = 1024;

  BlockCholesky() : blocks_(kMostBlocks), right_(kMostRows) {}
  /// A matrix of 0, of so many rows of blocks, <= kMostRows.
  void begin(std::size_t rows);
  /// Tells that block (i, j) is not 0.
  void couple(std::size_t i, std::size_t j) { neighbours_[i][j] = neighbours_[j][i] = true; }
  /// After all couple(): places for all blocks. False: there is no room for them.
  bool order();
  /// Block (i, j) of A, to add to; transposed tells that it is stored as that of (j, i).
  Block6& at(std::size_t i, std::size_t j, bool& transposed);
  /// After all blocks are added. False: A is not positive definite.
  bool factor();
  Vec6& right(std::size_t i) { return right_[i]; }
  /// The right sides become the solution.
  void solve();

 private:
  using Rows = std::bitset<kMostRows>;
  std::size_t rows_ = 0, used_ = 0;
  std::array<Rows, kMostRows> neighbours_;                             // then: those eliminated later
  std::array<std::uint8_t, kMostRows> turn_{};                         // when a row is eliminated
  std::array<std::uint8_t, kMostRows> row_at_{};                       // which row then is
  std::vector<std::array<std::int16_t, kMostRows>> place_{kMostRows};  // [earlier][later] of a block; -1: none
  std::vector<Block6> blocks_;
  std::vector<Vec6> right_;
  // The later neighbours of the row that is eliminated at a turn, in the order of their turns.
  std::array<std::uint16_t, kMostRows + 1> begin_{};
  std::array<std::uint8_t, kMostBlocks> later_{};
};

}  // namespace hl

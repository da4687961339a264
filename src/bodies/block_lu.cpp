#include "bodies/block_lu.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// Gauss and Jordan's elimination in place, with the largest of a column as its pivot. False: there is no inverse.
bool invert(Block6& a) {
  std::array<int, 6> pivots{};
  for (int k = 0; k < 6; ++k) {
    int pivot = k;
    for (int i = k + 1; i < 6; ++i) {
      if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    }
    pivots[static_cast<std::size_t>(k)] = pivot;
    if (pivot != k) a.row(k).swap(a.row(pivot));
    if (!(std::abs(a(k, k)) > 0)) return false;
    const double inverse = 1 / a(k, k);
    a(k, k) = 1;
    a.row(k) *= inverse;
    for (int i = 0; i < 6; ++i) {
      if (i == k) continue;
      const double part = a(i, k);
      a(i, k) = 0;
      a.row(i) -= part * a.row(k);
    }
  }
  for (int k = 6; k-- > 0;) {
    const int pivot = pivots[static_cast<std::size_t>(k)];
    if (pivot != k) a.col(k).swap(a.col(pivot));
  }
  return a.allFinite();
}

}  // namespace

void BlockLu::begin(std::size_t rows) {
  rows_ = rows;
  used_ = products_ = 0;
  for (std::size_t i = 0; i < rows; ++i) neighbours_[i].reset();
}

void BlockLu::chooseTurns() {
  constexpr std::size_t kEliminated = kMaxRows + 1;
  std::array<std::size_t, kMaxRows> degrees;
  for (std::size_t i = 0; i < rows_; ++i) degrees[i] = neighbours_[i].count();
  for (std::size_t turn = 0; turn < rows_; ++turn) {
    const auto best =
        static_cast<std::size_t>(std::min_element(degrees.begin(), degrees.begin() + rows_) - degrees.begin());
    const std::size_t least = degrees[best];
    degrees[best] = kEliminated;
    turn_[best] = static_cast<std::uint8_t>(turn);
    row_at_[turn] = static_cast<std::uint8_t>(best);
    products_ += least * (least + 1);
    for (std::size_t i = 0; i < rows_; ++i) {
      if (!neighbours_[best][i]) continue;
      neighbours_[i] |= neighbours_[best];
      neighbours_[i][i] = neighbours_[i][best] = false;
      degrees[i] = neighbours_[i].count();
    }
  }
}

bool BlockLu::order() {
  chooseTurns();
  for (std::size_t turn = 0; turn < rows_; ++turn) {
    auto& places = place_[turn];
    begin_[turn] = static_cast<std::uint16_t>(used_);
    for (std::size_t later = turn; later < rows_; ++later) {
      if (later != turn && !neighbours_[row_at_[turn]][row_at_[later]]) continue;
      if (used_ == kMaxBlocks) return false;
      places[later] = static_cast<std::int16_t>(used_);
      later_[used_++] = static_cast<std::uint8_t>(later);
    }
  }
  begin_[rows_] = static_cast<std::uint16_t>(used_);
  return true;
}

void BlockLu::clear() {
  for (std::size_t i = 0; i < used_; ++i) {
    lower_[i].setZero();
    upper_[i].setZero();
  }
}

Block6& BlockLu::at(std::size_t i, std::size_t j) {
  const std::size_t turn_i = turn_[i], turn_j = turn_[j];
  const auto place = static_cast<std::size_t>(place_[std::min(turn_i, turn_j)][std::max(turn_i, turn_j)]);
  return turn_i < turn_j ? upper_[place] : lower_[place];
}

bool BlockLu::factor() {
  for (std::size_t turn = 0; turn < rows_; ++turn) {
    const std::size_t begin = begin_[turn], end = begin_[turn + 1];
    if (!invert(lower_[begin])) return false;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const Block6 column = lower_[i];
      lower_[i].noalias() = column.lazyProduct(lower_[begin]);
    }
    for (std::size_t j = begin + 1; j < end; ++j) {
      for (std::size_t i = begin + 1; i < end; ++i) {
        const bool is_lower = later_[i] >= later_[j];
        const auto place =
            static_cast<std::size_t>(is_lower ? place_[later_[j]][later_[i]] : place_[later_[i]][later_[j]]);
        Block6& into = is_lower ? lower_[place] : upper_[place];
        into.noalias() -= lower_[i].lazyProduct(upper_[j]);
      }
    }
  }
  return true;
}

void BlockLu::solve() {
  for (std::size_t turn = 0; turn < rows_; ++turn) {
    const Vec6& here = right_[row_at_[turn]];
    for (std::size_t i = begin_[turn] + 1u; i < begin_[turn + 1]; ++i)
      right_[row_at_[later_[i]]].noalias() -= lower_[i] * here;
  }
  for (std::size_t turn = rows_; turn-- > 0;) {
    Vec6 here = right_[row_at_[turn]];
    for (std::size_t i = begin_[turn] + 1u; i < begin_[turn + 1]; ++i)
      here.noalias() -= upper_[i] * right_[row_at_[later_[i]]];
    right_[row_at_[turn]].noalias() = lower_[begin_[turn]] * here;
  }
}

}  // namespace hl

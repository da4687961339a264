// Force table: a force over a position, for detents, buttons and rocker switches. Linear between its rows, constant
// beyond them. Its energy is that of a potential: what a body gets on the way down is what it gave on the way up.
#pragma once

#include <vector>

namespace hl {

/// Positions are in m and forces in N; in rad and N m for a hinge.
struct ForceTable {
  std::vector<double> position;  ///< strictly increasing
  std::vector<double> force;     ///< one for each position

  bool empty() const { return position.empty(); }
  bool operator==(const ForceTable&) const = default;
  /// RT-safe, as all below; 0 if the table is empty.
  double at(double position_now) const;
  /// The mean over all positions between the two; the force there if they are one.
  double meanBetween(double from, double to) const;
  /// J; 0 at the first position.
  double energy_J(double position_now) const;
  double lowest() const;
  double highest() const;
};

}  // namespace hl

// Matter: what the values of a volume feel like, as the transfer function of a renderer says what they look like: a
// table from value to stiffness and strength of a surface, and to what hinders a motion through the matter.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/matter_force.h"

namespace hl {

/// One row of the table.
struct MatterRow {
  double value = 0;                    ///< of the volume
  std::optional<double> stiffness{};   ///< 0..1, of a surface at this value; absent: as its material says
  std::optional<double> strength_N{};  ///< of a surface at this value (proxy/piercing.h); absent: as its material says
  MatterForce force{};
};

/// Linear between two rows, constant beyond the first and the last. Where one of the two has a strength of 0, which is
/// never pierced, the strength is that of the nearer row. Immutable.
class MatterTable {
 public:
  static constexpr std::size_t kMaxRows = 256;

  MatterTable() = default;
  /// Throws hl::Error for more than kMaxRows, for values that do not rise, for numbers beyond their ranges, and where
  /// some rows say a number of a surface and others do not.
  explicit MatterTable(std::vector<MatterRow> rows);

  const std::vector<MatterRow>& rows() const { return rows_; }
  /// Whether any value hinders a motion.
  bool resists() const;
  /// As all rows of an empty table have nothing, so has this. RT-safe.
  MatterRow at(double value) const;

 private:
  std::vector<MatterRow> rows_;
};

}  // namespace hl

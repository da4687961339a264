#include "base/ledger.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hl {

double Ledger::budget_J(LedgerMode mode) const {
  switch (mode) {
    case LedgerMode::kTank:
      return tank_J;
    case LedgerMode::kReport:
      return std::numeric_limits<double>::infinity();
    case LedgerMode::kStrict:
      break;
  }
  return 0;
}

void Ledger::book(double net_J, bool refill) {
  if (net_J > 0) {
    injected_J += net_J;
    tank_J = std::max(0.0, tank_J - net_J);
  } else {
    dissipated_J -= net_J;
    if (refill) this->refill(-net_J);
  }
}

void Ledger::refill(double joules) { tank_J = std::min(kTankFull_J, tank_J + joules); }

double partWithin(const Vec3& e, const Vec3& way, double allowance) {
  const double a = way.squaredNorm();
  const double b = way.dot(e);
  if (a + 2 * b <= allowance) return 1;
  return std::clamp((std::sqrt(b * b + a * allowance) - b) / a, 0.0, 1.0);
}

}  // namespace hl

#include "scene/force_table.h"

#include <algorithm>
#include <cstddef>

namespace hl {

double ForceTable::at(double q) const {
  if (empty()) return 0;
  if (q <= position.front()) return force.front();
  if (q >= position.back()) return force.back();
  const auto above = std::upper_bound(position.begin(), position.end(), q);
  const auto i = static_cast<std::size_t>(above - position.begin());
  const double part = (q - position[i - 1]) / (position[i] - position[i - 1]);
  return force[i - 1] + part * (force[i] - force[i - 1]);
}

double ForceTable::meanBetween(double from, double to) const {
  const double low = std::min(from, to), high = std::max(from, to);
  if (!(high > low)) return at(low);
  double sum = 0, last = low, force_last = at(low);
  for (auto next = std::upper_bound(position.begin(), position.end(), low); last < high; ++next) {
    const double end = next == position.end() ? high : std::min(high, *next);
    const double force_end = at(end);
    sum += (end - last) * (force_last + force_end) / 2;
    last = end;
    force_last = force_end;
  }
  return sum / (high - low);
}

double ForceTable::energy_J(double q) const {
  return empty() ? 0 : -meanBetween(position.front(), q) * (q - position.front());
}

double ForceTable::lowest() const { return empty() ? 0 : *std::min_element(force.begin(), force.end()); }
double ForceTable::highest() const { return empty() ? 0 : *std::max_element(force.begin(), force.end()); }

}  // namespace hl

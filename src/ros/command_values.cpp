#include "ros/command_values.h"

#include <algorithm>

namespace hl {

Vec3 cutTo(const Vec3& force_N, double most_N) {
  const double largest_N = force_N.cwiseAbs().maxCoeff();
  if (largest_N <= 0) return force_N;
  const Vec3 direction = (force_N / largest_N).normalized();
  return direction * std::min(most_N, largest_N * (force_N / largest_N).norm());
}

std::int64_t waited_ns(const HandCommand& command, std::int64_t now_ns, std::int64_t most_ns) {
  const bool from_later = command.arrived_ns > now_ns;
  return from_later || command.arrived_ns < now_ns - most_ns ? most_ns : now_ns - command.arrived_ns;
}

}  // namespace hl

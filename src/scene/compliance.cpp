#include "scene/compliance.h"

namespace hl {

Compliance Compliance::between(const Compliance& from, const Compliance& to, double part) {
  const double rest = 1 - part;
  return {rest * from.normal_m_N + part * to.normal_m_N, rest * from.tangential_m_N + part * to.tangential_m_N,
          rest * from.computed_for_N + part * to.computed_for_N};
}

Compliance ComplianceMotion::Way::at(std::int64_t time_ns) const {
  if (time_ns >= end_ns) return to;
  if (time_ns <= begin_ns) return from;
  return Compliance::between(from, to,
                             static_cast<double>(time_ns - begin_ns) / static_cast<double>(end_ns - begin_ns));
}

// A change that has not begun by then is dropped, as a mesh's transition is (MeshMotion::then).
ComplianceMotion ComplianceMotion::then(const Compliance& to, std::int64_t begin_ns, std::int64_t end_ns) const {
  const bool begun = last_.begin_ns < begin_ns;
  return {begun ? last_ : earlier_, {at(begin_ns), to, begin_ns, end_ns}};
}

}  // namespace hl

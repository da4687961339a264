// What a step or a tick gives, as values that are compared bit for bit, and as text.
#pragma once

#include <fmt/core.h>

#include <string>

#include "base/vec.h"
#include "control/servo.h"
#include "io/value_messages.h"

namespace hl {

inline std::string textOf(const Vec3& v) { return fmt::format("({:.17g}, {:.17g}, {:.17g})", v.x(), v.y(), v.z()); }

template <typename... Parts>
Values partsOf(const Parts&... parts) {
  Values values;
  ValueWriter writer(values);
  (writer(parts), ...);
  return values;
}

inline Values partsOf(const ServoOutput& out) { return partsOf(out.force_N, out.safety, out.fault); }
inline Values partsOf(const ServoTarget& t) {
  return partsOf(t.proxy_D, t.time_ns, t.valid, t.stiffness, t.paid_J, t.field_N, t.field_drag_Ns_m);
}

}  // namespace hl

// Vectors of the calls, as messages of proto/hl.proto have them.
#pragma once

#include <hl.pb.h>

namespace hl::client {

inline void setVec(proto::Vec3& out, double x, double y, double z) {
  out.set_x(x);
  out.set_y(y);
  out.set_z(z);
}

}  // namespace hl::client

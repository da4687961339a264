#include "io/vec_messages.h"

namespace hl {

void toProto(const Vec3& v, proto::Vec3& out) {
  out.set_x(v.x());
  out.set_y(v.y());
  out.set_z(v.z());
}

Vec3 vecOf(const proto::Vec3& in) { return {in.x(), in.y(), in.z()}; }

void toProto(const Eigen::Quaterniond& turned, proto::Rotation& out) {
  out.set_x(turned.x());
  out.set_y(turned.y());
  out.set_z(turned.z());
  out.set_w(turned.w());
}

Eigen::Quaterniond turnOf(const proto::Rotation& in) { return {in.w(), in.x(), in.y(), in.z()}; }

}  // namespace hl

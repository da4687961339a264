// Vectors and orientations as messages of proto/hl.proto.
#pragma once

#include <hl.pb.h>

#include <Eigen/Geometry>

#include "base/vec.h"

namespace hl {

void toProto(const Vec3& v, proto::Vec3& out);
Vec3 vecOf(const proto::Vec3& in);
void toProto(const Eigen::Quaterniond& turned, proto::Rotation& out);
Eigen::Quaterniond turnOf(const proto::Rotation& in);

}  // namespace hl

// Snaps: the places of an object that is defined that hold the proxy.
#include <hl/hl.h>

#include <cmath>
#include <utility>

#include "client/call.h"

using hl::client::call;
using hl::client::Fault;

namespace {

// As servers take them.
constexpr double kLeastOfSnap = 1e-9, kMostOfSnap = 1e9, kFarthestSnap_m = 1e6;
constexpr std::size_t kMostSnapsOfObject = 64;
constexpr int kMostCornersOfSnap = 256;

std::vector<hl::proto::Snap>& snapsOf(HLcontext& context) {
  if (!context.definition) throw Fault(HL_INVALID_OPERATION, "only between hlNewObject and hlEndObject");
  return context.definition->items.snaps();
}

void addPoint(const HLcontext& context, const Eigen::Vector3d& point, hl::proto::Snap& snap) {
  const Eigen::Vector3d placed = (context.draw.modelview.top() * point.homogeneous()).head<3>();
  if (!(placed.array().abs() <= kFarthestSnap_m).all())
    throw Fault(HL_INVALID_VALUE, "a snap must be within 1e6 m of the origin");
  snap.mutable_points()->Add(placed.data(), placed.data() + 3);
}

hl::proto::Snap snapOf(double capture, double release) {
  for (const double value : {capture, release}) {
    if (!(value >= kLeastOfSnap && value <= kMostOfSnap))
      throw Fault(HL_INVALID_VALUE, "capture and release must be between 1e-9 and 1e9");
  }
  hl::proto::Snap snap;
  snap.set_capture(capture);
  snap.set_release_n(release);
  return snap;
}

void add(HLcontext& context, hl::proto::Snap snap) {
  std::vector<hl::proto::Snap>& snaps = snapsOf(context);
  if (snaps.size() == kMostSnapsOfObject) throw Fault(HL_INVALID_VALUE, "an object has at most 64 snaps");
  snaps.push_back(std::move(snap));
}

// As a normal is placed: by the inverse transpose.
void setNormal(const HLcontext& context, const Eigen::Vector3d& normal, hl::proto::Snap& snap) {
  const Eigen::Matrix3d linear = context.draw.modelview.top().topLeftCorner<3, 3>();
  const Eigen::Vector3d placed = (linear.inverse().transpose() * normal.stableNormalized()).stableNormalized();
  if (!normal.allFinite() || !placed.allFinite() || !(placed.norm() > 0))
    throw Fault(HL_INVALID_VALUE, "the normal must not be 0");
  snap.mutable_normal()->set_x(placed.x());
  snap.mutable_normal()->set_y(placed.y());
  snap.mutable_normal()->set_z(placed.z());
}

}  // namespace

void hlSnapPoint3d(HLdouble x, HLdouble y, HLdouble z, HLdouble capture, HLdouble release) {
  call(__func__, [&](HLcontext& context) {
    snapsOf(context);
    hl::proto::Snap snap = snapOf(capture, release);
    addPoint(context, {x, y, z}, snap);
    add(context, std::move(snap));
  });
}

void hlSnapLineTo3d(HLdouble x, HLdouble y, HLdouble z) {
  call(__func__, [&](HLcontext& context) {
    std::vector<hl::proto::Snap>& snaps = snapsOf(context);
    if (snaps.empty() || snaps.back().has_normal())
      throw Fault(HL_INVALID_OPERATION, "the definition must have a point or line, by hlSnapPoint3d, as its last snap");
    if (snaps.back().points_size() >= 3 * kMostCornersOfSnap)
      throw Fault(HL_INVALID_VALUE, "a snap has at most 256 points");
    addPoint(context, {x, y, z}, snaps.back());
  });
}

void hlSnapPlane3d(HLdouble x, HLdouble y, HLdouble z, HLdouble nx, HLdouble ny, HLdouble nz, HLdouble capture,
                   HLdouble release) {
  call(__func__, [&](HLcontext& context) {
    snapsOf(context);
    hl::proto::Snap snap = snapOf(capture, release);
    addPoint(context, {x, y, z}, snap);
    setNormal(context, {nx, ny, nz}, snap);
    add(context, std::move(snap));
  });
}

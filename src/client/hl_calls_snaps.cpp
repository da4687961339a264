// Snaps: the places of an object that is defined that hold the proxy.
#include <hl/hl.h>

#include <utility>

#include "client/places.h"

using hl::client::call;

namespace {

hl::proto::Snap snapOf(double capture, double release) {
  hl::client::requireWithin("the capture", capture, hl::client::kMinOfPlace, hl::client::kMaxOfPlace);
  hl::client::requireWithin("the release", release, hl::client::kMinOfPlace, hl::client::kMaxOfPlace);
  hl::proto::Snap snap;
  snap.set_capture(capture);
  snap.set_release_n(release);
  return snap;
}

}  // namespace

void hlSnapPoint3d(HLdouble x, HLdouble y, HLdouble z, HLdouble capture, HLdouble release) {
  call(__func__, [&](HLcontext& context) {
    std::vector<hl::proto::Snap>& snaps = hl::client::openDefinition(context).snaps();
    hl::proto::Snap snap = snapOf(capture, release);
    hl::client::addPoint(context, {x, y, z}, snap);
    hl::client::append(std::move(snap), snaps);
  });
}

void hlSnapLineTo3d(HLdouble x, HLdouble y, HLdouble z) {
  call(__func__, [&](HLcontext& context) {
    hl::client::leadOn(context, {x, y, z}, hl::client::openDefinition(context).snaps());
  });
}

void hlSnapPlane3d(HLdouble x, HLdouble y, HLdouble z, HLdouble nx, HLdouble ny, HLdouble nz, HLdouble capture,
                   HLdouble release) {
  call(__func__, [&](HLcontext& context) {
    std::vector<hl::proto::Snap>& snaps = hl::client::openDefinition(context).snaps();
    hl::proto::Snap snap = snapOf(capture, release);
    hl::client::addPoint(context, {x, y, z}, snap);
    hl::client::setNormal(context, {nx, ny, nz}, snap);
    hl::client::append(std::move(snap), snaps);
  });
}

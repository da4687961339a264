// Fields: the forces of an object that is defined on the hand.
#include <hl/hl.h>

#include <utility>

#include "client/places.h"

using hl::client::call;
using hl::client::Fault;

namespace {

// As servers take them.
constexpr double kMinOfField = 1e-9, kStrongest_N = 1000, kStiffest_N_m = 1e6, kMaxDamping_Ns_m = 100;

// Of all kinds but the constant force, which needs a direction.
void setStrength(HLenum kind, double strength, hl::proto::Field& field) {
  switch (kind) {
    case HL_FIELD_MAGNET:
      hl::client::requireWithin("the strength", strength, kMinOfField, kStrongest_N);
      return field.set_force_n(strength);
    case HL_FIELD_SPRING:
      hl::client::requireWithin("the strength", strength, kMinOfField, kStiffest_N_m);
      return field.set_stiffness_n_m(strength);
    case HL_FIELD_DRAG:
      hl::client::requireWithin("the strength", strength, kMinOfField, kMaxDamping_Ns_m);
      return field.set_damping_ns_m(strength);
    default:
      throw Fault(HL_INVALID_ENUM, "the kind must be HL_FIELD_MAGNET, HL_FIELD_SPRING or HL_FIELD_DRAG");
  }
}

hl::proto::Field fieldOf(HLenum kind, double reach) {
  hl::client::requireWithin("the reach", reach, hl::client::kMinOfPlace, hl::client::kMaxOfPlace);
  hl::proto::Field field;
  field.set_kind(static_cast<hl::proto::FieldKind>(kind - HL_FIELD_MAGNET));
  field.set_reach(reach);
  return field;
}

}  // namespace

void hlFieldPoint3d(HLenum kind, HLdouble x, HLdouble y, HLdouble z, HLdouble reach, HLdouble strength) {
  call(__func__, [&](HLcontext& context) {
    std::vector<hl::proto::Field>& fields = hl::client::openDefinition(context).fields();
    hl::proto::Field field = fieldOf(kind, reach);
    setStrength(kind, strength, field);
    hl::client::addPoint(context, {x, y, z}, field);
    hl::client::append(std::move(field), fields);
  });
}

void hlFieldLineTo3d(HLdouble x, HLdouble y, HLdouble z) {
  call(__func__, [&](HLcontext& context) {
    hl::client::leadOn(context, {x, y, z}, hl::client::openDefinition(context).fields());
  });
}

void hlFieldPlane3d(HLenum kind, HLdouble x, HLdouble y, HLdouble z, HLdouble nx, HLdouble ny, HLdouble nz,
                    HLdouble reach, HLdouble strength) {
  call(__func__, [&](HLcontext& context) {
    std::vector<hl::proto::Field>& fields = hl::client::openDefinition(context).fields();
    hl::proto::Field field = fieldOf(kind, reach);
    setStrength(kind, strength, field);
    hl::client::addPoint(context, {x, y, z}, field);
    hl::client::setNormal(context, {nx, ny, nz}, field);
    hl::client::append(std::move(field), fields);
  });
}

void hlFieldForce3d(HLdouble x, HLdouble y, HLdouble z, HLdouble reach, HLdouble fx, HLdouble fy, HLdouble fz) {
  call(__func__, [&](HLcontext& context) {
    std::vector<hl::proto::Field>& fields = hl::client::openDefinition(context).fields();
    hl::proto::Field field = fieldOf(HL_FIELD_CONSTANT, reach);
    const Eigen::Vector3d force(fx, fy, fz);
    hl::client::requireWithin("the force", force.stableNorm(), kMinOfField, kStrongest_N);
    field.set_force_n(force.stableNorm());
    hl::client::addPoint(context, {x, y, z}, field);
    hl::client::setUnit(hl::client::linearOf(context), force, *field.mutable_direction());
    hl::client::append(std::move(field), fields);
  });
}

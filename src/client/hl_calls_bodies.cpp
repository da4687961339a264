// Rigid bodies: what an object that is defined is as one, what is done to bodies, and where they are.
#include <hl/hl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "client/call.h"
#include "client/queries.h"
#include "client/vec_messages.h"
#include "geometry/primitive.h"
#include "scene/body_spec.h"

using hl::client::call;
using hl::client::callOr;
using hl::client::Fault;
using hl::client::requireFinite;
using hl::client::requirePointer;
using hl::client::requireWithin;
using hl::client::When;
namespace limits = hl::body_limits;

namespace {

constexpr std::string_view kVelocity = "each coordinate of the velocity", kSpin = "each coordinate of the spin",
                           kPlace = "each coordinate of the place";

void setWithin(std::string_view what, hl::proto::Vec3& out, double x, double y, double z, double most) {
  for (const double value : {x, y, z}) requireWithin(what, value, -most, most);
  hl::client::setVec(out, x, y, z);
}

// Lets `fill` set the body of the open definition.
template <typename Fill>
void setBody(const char* function, Fill fill) {
  call(function, [&](HLcontext& context) {
    if (!context.definition) throw Fault(HL_INVALID_OPERATION, "only between hlNewObject and hlEndObject");
    hl::proto::Body body = context.definition->items.body().value_or(hl::proto::Body{});
    fill(body);
    context.definition->items.setBody(body);
  });
}

void setNumber(hl::proto::Body& body, HLenum parameter, double value) {
  switch (parameter) {
    case HL_BODY_MASS:
      requireWithin("HL_BODY_MASS", value, limits::kMinMass_kg, limits::kMaxMass_kg);
      return body.set_mass_kg(value);
    case HL_BODY_DENSITY:
      requireWithin("HL_BODY_DENSITY", value, limits::kMinDensity_kg_m3, limits::kMaxDensity_kg_m3);
      return body.set_density_kg_m3(value);
    case HL_BODY_STATIC_FRICTION:
      requireWithin("HL_BODY_STATIC_FRICTION", value, 0, limits::kMaxFriction);
      return body.set_static_friction(value);
    case HL_BODY_DYNAMIC_FRICTION:
      requireWithin("HL_BODY_DYNAMIC_FRICTION", value, 0, limits::kMaxFriction);
      return body.set_dynamic_friction(value);
    case HL_BODY_RESTITUTION:
      requireWithin("HL_BODY_RESTITUTION", value, 0, 1);
      return body.set_restitution(value);
    default:
      throw Fault(HL_INVALID_ENUM,
                  "the parameter must be HL_BODY_MASS .. HL_BODY_DYNAMIC_FRICTION or HL_BODY_RESTITUTION");
  }
}

void setWhole(hl::proto::Body& body, HLenum parameter, HLint value) {
  const auto named = static_cast<HLenum>(value);
  if (parameter == HL_BODY_FIXED && value != HL_FALSE && value != HL_TRUE)
    throw Fault(HL_INVALID_VALUE, "HL_BODY_FIXED must be HL_TRUE or HL_FALSE");
  if (parameter == HL_BODY_FIXED) return body.set_fixed(value == HL_TRUE);
  if (parameter != HL_BODY_SHAPE) throw Fault(HL_INVALID_ENUM, "the parameter must be HL_BODY_SHAPE or HL_BODY_FIXED");
  if (named < HL_BODY_HULL || named > HL_BODY_PARTS)
    throw Fault(HL_INVALID_ENUM, "the shape must be HL_BODY_HULL .. HL_BODY_PARTS");
  body.set_shape(static_cast<hl::proto::BodyShape>(named - HL_BODY_HULL));
}

// Lets `fill` write what is done to the bodies of an object, and sends it.
template <typename Fill>
void act(const char* function, HLuint object, Fill fill) {
  call(function, [&](HLcontext& context) {
    if (!context.objects.isDefined(object)) throw Fault(HL_INVALID_VALUE, "the object is not defined");
    hl::proto::BodyCommand command;
    command.set_object(object);
    if (context.draw.attributes.now.name != 0) command.set_name(context.draw.attributes.now.name);
    fill(command);
    context.conversation.send(std::move(command));
  });
}

std::array<double, 16> matrixOf(const HLbody& body) {
  const auto& [x, y, z, w] = body.rotation;
  return {1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),     0,  //
          2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),     0,  //
          2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y), 0,  //
          body.position[0],        body.position[1],        body.position[2],        1};
}

void write(const HLbody& body, HLenum name, HLdouble* values) {
  switch (name) {
    case HL_BODY_POSITION:
      std::copy_n(body.position, 3, values);
      return;
    case HL_BODY_ROTATION:
      std::copy_n(body.rotation, 4, values);
      return;
    case HL_BODY_VELOCITY:
      std::copy_n(body.velocity, 3, values);
      return;
    case HL_BODY_SPIN:
      std::copy_n(body.spin, 3, values);
      return;
    default:
      std::copy_n(matrixOf(body).begin(), 16, values);
  }
}

void requireBodyQuery(HLenum name) {
  for (const HLenum known : {HL_BODY_POSITION, HL_BODY_ROTATION, HL_BODY_MATRIX, HL_BODY_VELOCITY, HL_BODY_SPIN}) {
    if (name == known) return;
  }
  throw Fault(HL_INVALID_ENUM, "the name must be HL_BODY_POSITION .. HL_BODY_MATRIX, HL_BODY_VELOCITY or HL_BODY_SPIN");
}

}  // namespace

void hlBodyf(HLenum parameter, HLfloat value) {
  setBody(__func__, [&](hl::proto::Body& body) { setNumber(body, parameter, double{value}); });
}
void hlBodyd(HLenum parameter, HLdouble value) {
  setBody(__func__, [&](hl::proto::Body& body) { setNumber(body, parameter, value); });
}
void hlBodyi(HLenum parameter, HLint value) {
  setBody(__func__, [&](hl::proto::Body& body) { setWhole(body, parameter, value); });
}

void hlBody3d(HLenum parameter, HLdouble x, HLdouble y, HLdouble z) {
  setBody(__func__, [&](hl::proto::Body& body) {
    if (parameter == HL_BODY_VELOCITY)
      return setWithin(kVelocity, *body.mutable_velocity_m_s(), x, y, z, limits::kMaxSpeed_m_s);
    if (parameter == HL_BODY_SPIN) return setWithin(kSpin, *body.mutable_spin_rad_s(), x, y, z, limits::kMaxSpin_rad_s);
    throw Fault(HL_INVALID_ENUM, "the parameter must be HL_BODY_VELOCITY or HL_BODY_SPIN");
  });
}

void hlGravity3d(HLdouble x, HLdouble y, HLdouble z) {
  call(__func__, When::kNotInDefinition, [&](HLcontext& context) {
    for (const double value : {x, y, z})
      requireWithin("each coordinate", value, -limits::kMaxGravity_m_s2, limits::kMaxGravity_m_s2);
    context.frame.gravity_m_s2 = {x, y, z};
  });
}

void hlBodyImpulsed(HLuint object, HLdouble ix, HLdouble iy, HLdouble iz, HLdouble px, HLdouble py, HLdouble pz,
                    HLdouble seconds) {
  act(__func__, object, [&](hl::proto::BodyCommand& command) {
    hl::proto::BodyPush& push = *command.mutable_push();
    setWithin("each coordinate of the impulse", *push.mutable_impulse_n_s(), ix, iy, iz, limits::kMaxImpulse_N_s);
    setWithin(kPlace, *push.mutable_point(), px, py, pz, hl::kFarthest_m);
    requireWithin("the time", seconds, 0, limits::kMaxPush_s);
    push.set_duration_s(seconds);
  });
}

void hlBodyVelocityd(HLuint object, HLdouble vx, HLdouble vy, HLdouble vz, HLdouble wx, HLdouble wy, HLdouble wz) {
  act(__func__, object, [&](hl::proto::BodyCommand& command) {
    setWithin(kVelocity, *command.mutable_velocity()->mutable_velocity_m_s(), vx, vy, vz, limits::kMaxSpeed_m_s);
    setWithin(kSpin, *command.mutable_velocity()->mutable_spin_rad_s(), wx, wy, wz, limits::kMaxSpin_rad_s);
  });
}

void hlBodyPlaced(HLuint object, HLdouble x, HLdouble y, HLdouble z, HLdouble qx, HLdouble qy, HLdouble qz,
                  HLdouble qw) {
  act(__func__, object, [&](hl::proto::BodyCommand& command) {
    setWithin(kPlace, *command.mutable_place()->mutable_position(), x, y, z, hl::kFarthest_m);
    requireFinite(qx, qy, qz, qw);
    const double length = std::hypot(std::hypot(qx, qy), std::hypot(qz, qw));
    if (!(length > 0) || !std::isfinite(length)) throw Fault(HL_INVALID_VALUE, "the quaternion must not be 0");
    hl::proto::Rotation& rotation = *command.mutable_place()->mutable_rotation();
    rotation.set_x(qx / length);
    rotation.set_y(qy / length);
    rotation.set_z(qz / length);
    rotation.set_w(qw / length);
  });
}

HLsizei hlGetBodies(HLsizei most, HLbody* bodies) {
  return hl::client::getList(__func__, most, bodies, hl::client::bodiesOf);
}

HLboolean hlGetBodydv(HLuint object, HLenum name, HLdouble* values) {
  return callOr<HLboolean>(HL_FALSE, __func__, When::kOutside, [&](HLcontext& context) -> HLboolean {
    requireBodyQuery(name);
    requirePointer(values);
    const HLuint called = context.draw.attributes.now.name;
    for (const HLbody& body : hl::client::bodiesOf(context)) {
      if (body.object != object || (called != 0 && body.name != called)) continue;
      write(body, name, values);
      return HL_TRUE;
    }
    return HL_FALSE;
  });
}

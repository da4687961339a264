#include "session/body_commands.h"

#include <string>

#include "base/error.h"
#include "base/turn.h"
#include "io/decode_scene.h"
#include "io/vec_messages.h"

namespace hl {

namespace {

const SceneDecoder& decoder() {
  static const SceneDecoder decoder([](const std::string&, const std::string& message) { throw Error(message); });
  return decoder;
}

Mat3 rotationOf(const proto::Rotation& in) {
  Eigen::Quaterniond turned = turnOf(in);
  if (!toUnit(turned)) throw Error("body_command.place.rotation must be a finite quaternion that is not 0");
  return turned.toRotationMatrix();
}

}  // namespace

BodyCommand toBodyCommand(const proto::BodyCommand& in) {
  BodyCommand out;
  const auto vec = [](const proto::Vec3& v, double most, const char* name) {
    return decoder().checked(v, most, std::string("body_command.") + name);
  };
  switch (in.what_case()) {
    case proto::BodyCommand::kPush:
      out.impulse_N_s = vec(in.push().impulse_n_s(), body_limits::kMaxImpulse_N_s, "push.impulse_N_s");
      if (in.push().has_point()) out.point_m = vec(in.push().point(), kFarthest_m, "push.point");
      out.duration_s =
          decoder().checked(in.push().duration_s(), 0, body_limits::kMaxPush_s, "body_command.push.duration_s");
      return out;
    case proto::BodyCommand::kVelocity:
      if (in.velocity().has_velocity_m_s())
        out.velocity_m_s = vec(in.velocity().velocity_m_s(), body_limits::kMaxSpeed_m_s, "velocity.velocity_m_s");
      if (in.velocity().has_spin_rad_s())
        out.spin_rad_s = vec(in.velocity().spin_rad_s(), body_limits::kMaxSpin_rad_s, "velocity.spin_rad_s");
      return out;
    case proto::BodyCommand::kPlace:
      if (in.place().has_position()) out.position_m = vec(in.place().position(), kFarthest_m, "place.position");
      if (in.place().has_rotation()) out.rotation = rotationOf(in.place().rotation());
      return out;
    case proto::BodyCommand::WHAT_NOT_SET:
      break;
  }
  throw Error("body_command needs a push, a velocity or a place");
}

}  // namespace hl

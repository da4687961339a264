#include "session/hand_messages.h"

#include "io/vec_messages.h"
#include "session/stylus_messages.h"

namespace hl {

void toProto(const TouchSession& session, const ServoView& servo, const ProxyView& proxy, proto::OtherDevice& out) {
  out.set_label(session.label().name);
  toProto(session.live().workspace().toWorld(servo.finger_D), *out.mutable_finger());
  toProto(proxy.proxy, *out.mutable_proxy());
  toProto(servo.force_N, *out.mutable_force_n());
  out.set_safety(static_cast<proto::SafetyState>(servo.safety));
  if (servo.safety == SafetyState::kFault) out.set_fault(faultText(servo.fault));
  out.set_buttons(servo.buttons);
  out.set_contacts(static_cast<std::uint32_t>(proxy.contacts.size()));
  out.set_exploring(session.hand().exploring());
  out.set_servo_rate_hz(servo.loop.rate_Hz);
  out.set_proxy_radius(session.live().radius_W());
  setStylus(servo.stylus, session.deviceInfo(), out);
}

}  // namespace hl

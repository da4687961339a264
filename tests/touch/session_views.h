// What tests see of a running session.
#pragma once

#include "touch/touch_session.h"

namespace hl::test {

/// What the servo last did. As TouchSession::views(): one thread only.
inline ServoView servoOf(TouchSession& session) {
  ServoView servo;
  ProxyView proxy;
  session.views(servo, proxy);
  return servo;
}

}  // namespace hl::test

// A hand and its proxy as one message, for pages and for other servers.
#pragma once

#include <hl.pb.h>

#include "touch/touch_session.h"

namespace hl {

/// `servo` and `proxy`: what the session has given last.
void toProto(const TouchSession& session, const ServoView& servo, const ProxyView& proxy, proto::OtherDevice& out);

}  // namespace hl

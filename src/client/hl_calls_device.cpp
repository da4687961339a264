// Proxy, workspace, spring, hand: settings of the device, sent at once; and the rate of states and the events.
#include <hl/hl.h>

#include <algorithm>
#include <cstddef>

#include "client/call.h"
#include "client/vec_messages.h"

using hl::client::call;
using hl::client::callOr;
using hl::client::Fault;
using hl::client::requireFinite;
using hl::client::requireList;
using hl::client::When;

namespace {

void requirePositive(const char* what, double value) {
  requireFinite(value);
  if (value <= 0) throw Fault(HL_INVALID_VALUE, std::string(what) + " must be above 0");
}

void setFinite(hl::proto::Vec3& out, double x, double y, double z) {
  requireFinite(x, y, z);
  hl::client::setVec(out, x, y, z);
}

// Lets `fill` write the settings, and sends them. After the end of the conversation nothing is known of the master.
template <typename Fill>
void setDevice(const char* function, Fill fill) {
  call(function, [&](HLcontext& context) {
    hl::proto::DeviceSettings settings;
    fill(settings);
    if (!context.conversation.hasEnded() && !context.conversation.view().isMaster())
      throw Fault(HL_INVALID_OPERATION, "this context is not the device's master");
    context.conversation.send(std::move(settings));
  });
}

void setProxy(const char* function, HLenum parameter, double value) {
  setDevice(function, [&](hl::proto::DeviceSettings& settings) {
    if (parameter != HL_PROXY_RADIUS) throw Fault(HL_INVALID_ENUM, "the parameter must be HL_PROXY_RADIUS");
    requirePositive("HL_PROXY_RADIUS", value);
    settings.set_proxy_radius(value);
  });
}

// The vertices of an item by the numbers that hlUpdateVertices takes, where the object is this context's.
HLcontactforce contactForceOf(const HLcontext& context, const hl::proto::PressedPoint& in) {
  HLcontactforce out{};
  std::size_t before = 0;
  const bool own = in.session() == context.conversation.view().welcome().session();
  if (own && context.objects.isDefined(in.object())) {
    for (const hl::client::ItemVertices& item : context.objects.vertices(in.object()))
      if (item.item < in.item()) before += item.count;
  }
  const int count = std::min({in.vertices_size(), in.weights_size(), 3});
  for (int i = 0; i < count; ++i) {
    out.vertices[i] = in.vertices(i) + static_cast<HLuint>(before);
    out.weights[i] = in.weights(i);
  }
  out.vertex_count = static_cast<HLuint>(count);
  out.object = in.object();
  out.name = in.name();
  out.session = in.session();
  const auto write = [](const hl::proto::Vec3& v, HLdouble* to) {
    to[0] = v.x();
    to[1] = v.y();
    to[2] = v.z();
  };
  write(in.point(), out.point);
  write(in.force_n(), out.force);
  return out;
}

}  // namespace

void hlProxyf(HLenum parameter, HLfloat value) { setProxy(__func__, parameter, double{value}); }
void hlProxyd(HLenum parameter, HLdouble value) { setProxy(__func__, parameter, value); }

void hlWorkspaced(HLdouble x, HLdouble y, HLdouble z, HLdouble world_per_device) {
  setDevice(__func__, [&](hl::proto::DeviceSettings& settings) {
    requirePositive("world_per_device", world_per_device);
    setFinite(*settings.mutable_workspace()->mutable_origin(), x, y, z);
    settings.mutable_workspace()->set_world_per_device(world_per_device);
  });
}

void hlSpringd(HLdouble stiffness) {
  setDevice(__func__, [&](hl::proto::DeviceSettings& settings) {
    requirePositive("the stiffness", stiffness);
    settings.set_stiffness_n_m(stiffness);
  });
}

void hlLedger(HLenum mode) {
  setDevice(__func__, [&](hl::proto::DeviceSettings& settings) {
    if (mode < HL_LEDGER_TANK || mode > HL_LEDGER_REPORT)
      throw Fault(HL_INVALID_ENUM, "the mode must be HL_LEDGER_TANK, HL_LEDGER_STRICT or HL_LEDGER_REPORT");
    settings.set_ledger(static_cast<hl::proto::LedgerMode>(mode - HL_LEDGER_TANK));
  });
}

void hlRearm(void) {
  setDevice(__func__, [](hl::proto::DeviceSettings& settings) { settings.set_rearm(true); });
}

void hlHandGoal3d(HLdouble x, HLdouble y, HLdouble z) {
  setDevice(__func__, [&](hl::proto::DeviceSettings& settings) {
    setFinite(*settings.mutable_hand_goal()->mutable_position(), x, y, z);
  });
}

void hlHandTurn4d(HLdouble x, HLdouble y, HLdouble z, HLdouble w) {
  setDevice(__func__, [&](hl::proto::DeviceSettings& settings) {
    requireFinite(x, y, z, w);
    if (x == 0 && y == 0 && z == 0 && w == 0) throw Fault(HL_INVALID_VALUE, "the quaternion must not be 0");
    hl::proto::Rotation& rotation = *settings.mutable_hand_turn()->mutable_rotation();
    rotation.set_x(x);
    rotation.set_y(y);
    rotation.set_z(z);
    rotation.set_w(w);
  });
}

void hlHandGripperd(HLdouble angle) {
  setDevice(__func__, [&](hl::proto::DeviceSettings& settings) {
    requireFinite(angle);
    settings.mutable_hand_turn()->set_gripper_rad(angle);
  });
}

void hlHandGrip(HLenum grip) {
  setDevice(__func__, [&](hl::proto::DeviceSettings& settings) {
    if (grip != HL_GRIP_LIGHT && grip != HL_GRIP_FIRM)
      throw Fault(HL_INVALID_ENUM, "the grip must be HL_GRIP_LIGHT or HL_GRIP_FIRM");
    settings.set_hand_firm(grip == HL_GRIP_FIRM);
  });
}

void hlKeepSamples(HLsizei most) {
  call(__func__, [&](HLcontext& context) {
    if (most < 0) throw Fault(HL_INVALID_VALUE, "the number must not be negative");
    context.conversation.keepSamples(static_cast<std::size_t>(most));
  });
}

HLsizei hlTakeSamples(HLsizei most, HLsample* samples) {
  return callOr<HLsizei>(0, __func__, When::kOutside, [&](HLcontext& context) {
    requireList(most, samples);
    return static_cast<HLsizei>(context.conversation.samples().take(static_cast<std::size_t>(most), samples));
  });
}

void hlKeepContactReport(HLboolean wanted) {
  call(__func__, [&](HLcontext& context) { context.conversation.keepContactReports(wanted != HL_FALSE); });
}

HLsizei hlTakeContactReport(HLsizei most, HLcontactforce* contacts, HLcontactreport* report) {
  return callOr<HLsizei>(0, __func__, When::kOutside, [&](HLcontext& context) {
    requireList(most, contacts);
    const auto taken = context.conversation.contactReports().take(context.conversation.view().welcome().session());
    if (report != nullptr) *report = taken.report;
    const std::size_t count = std::min(taken.points.size(), static_cast<std::size_t>(most));
    for (std::size_t i = 0; i < count; ++i) contacts[i] = contactForceOf(context, taken.points[i]);
    return static_cast<HLsizei>(count);
  });
}

void hlStateRate(HLdouble rate) {
  call(__func__, [&](HLcontext& context) {
    requireFinite(rate);
    const double most = context.conversation.view().limits().state_rate_hz();
    if (rate < 0 || (most > 0 && rate > most)) throw Fault(HL_INVALID_VALUE, "the rate must be 0 .. HL_MAX_STATE_RATE");
    hl::proto::StateRate message;
    message.set_rate_hz(rate);
    context.conversation.send(message);
  });
}

void hlEventFunc(HLenum kind, HLeventfunc callback, void* user) {
  call(__func__, [&](HLcontext& context) {
    context.events.setCallback(kind, callback, user);
    if (kind >= HL_EVENT_SLEEP && callback != nullptr) context.conversation.hearBodies();
  });
}

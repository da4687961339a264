#include "client/queries.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "base/utf8.h"
#include "client/fault.h"

namespace hl::client {

namespace {

struct Query {
  HLenum name;
  void (*write)(const HLcontext& context, Values& values);
};

const Attributes& attributes(const HLcontext& c) { return c.draw.attributes.now; }
const ServerView& view(const HLcontext& c) { return c.conversation.view(); }
const proto::ClientState& state(const HLcontext& c) { return c.conversation.view().state(); }
const proto::Limits& limits(const HLcontext& c) { return c.conversation.view().limits(); }

void addMatrix(Values& values, const Matrix4& matrix) {
  for (int i = 0; i < 16; ++i) values.add(matrix.data()[i]);
}

// Of a device without a wrist: not turned.
void addTurn(Values& values, const proto::Stylus& stylus) {
  const proto::Rotation& turned = stylus.rotation();
  for (const double part : {turned.x(), turned.y(), turned.z(), stylus.has_rotation() ? turned.w() : 1})
    values.add(part);
}

void addVec(Values& values, const proto::Vec3& v) {
  values.add(v.x());
  values.add(v.y());
  values.add(v.z());
}

template <typename Array>
void addAll(Values& values, const Array& numbers) {
  for (const double number : numbers) values.add(number);
}

bool answerQuantity(const HLcontext& c, HLenum name, Values& values) {
  const auto number = numberOf(name);
  if (number) values.add(attributes(c).surface.quantities[*number].value_or(kQuantityInfo[*number].otherwise));
  return number.has_value();
}

double frameProgress(const HLcontext& c) {
  const std::uint64_t sent = c.conversation.outbox().lastSent();
  if (view(c).shown().number() >= sent) return 1;
  return view(c).progress().frame() == sent ? view(c).progress().built() : 0;
}

// The contact of this context's objects that presses hardest; null: none.
const proto::TouchedObject* touched(const HLcontext& c) {
  const proto::TouchedObject* hardest = nullptr;
  for (const proto::TouchedObject& contact : state(c).touched()) {
    if (contact.session() != view(c).welcome().session()) continue;
    if (hardest == nullptr || contact.plane().multiplier_m() > hardest->plane().multiplier_m()) hardest = &contact;
  }
  return hardest;
}

// The snap of this context's objects that holds the proxy; all 0: none.
const proto::HoldingSnap& snapped(const HLcontext& c) {
  const proto::HoldingSnap& snap = state(c).snap();
  const bool own = snap.session() == view(c).welcome().session();
  return own ? snap : proto::HoldingSnap::default_instance();
}

constexpr Query kQueriesOfCalls[] = {
    {HL_CURRENT_NORMAL, [](const HLcontext& c, Values& v) { addAll(v, attributes(c).vertex.normal); }},
    {HL_CURRENT_TEXTURE_COORDS, [](const HLcontext& c, Values& v) { addAll(v, attributes(c).vertex.texcoord); }},
    {HL_CURRENT_NAME, [](const HLcontext& c, Values& v) { v.add(attributes(c).name); }},
    {HL_CURRENT_OBJECT, [](const HLcontext& c, Values& v) { v.add(c.definition ? c.definition->object : 0); }},
    {HL_SHADE_MODEL, [](const HLcontext& c, Values& v) { v.add(attributes(c).surface.shade.value_or(HL_SMOOTH)); }},
    {HL_MATRIX_MODE, [](const HLcontext& c, Values& v) { v.add(attributes(c).matrix_mode); }},
    {HL_MODELVIEW_STACK_DEPTH,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(c.draw.modelview.depth())); }},
    {HL_TEXTURE_STACK_DEPTH, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(c.draw.texture.depth())); }},
    {HL_MODELVIEW_MATRIX, [](const HLcontext& c, Values& v) { addMatrix(v, c.draw.modelview.top()); }},
    {HL_TEXTURE_MATRIX, [](const HLcontext& c, Values& v) { addMatrix(v, c.draw.texture.top()); }},
    {HL_ATTRIB_STACK_DEPTH,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(c.draw.attributes.depth())); }},
    {HL_NAME_STACK_DEPTH,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(c.draw.attributes.nameDepth())); }},
    {HL_ACTIVE_TEXTURE,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(HL_TEXTURE0 + attributes(c).textures.active)); }},
    {HL_TEXTURE_BINDING_2D,
     [](const HLcontext& c, Values& v) { v.add(attributes(c).textures.uses[attributes(c).textures.active].texture); }},
    {HL_MAX_TEXTURE_SIZE, [](const HLcontext&, Values& v) { v.add(kMaxTextureSide); }},
    {HL_MAX_TEXTURE_UNITS, [](const HLcontext&, Values& v) { v.add(kTextureUnits); }},
    {HL_MAX_ATTRIB_STACK_DEPTH, [](const HLcontext&, Values& v) { v.add(kAttribDepth); }},
    {HL_MAX_MODELVIEW_STACK_DEPTH, [](const HLcontext&, Values& v) { v.add(kModelviewDepth); }},
    {HL_MAX_NAME_STACK_DEPTH, [](const HLcontext&, Values& v) { v.add(kNameDepth); }},
    {HL_MAX_TEXTURE_STACK_DEPTH, [](const HLcontext&, Values& v) { v.add(kTextureDepth); }},
};

constexpr Query kQueriesOfServer[] = {
    {HL_SESSION, [](const HLcontext& c, Values& v) { v.add(view(c).welcome().session()); }},
    {HL_MASTER, [](const HLcontext& c, Values& v) { v.add(!c.conversation.hasEnded() && view(c).isMaster()); }},
    {HL_CONNECTED, [](const HLcontext& c, Values& v) { v.add(!c.conversation.hasEnded()); }},
    {HL_FRAME_SENT,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(c.conversation.outbox().lastSent())); }},
    {HL_FRAME_SHOWN, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(view(c).shown().number())); }},
    {HL_FRAME_PROGRESS, [](const HLcontext& c, Values& v) { v.add(frameProgress(c)); }},
    {HL_FRAME_WAITING, [](const HLcontext& c, Values& v) { v.add(c.conversation.outbox().hasWaiting()); }},
    {HL_FRAME_PRIMITIVES,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(view(c).shown().primitives())); }},
    {HL_MAX_OBJECTS, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(limits(c).objects())); }},
    {HL_MAX_SCENE_BYTES, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(limits(c).scene_bytes())); }},
    {HL_MAX_INSTANCES, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(limits(c).instances())); }},
    {HL_MAX_NESTING, [](const HLcontext& c, Values& v) { v.add(limits(c).nesting()); }},
    {HL_MAX_TEXTURE_BYTES,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(limits(c).texture_bytes())); }},
    {HL_MAX_FRAME_RATE, [](const HLcontext& c, Values& v) { v.add(limits(c).frames_hz()); }},
    {HL_MAX_STATE_RATE, [](const HLcontext& c, Values& v) { v.add(limits(c).state_rate_hz()); }},
    {HL_MAX_BODIES, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(limits(c).bodies())); }},
    {HL_MAX_JOINTS, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(limits(c).joints())); }},
    {HL_DEVICE, [](const HLcontext& c, Values& v) { v.add(view(c).deviceNumber()); }},
    {HL_DEVICE_COUNT, [](const HLcontext& c, Values& v) { v.add(view(c).welcome().devices_size()); }},
    {HL_DEVICE_FORCE_MAX, [](const HLcontext& c, Values& v) { v.add(view(c).device().force_max_n()); }},
    {HL_DEVICE_WRIST, [](const HLcontext& c, Values& v) { v.add(view(c).device().has_wrist() ? HL_TRUE : HL_FALSE); }},
    {HL_GRIPPER_MAX, [](const HLcontext& c, Values& v) { v.add(view(c).device().gripper_max_rad()); }},
    {HL_SPRING_STIFFNESS_MAX, [](const HLcontext& c, Values& v) { v.add(view(c).device().stiffness_max_n_m()); }},
    {HL_SPRING_STIFFNESS, [](const HLcontext& c, Values& v) { v.add(c.conversation.springStiffness_N_m()); }},
    {HL_SPRING_DAMPING, [](const HLcontext& c, Values& v) { v.add(view(c).device().damping_ns_m()); }},
};

constexpr Query kQueriesOfState[] = {
    {HL_FINGER_POSITION, [](const HLcontext& c, Values& v) { addVec(v, state(c).finger()); }},
    {HL_PROXY_POSITION, [](const HLcontext& c, Values& v) { addVec(v, state(c).proxy()); }},
    {HL_FORCE, [](const HLcontext& c, Values& v) { addVec(v, state(c).force_n()); }},
    {HL_CONTACT_COUNT, [](const HLcontext& c, Values& v) { v.add(state(c).touched_size()); }},
    {HL_TOUCHED_OBJECT, [](const HLcontext& c, Values& v) { v.add(touched(c) ? touched(c)->object() : 0); }},
    {HL_TOUCHED_NAME, [](const HLcontext& c, Values& v) { v.add(touched(c) ? touched(c)->name() : 0); }},
    {HL_SNAPPED_OBJECT, [](const HLcontext& c, Values& v) { v.add(snapped(c).object()); }},
    {HL_SNAPPED_NAME, [](const HLcontext& c, Values& v) { v.add(snapped(c).name()); }},
    {HL_SNAP_NUMBER, [](const HLcontext& c, Values& v) { v.add(snapped(c).number()); }},
    {HL_BUTTONS, [](const HLcontext& c, Values& v) { v.add(state(c).buttons()); }},
    {HL_STYLUS_ROTATION, [](const HLcontext& c, Values& v) { addTurn(v, state(c).stylus()); }},
    {HL_STYLUS_SPIN, [](const HLcontext& c, Values& v) { addVec(v, state(c).stylus().spin_rad_s()); }},
    {HL_GRIPPER_ANGLE, [](const HLcontext& c, Values& v) { v.add(state(c).stylus().gripper_rad()); }},
    {HL_GRIPPER_FORCE, [](const HLcontext& c, Values& v) { v.add(state(c).stylus().gripper_n()); }},
    {HL_SAFETY_STATE,
     [](const HLcontext& c, Values& v) {
       v.add(HL_SAFETY_OFF + (c.conversation.hasEnded() ? 0 : int{state(c).safety()}));
     }},
    {HL_SERVO_RATE, [](const HLcontext& c, Values& v) { v.add(state(c).servo().rate_hz()); }},
    {HL_PROXY_RATE, [](const HLcontext& c, Values& v) { v.add(state(c).proxy_loop().rate_hz()); }},
    {HL_SERVO_DEADLINES_MISSED,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(state(c).servo().deadlines_missed())); }},
    {HL_PROXY_DEADLINES_MISSED,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(state(c).proxy_loop().deadlines_missed())); }},
    {HL_LEDGER_MODE, [](const HLcontext& c, Values& v) { v.add(HL_LEDGER_TANK + int{state(c).ledger().mode()}); }},
    {HL_LEDGER_TANK_LEVEL, [](const HLcontext& c, Values& v) { v.add(state(c).ledger().tank_j()); }},
    {HL_LEDGER_INJECTED, [](const HLcontext& c, Values& v) { v.add(state(c).ledger().injected_j()); }},
    {HL_LEDGER_DISSIPATED, [](const HLcontext& c, Values& v) { v.add(state(c).ledger().dissipated_j()); }},
    {HL_VIBRATIONS, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(state(c).vibration().alarms())); }},
    {HL_SPRING_LIMIT, [](const HLcontext& c, Values& v) { v.add(state(c).vibration().limit_n_m()); }},
    {HL_HAND_GRIP, [](const HLcontext& c, Values& v) { v.add(state(c).hand_firm() ? HL_GRIP_FIRM : HL_GRIP_LIGHT); }},
    {HL_ITERATION_CAPS, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(state(c).iteration_caps())); }},
    {HL_UNPLACED_TICKS, [](const HLcontext& c, Values& v) { v.add(static_cast<double>(state(c).unplaced_ticks())); }},
    {HL_OUT_OF_WORK_TICKS,
     [](const HLcontext& c, Values& v) { v.add(static_cast<double>(state(c).ticks_ended().out_of_work())); }},
    {HL_PROXY_RADIUS, [](const HLcontext& c, Values& v) { v.add(state(c).proxy_radius()); }},
    {HL_WORKSPACE_ORIGIN, [](const HLcontext& c, Values& v) { addVec(v, state(c).workspace().origin()); }},
    {HL_WORKSPACE_SCALE, [](const HLcontext& c, Values& v) { v.add(state(c).workspace().world_per_device()); }},
    {HL_BODY_COUNT, [](const HLcontext& c, Values& v) { v.add(state(c).bodies_size()); }},
    {HL_REMOTE_HAND_COUNT, [](const HLcontext& c, Values& v) { v.add(state(c).remote_size()); }},
    {HL_JOINT_COUNT, [](const HLcontext& c, Values& v) { v.add(state(c).joints_size()); }},
    {HL_STATE_TIME, [](const HLcontext& c, Values& v) { v.add(state(c).time_s()); }},
    {HL_STATE_AGE, [](const HLcontext& c, Values& v) { v.add(view(c).stateAge_s()); }},
};

template <std::size_t Count>
bool answerFrom(const Query (&queries)[Count], const HLcontext& context, HLenum name, Values& values) {
  for (const Query& query : queries) {
    if (query.name != name) continue;
    query.write(context, values);
    return true;
  }
  return false;
}

void copy(const proto::Vec3& in, HLdouble (&out)[3]) {
  out[0] = in.x();
  out[1] = in.y();
  out[2] = in.z();
}

// As much as there is room for, ended by 0.
template <std::size_t kRoom>
void copy(const std::string& in, char (&out)[kRoom]) {
  const std::string text = validUtf8(in.substr(0, kRoom - 1));
  std::copy_n(text.data(), std::min(text.size(), kRoom - 1), out);
}

HLcontact contactOf(const proto::TouchedObject& in) {
  HLcontact contact{};
  copy(in.plane().point(), contact.point);
  copy(in.plane().normal(), contact.normal);
  contact.share = in.plane().multiplier_m();
  contact.static_friction = in.plane().static_friction();
  contact.stiffness = in.plane().stiffness();
  contact.object = in.object();
  contact.name = in.name();
  contact.session = in.session();
  return contact;
}

HLbody bodyOf(const proto::BodyState& in) {
  HLbody body{};
  body.object = in.object();
  body.name = in.name();
  copy(in.position(), body.position);
  body.rotation[0] = in.rotation().x();
  body.rotation[1] = in.rotation().y();
  body.rotation[2] = in.rotation().z();
  body.rotation[3] = in.rotation().w();
  copy(in.velocity_m_s(), body.velocity);
  copy(in.spin_rad_s(), body.spin);
  return body;
}

}  // namespace

Values answer(const HLcontext& context, HLenum name) {
  Values values;
  const bool answered = answerFrom(kQueriesOfState, context, name, values) ||
                        answerFrom(kQueriesOfCalls, context, name, values) ||
                        answerFrom(kQueriesOfServer, context, name, values) || answerQuantity(context, name, values);
  if (!answered) throw Fault(HL_INVALID_ENUM, "not a query");
  return values;
}

std::vector<HLcontact> contactsOf(const HLcontext& context) {
  std::vector<HLcontact> contacts;
  for (const proto::TouchedObject& touched : state(context).touched()) contacts.push_back(contactOf(touched));
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const HLcontact& a, const HLcontact& b) { return a.share > b.share; });
  return contacts;
}

std::vector<HLbody> bodiesOf(const HLcontext& context) {
  std::vector<HLbody> bodies;
  for (const proto::BodyState& body : state(context).bodies()) bodies.push_back(bodyOf(body));
  std::stable_sort(bodies.begin(), bodies.end(), [](const HLbody& a, const HLbody& b) {
    return a.object != b.object ? a.object < b.object : a.name < b.name;
  });
  return bodies;
}

std::vector<HLjoint> jointsOf(const HLcontext& context) {
  std::vector<HLjoint> joints;
  for (const proto::JointState& in : state(context).joints()) {
    HLjoint& joint = joints.emplace_back(HLjoint{in.id(), in.coordinate(), in.velocity(), in.force(), {}});
    copy(in.held_n(), joint.hold);
  }
  std::stable_sort(joints.begin(), joints.end(), [](const HLjoint& a, const HLjoint& b) { return a.joint < b.joint; });
  return joints;
}

std::vector<HLremotehand> remoteHandsOf(const HLcontext& context) {
  std::vector<HLremotehand> hands;
  for (const proto::OtherDevice& in : state(context).remote()) {
    HLremotehand& hand = hands.emplace_back();
    copy(in.server(), hand.server);
    copy(in.label(), hand.device);
    copy(in.finger(), hand.finger);
    copy(in.proxy(), hand.proxy);
    copy(in.force_n(), hand.force);
    Values turned;
    addTurn(turned, in.stylus());
    std::copy_n(turned.numbers.begin(), turned.count, hand.rotation);
    hand.radius = in.proxy_radius();
    hand.buttons = in.buttons();
    hand.contacts = in.contacts();
  }
  std::stable_sort(hands.begin(), hands.end(), [](const HLremotehand& a, const HLremotehand& b) {
    return std::string_view(a.server) < std::string_view(b.server);
  });
  return hands;
}

}  // namespace hl::client

#include "record/recorded_proxy.h"

#include "base/error.h"
#include "io/value_messages.h"
#include "proxy/tolerances.h"

namespace hl {

namespace {

// A ProxyMemory as one list; the contacts that hold the proxy are beside it, as their number varies.
struct MemoryValues {
  Vec3 position = Vec3::Zero();
  bool free = false, touching = false;
  double rest_s = 0;
  Vec3 presliding_m = Vec3::Zero();
  double stiffness = 1;
  std::int64_t time_ns = 0;
  std::uint64_t snapshot = 0, carrier = 0;
  HeldSnap snap;
  Ledger ledger;
  int out_of_work = 0, start = 0;
  FadingPull fading;
  ServoTarget last_target;
  std::uint64_t restarts = 0;
};

// How the spring yields; the contacts are beside it.
struct YieldingValues {
  Vec3 rest_offset_m = Vec3::Zero(), sharing_m = Vec3::Zero(), pressed_m = Vec3::Zero();
  double stiffness = 1;
  ComplianceEstimate estimate;
};

constexpr double kMaxMemory = 1e12;  // joules, seconds, metres: far beyond any session
constexpr const char* kMemory = "the memory of the proxy";
constexpr const char* kYieldingContact = "a contact that yields";
constexpr const char* kHeldSurface = "a surface that holds the proxy";
constexpr const char* kYielding = "how the proxy's spring yields";
constexpr const char* kEstimate = "the estimate of the compliance";

void checkVector(const char* what, const char* name, const Vec3& v) {
  for (int i = 0; i < 3; ++i) checkRanges(what, {{name, v[i], -kMaxMemory, kMaxMemory}});
}

void checkLastTarget(const ServoTarget& in) {
  constexpr const char* kLastTarget = "the last target before the recording";
  checkVector(kLastTarget, "proxy_D", in.proxy_D);
  checkVector(kLastTarget, "field_N", in.field_N);
  checkTime(in.time_ns, kLastTarget);
  checkRanges(kLastTarget, {{"stiffness", in.stiffness, 0, 1},
                            {"paid_J", in.paid_J, -kMaxMemory, kMaxMemory},
                            {"field_drag_Ns_m", in.field_drag_Ns_m, 0, kMaxMemory}});
}

void checkMemory(const MemoryValues& in) {
  checkVector(kMemory, "position", in.position);
  checkVector(kMemory, "presliding_m", in.presliding_m);
  checkVector(kMemory, "offset", in.fading.offset);
  checkTime(in.time_ns, "the last tick before the recording");
  checkRanges(kMemory, {{"rest_s", in.rest_s, 0, kMaxMemory},
                        {"stiffness", in.stiffness, 0, 1},
                        {"out_of_work", static_cast<double>(in.out_of_work), 0, convergence::kMostOutOfWork},
                        {"start", static_cast<double>(in.start), 0, static_cast<double>(StartSearch::kPlaces - 1)},
                        {"duration_s", in.fading.duration_s, in.fading.left_s, kMaxMemory},
                        {"left_s", in.fading.left_s, 0, kMaxMemory},
                        {"tank_J", in.ledger.tank_J, 0, kMaxMemory},
                        {"injected_J", in.ledger.injected_J, -kMaxMemory, kMaxMemory},
                        {"dissipated_J", in.ledger.dissipated_J, -kMaxMemory, kMaxMemory}});
  for (const double joules : in.ledger.by_cause_J)
    checkRanges(kMemory, {{"by_cause_J", joules, -kMaxMemory, kMaxMemory}});
  checkLastTarget(in.last_target);
}

void checkYielding(const YieldingContact& in) {
  checkVector(kYieldingContact, "part_m", in.part_m);
  checkVector(kYieldingContact, "normal", in.normal);
  checkRanges(kYieldingContact, {{"stiffness", in.stiffness, 0, 1},
                                 {"material_m_N", in.material_m_N, 0, kMaxMemory},
                                 {"multiplier_m", in.multiplier_m, -kMaxMemory, kMaxMemory},
                                 {"share", in.share, 0, 1},
                                 {"along", in.along, 0, 1}});
}

void checkEstimate(const ComplianceEstimate& in) {
  checkVector(kEstimate, "lift_m", in.lift_m);
  checkVector(kEstimate, "normal", in.normal);
  checkVector(kEstimate, "force_N", in.force_N);
  checkRanges(kEstimate, {{"compliance_m_N", in.compliance_m_N, 0, kMaxMemory},
                          {"moved_m", in.moved_m, -kMaxMemory, kMaxMemory},
                          {"sum_N", in.sum_N, -kMaxMemory, kMaxMemory},
                          {"ticks", static_cast<double>(in.ticks), 0, kMaxMemory},
                          {"frame_s", in.frame_s, 0, kMaxMemory}});
  for (const double weight : in.weights) checkRanges(kEstimate, {{"weights", weight, -kMaxMemory, kMaxMemory}});
  for (std::size_t i = 0; i < ComplianceEstimate::kFrames; ++i) {
    checkRanges(kEstimate, {{"moves_m", in.moves_m[i], -kMaxMemory, kMaxMemory},
                            {"means_N", in.means_N[i], -kMaxMemory, kMaxMemory},
                            {"lasts_N", in.lasts_N[i], -kMaxMemory, kMaxMemory}});
  }
}

void readYielding(const proto::RecordedProxy& in, ProxyState& state) {
  if (!in.has_yielding()) return;
  YieldingValues values;
  readValues(in.yielding(), kYielding, values);
  checkVector(kYielding, "rest_offset_m", values.rest_offset_m);
  checkVector(kYielding, "sharing_m", values.sharing_m);
  checkVector(kYielding, "pressed_m", values.pressed_m);
  checkEstimate(values.estimate);
  checkRanges(kYielding, {{"stiffness", values.stiffness, 0, 1}});
  state.yielding.offset_m = values.rest_offset_m;
  state.yielding.sharing_m = values.sharing_m;
  state.yielding.pressed_m = values.pressed_m;
  state.yielding.stiffness = values.stiffness;
  state.estimate = values.estimate;
  for (const proto::Values& one : in.yielding_contacts()) {
    YieldingContact contact;
    readValues(one, kYieldingContact, contact);
    checkYielding(contact);
    if (!state.yielding.contacts.push(contact))
      throw Error("the contacts that yield make no sense: there are too many");
  }
}

FixedVector<HeldSurface, kMaxActive> heldOf(const proto::RecordedProxy& in) {
  FixedVector<HeldSurface, kMaxActive> held;
  for (const proto::Values& one : in.held()) {
    HeldSurface surface;
    readValues(one, kHeldSurface, surface);
    for (const double weight : surface.weights)
      checkRanges(kHeldSurface, {{"weights", weight, -kMaxMemory, kMaxMemory}});
    checkRanges(kHeldSurface, {{"multiplier_m", surface.multiplier_m, -kMaxMemory, kMaxMemory},
                               {"stiffness", surface.stiffness, 0, 1}});
    if (!held.push(surface)) throw Error("the surfaces that hold the proxy make no sense: there are too many");
  }
  return held;
}

AdheringContacts adheringOf(const proto::RecordedProxy& in) {
  constexpr double kUnit = 1e-6;  // of a normal, which is computed
  constexpr int kNumbersEach = 4;
  AdheringContacts adhering;
  const int count = in.adhering_size() / kNumbersEach;
  if (in.adhering_size() % kNumbersEach != 0 || static_cast<std::size_t>(count) > AdheringContacts::capacity())
    throw Error("the contacts that hold the proxy make no sense: they are not of four numbers each, or too many");
  for (int i = 0; i < count; ++i) {
    const double* const values = in.adhering().data() + static_cast<std::ptrdiff_t>(kNumbersEach) * i;
    const AdheringContact contact{{values[0], values[1], values[2]}, values[3]};
    checkRanges("a contact that holds the proxy", {{"its normal's length", contact.normal.norm(), 1 - kUnit, 1 + kUnit},
                                                   {"adhesion_N", contact.adhesion_N, 0, kMaxMemory}});
    adhering.push(contact);
  }
  return adhering;
}

// FixedVectors of keys. `what` is for errors.
template <typename Keys>
Keys keysOf(const google::protobuf::RepeatedField<std::uint64_t>& in, const std::string& what) {
  Keys keys;
  for (const std::uint64_t key : in) {
    if (!keys.push(key)) throw Error(what + " make no sense: there are too many");
  }
  return keys;
}

}  // namespace

void toProto(const ProxyMemory& memory, proto::RecordedProxy& out) {
  const ProxyState& state = memory.state;
  const MemoryValues values{state.position,
                            state.free,
                            state.touching,
                            state.sticking.since_slip_s,
                            state.sticking.springs.stretch_m,
                            state.stiffness,
                            state.time_ns,
                            state.snapshot,
                            state.carrier,
                            state.snap,
                            state.ledger,
                            state.out_of_work,
                            state.start.next(),
                            memory.fading,
                            memory.last_target,
                            memory.restarts};
  toProto(valuesOf(values), *out.mutable_memory());
  for (const AdheringContact& contact : state.adhering) {
    add(*out.mutable_adhering(), contact.normal);
    out.add_adhering(contact.adhesion_N);
  }
  for (const HeldSurface& surface : state.held.surfaces) toProto(valuesOf(surface), *out.add_held());
  out.set_presliding_n_m(state.sticking.springs.stiffness_N_m);
  if (state.held.said) out.set_stiffness_said(*state.held.said);
  for (const std::uint64_t key : state.pierced) out.add_pierced(key);
  for (const std::uint64_t key : state.within) out.add_within(key);
  toProto(valuesOf(YieldingValues{state.yielding.offset_m, state.yielding.sharing_m, state.yielding.pressed_m,
                                  state.yielding.stiffness, state.estimate}),
          *out.mutable_yielding());
  for (const YieldingContact& contact : state.yielding.contacts)
    toProto(valuesOf(contact), *out.add_yielding_contacts());
}

ProxyMemory fromProto(const proto::RecordedProxy& in) {
  MemoryValues values;
  readValues(in.memory(), kMemory, values);
  checkMemory(values);
  ProxyMemory memory;
  ProxyState& state = memory.state;
  state.position = values.position;
  state.free = values.free;
  state.touching = values.touching;
  state.sticking.since_slip_s = values.rest_s;
  checkRanges(kMemory, {{"presliding_N_m", in.presliding_n_m(), 0, kMaxMemory}});
  state.sticking.springs = {values.presliding_m, in.presliding_n_m()};
  state.stiffness = values.stiffness;
  state.time_ns = values.time_ns;
  state.snapshot = values.snapshot;
  state.carrier = values.carrier;
  state.snap = values.snap;
  state.held.surfaces = heldOf(in);
  if (in.has_stiffness_said()) {
    checkRanges(kMemory, {{"stiffness_said", in.stiffness_said(), 0, 1}});
    state.held.said = in.stiffness_said();
  }
  state.adhering = adheringOf(in);
  state.pierced = keysOf<PiercedObjects>(in.pierced(), "the objects that let the proxy through");
  state.within = keysOf<MatterObjects>(in.within(), "the objects in whose matter the proxy is");
  readYielding(in, state);
  if (!state.held.surfaces.empty() && !state.yielding.contacts.empty() &&
      state.held.surfaces.size() != state.yielding.contacts.size())
    throw Error("the surfaces that hold the proxy make no sense: not all of them yield");
  state.ledger = values.ledger;
  state.out_of_work = values.out_of_work;
  state.start = StartSearch(values.start);
  memory.fading = values.fading;
  memory.last_target = values.last_target;
  memory.restarts = values.restarts;
  return memory;
}

}  // namespace hl

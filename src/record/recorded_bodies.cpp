#include "record/recorded_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "base/error.h"
#include "io/value_messages.h"

namespace hl {

namespace {

constexpr const char* kWhat = "the memory of the bodies";
constexpr double kMaxOfBodies = 1e15;  // of any number in it

struct BodiesTotals {
  std::uint64_t steps = 0;
  EnergyBook energy;
  std::array<double, 3> gravity_m_s2{};
  std::int64_t time_ns = 0;
  bool begun = false;
};

struct BodyMemory {
  BodyState state;
  Pose pose;
};

template <typename Items>
void toProtoList(const Items& items, proto::Values& out) {
  for (const auto& item : items) toProto(valuesOf(item), out);
}

/// Gives `take` each item of a list that toProtoList() has written.
template <typename Item, typename Take>
void readList(const proto::Values& in, const Take& take) {
  const Values one = valuesOf(Item{}), all = fromProto(in);
  const std::size_t numbers = one.numbers.size(), integers = one.integers.size();
  const std::size_t count = all.numbers.size() / numbers;
  if (all.numbers.size() != count * numbers || all.integers.size() != count * integers)
    requireFit(Fit::kOtherForm, kWhat);
  for (std::size_t i = 0; i < count; ++i) {
    const std::span its_numbers = std::span(all.numbers).subspan(i * numbers, numbers);
    const std::span its_integers = std::span(all.integers).subspan(i * integers, integers);
    for (const double number : its_numbers) checkRanges(kWhat, {{"a number", number, -kMaxOfBodies, kMaxOfBodies}});
    Item item;
    requireFit(setFrom({{its_numbers.begin(), its_numbers.end()}, {its_integers.begin(), its_integers.end()}}, item),
               kWhat);
    take(item);
  }
}

template <typename Item, std::size_t kMax>
void readFixed(const proto::Values& in, FixedVector<Item, kMax>& items) {
  readList<Item>(in, [&](const Item& item) {
    if (!items.push(item)) throw Error(std::string(kWhat) + " makes no sense: it holds too much");
  });
}

void readContacts(const proto::Values& in, std::size_t bodies, ContactMemory& contacts) {
  contacts.reserve(mostRows(bodies));
  readList<RememberedContact>(in, [&](const RememberedContact& contact) { contacts.add(contact); });
  const auto before = [](const RememberedContact& a, const RememberedContact& b) { return a.pair < b.pair; };
  if (!std::is_sorted(contacts.all().begin(), contacts.all().end(), before))
    throw Error(std::string(kWhat) + " makes no sense: its contacts are not in their order");
}

void checkTurned(const BodyState& state) {
  constexpr double kUnitLength = 1e-6;  // of a quaternion, which is computed
  checkRanges(kWhat, {{"a quaternion's length", state.turned.norm(), 1 - kUnitLength, 1 + kUnitLength},
                      {"stopped_short", static_cast<double>(state.stopped_short), 0, kMaxOfBodies}});
}

}  // namespace

void toProto(const BodiesMemory& memory, proto::RecordedBodies& out) {
  const WorldState& world = memory.world;
  const BodiesTotals totals{world.steps,
                            world.energy,
                            {world.gravity_m_s2.x(), world.gravity_m_s2.y(), world.gravity_m_s2.z()},
                            memory.time_ns,
                            memory.begun};
  toProto(valuesOf(totals), *out.mutable_totals());
  for (std::size_t i = 0; i < world.bodies.size(); ++i)
    toProto(valuesOf(BodyMemory{world.bodies[i], memory.poses[i]}), *out.mutable_bodies());
  toProtoList(world.joints, *out.mutable_joints());
  toProtoList(world.memory.all(), *out.mutable_contacts());
  toProtoList(world.asleep.all(), *out.mutable_asleep());
  toProtoList(memory.owed, *out.mutable_owed());
  toProtoList(memory.drawn, *out.mutable_drawn());
  toProtoList(memory.held_by, *out.mutable_held_by());
  toProtoList(memory.pushes, *out.mutable_pushes());
}

BodiesMemory fromProto(const proto::RecordedBodies& in) {
  BodiesMemory memory;
  WorldState& world = memory.world;
  readList<BodiesTotals>(in.totals(), [&](const BodiesTotals& totals) {
    checkTime(totals.time_ns, "the last step of the bodies before the recording");
    world.steps = totals.steps;
    world.energy = totals.energy;
    world.gravity_m_s2 = Vec3(totals.gravity_m_s2[0], totals.gravity_m_s2[1], totals.gravity_m_s2[2]);
    memory.time_ns = totals.time_ns;
    memory.begun = totals.begun;
  });
  readList<BodyMemory>(in.bodies(), [&](const BodyMemory& body) {
    checkTurned(body.state);
    checkRecorded(body.pose, kWhat);
    world.bodies.push_back(body.state);
    memory.poses.push_back(body.pose);
  });
  readList<JointState>(in.joints(), [&](const JointState& joint) { world.joints.push_back(joint); });
  readContacts(in.contacts(), world.bodies.size(), world.memory);
  readContacts(in.asleep(), world.bodies.size(), world.asleep);
  readFixed(in.owed(), memory.owed);
  readFixed(in.drawn(), memory.drawn);
  readFixed(in.held_by(), memory.held_by);
  readFixed(in.pushes(), memory.pushes);
  return memory;
}

}  // namespace hl

#include "record/recorded_ticks.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/clock.h"
#include "base/error.h"
#include "bodies/world_hash.h"
#include "io/value_messages.h"
#include "record/recorded_fields.h"

namespace hl {

namespace {

constexpr std::uint32_t kMaxLooks = 1'000'000;  // of a wrong file
constexpr const char* kTicksMisfit = "the lists of a block of ticks do not agree";

void addTick(const TickRecord& record, std::int64_t before_ns, proto::ProxyTicks& out) {
  out.add_time_ns(wrappedDifference_ns(record.in.time_ns, before_ns));
  add(*out.mutable_finger(), record.in.finger_D);
  add(*out.mutable_target_proxy(), record.target.proxy_D);
  out.add_target_stiffness(record.target.stiffness);
  out.add_target_paid_j(record.target.paid_J);
  out.add_target_valid(record.target.valid);
  add(*out.mutable_proxy(), record.proxy);
  out.add_contacts(static_cast<std::uint32_t>(record.contacts));
  out.add_work_ns(record.work_ns);
  out.add_used_up_at(static_cast<std::uint32_t>(record.used_up_at));
  out.add_world_hash(record.world_hash);
}

// A BodyCommand as plain values: what is absent has a false before it.
struct CommandParts {
  std::uint64_t key = 0;
  bool has_position = false, has_rotation = false, has_velocity = false, has_spin = false, has_point = false;
  Vec3 position_m = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
  Vec3 velocity_m_s = Vec3::Zero(), spin_rad_s = Vec3::Zero(), impulse_N_s = Vec3::Zero(), point_m = Vec3::Zero();
  double duration_s = 0;

  static CommandParts of(const BodyCommand& command) {
    CommandParts parts;
    parts.key = command.key;
    parts.has_position = command.position_m.has_value();
    parts.has_rotation = command.rotation.has_value();
    parts.has_velocity = command.velocity_m_s.has_value();
    parts.has_spin = command.spin_rad_s.has_value();
    parts.has_point = command.point_m.has_value();
    if (command.position_m) parts.position_m = *command.position_m;
    if (command.rotation) parts.rotation = *command.rotation;
    if (command.velocity_m_s) parts.velocity_m_s = *command.velocity_m_s;
    if (command.spin_rad_s) parts.spin_rad_s = *command.spin_rad_s;
    if (command.point_m) parts.point_m = *command.point_m;
    parts.impulse_N_s = command.impulse_N_s;
    parts.duration_s = command.duration_s;
    return parts;
  }
  BodyCommand command() const {
    BodyCommand whole;
    whole.key = key;
    if (has_position) whole.position_m = position_m;
    if (has_rotation) whole.rotation = rotation;
    if (has_velocity) whole.velocity_m_s = velocity_m_s;
    if (has_spin) whole.spin_rad_s = spin_rad_s;
    if (has_point) whole.point_m = point_m;
    whole.impulse_N_s = impulse_N_s;
    whole.duration_s = duration_s;
    return whole;
  }
};

void addBodyCommands(std::span<const TickRecord> records, proto::ProxyTicks& out) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    for (const BodyCommand& command : records[i].in.on_bodies) {
      proto::ValuesChange& change = *out.add_on_bodies();
      change.set_at(static_cast<std::uint32_t>(i));
      toProto(valuesOf(CommandParts::of(command)), *change.mutable_values());
    }
  }
}

// Throws hl::Error for what no client can say.
BodyCommand bodyCommandOf(const proto::ValuesChange& in) {
  constexpr const char* kCommand = "what is done to a body";
  constexpr double kMax = 1e15;
  CommandParts parts;
  readValues(in.values(), kCommand, parts);
  for (const double number : fromProto(in.values()).numbers) checkRanges(kCommand, {{"a number", number, -kMax, kMax}});
  checkRanges(kCommand, {{"duration_s", parts.duration_s, 0, kMax}});
  checkRecorded(Pose{parts.rotation, Vec3::Zero()}, kCommand);
  return parts.command();
}

void readBodyCommands(const proto::ProxyTicks& in, std::vector<TickRecord>& records) {
  for (const proto::ValuesChange& change : in.on_bodies()) {
    if (change.at() >= records.size() || !records[change.at()].in.on_bodies.push(bodyCommandOf(change)))
      throw Error(kTicksMisfit);
  }
}

TickRecord tickOf(const proto::ProxyTicks& in, int i, std::int64_t before_ns) {
  TickRecord record;
  record.in.time_ns = wrappedSum_ns(before_ns, in.time_ns(i));
  checkTime(record.in.time_ns, "a tick");
  record.in.finger_D = at(in.finger(), i);
  record.target = {at(in.target_proxy(), i), record.in.time_ns, in.target_valid(i), in.target_stiffness(i),
                   in.target_paid_j(i)};
  if (in.field_n_size() > 0) record.target.field_N = at(in.field_n(), i);
  if (in.field_drag_ns_m_size() > 0) record.target.field_drag_Ns_m = in.field_drag_ns_m(i);
  record.proxy = at(in.proxy(), i);
  record.contacts = in.contacts(i);
  record.work_ns = in.work_ns(i);
  if (in.world_hash_size() > 0) record.world_hash = in.world_hash(i);
  if (in.used_up_at_size() > 0) record.used_up_at = static_cast<int>(std::min(in.used_up_at(i), kMaxLooks));
  return record;
}

// What a session never has: a file may say anything.
void checkRecorded(const TickContext& context) {
  constexpr double kStiffest_N_m = 1e9, kShortest_s = 1e-9, kLongest_s = 1e3;
  if (!context.commands.workspace.valid()) throw Error("the workspace makes no sense: it can not be computed with");
  if (!Workspace::validRadius(context.commands.radius_W))
    throw Error(fmt::format("the radius of the proxy makes no sense: {} m", context.commands.radius_W));
  checkRecorded(context.commands.surfaces);
  checkRanges("the spring", {{"stiffness_N_m", context.spring.stiffness_N_m, 0, kStiffest_N_m},
                             {"period_s", context.spring.period_s, kShortest_s, kLongest_s}});
}

bool consistent(const proto::ProxyTicks& in) {
  const std::int64_t n = in.time_ns_size();
  const auto all = [n](std::initializer_list<std::int64_t> sizes, std::int64_t each) {
    return std::all_of(sizes.begin(), sizes.end(), [=](std::int64_t size) { return size == each * n; });
  };
  return n > 0 && in.commands_size() > 0 && in.commands(0).at() == 0 &&
         all({in.target_stiffness_size(), in.target_paid_j_size(), in.target_valid_size(), in.contacts_size(),
              in.work_ns_size()},
             1) &&
         (in.used_up_at_size() == 0 || in.used_up_at_size() == n) &&
         (in.field_n_size() == 0 || in.field_n_size() == 3 * n) && 3 * in.field_drag_ns_m_size() == in.field_n_size() &&
         (in.world_hash_size() == 0 || in.world_hash_size() == n) &&
         all({in.finger_size(), in.target_proxy_size(), in.proxy_size()}, 3);
}

}  // namespace

std::uint64_t worldHash(const ProxyLoop& proxy, HashedSteps hashed) {
  constexpr std::size_t kMany = 100;
  constexpr std::uint64_t kSeldom = 100;
  const BodyWorld* const bodies = proxy.bodies();
  if (bodies == nullptr) return 0;
  const WorldState& state = bodies->state();
  const bool seldom = hashed == HashedSteps::kSome || state.bodies.size() > kMany;
  if (seldom && state.steps % kSeldom != 0) return 0;
  return hashOf(bodies->world(), state);
}

void toProto(std::span<const TickRecord> records, std::uint64_t first, proto::ProxyTicks& out) {
  out.set_first(first);
  Values context;
  std::int64_t before_ns = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    addTick(records[i], before_ns, out);
    before_ns = records[i].in.time_ns;
    Values now = valuesOf(TickContext{records[i].in.commands, records[i].in.spring, records[i].scene});
    if (i > 0 && now == context) continue;
    proto::ValuesChange& change = *out.add_commands();
    change.set_at(static_cast<std::uint32_t>(i));
    toProto(now, *change.mutable_values());
    context = std::move(now);
  }
  addBodyCommands(records, out);
  addFields(records, out);
  const auto& hashes = out.world_hash();
  if (std::all_of(hashes.begin(), hashes.end(), [](std::uint64_t hash) { return hash == 0; })) out.clear_world_hash();
}

std::vector<TickRecord> fromProto(const proto::ProxyTicks& in) {
  if (!consistent(in)) throw Error(kTicksMisfit);
  std::vector<TickRecord> records;
  TickContext context;
  std::int64_t before_ns = 0;
  for (int i = 0, change = 0; i < in.time_ns_size(); ++i) {
    if (change < in.commands_size() && in.commands(change).at() == static_cast<std::uint32_t>(i)) {
      readValues(in.commands(change++).values(), "the settings of a tick", context, laterOfOverride(0, 0));
      checkRecorded(context);
    }
    if (i == in.time_ns_size() - 1 && change != in.commands_size()) throw Error(kTicksMisfit);
    records.push_back(tickOf(in, i, before_ns));
    records.back().in.commands = context.commands;
    records.back().in.spring = context.spring;
    records.back().scene = context.scene;
    before_ns = records.back().in.time_ns;
  }
  readBodyCommands(in, records);
  return records;
}

}  // namespace hl

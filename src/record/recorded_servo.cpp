#include "record/recorded_servo.h"

#include <algorithm>

#include "base/clock.h"
#include "base/error.h"
#include "base/fields.h"
#include "io/value_messages.h"
#include "record/rare_values.h"
#include "record/recorded_fields.h"
#include "record/recorded_stylus.h"

namespace hl {

namespace {

// How the small things of a step lie in its flags: proto/recording.proto.
std::uint32_t flagsOf(const ServoRecord& record) {
  return static_cast<std::uint32_t>(record.sample.status) | static_cast<std::uint32_t>(record.sample.held) << 2 |
         (static_cast<std::uint32_t>(record.command) & 3) << 3 | static_cast<std::uint32_t>(record.command) >> 2 << 13 |
         static_cast<std::uint32_t>(record.target.valid) << 5 | static_cast<std::uint32_t>(record.out.safety) << 6 |
         static_cast<std::uint32_t>(record.out.fault) << 9;
}

template <typename Enum>
Enum named(std::uint32_t number) {
  const Enum value = static_cast<Enum>(number);
  if (!isNamed(value)) throw Error("a servo step makes no sense: its flags say what there is not");
  return value;
}

void setFlags(std::uint32_t flags, ServoRecord& record) {
  if (flags >> 14 != 0) throw Error("a servo step makes no sense: its flags say what there is not");
  record.sample.status = named<DeviceStatus>(flags & 3);
  record.sample.held = (flags >> 2 & 1) != 0;
  record.command = named<ServoCommand>((flags >> 3 & 3) | (flags >> 13 & 1) << 2);
  record.target.valid = (flags >> 5 & 1) != 0;
  record.out.safety = named<SafetyState>(flags >> 6 & 7);
  record.out.fault = named<FaultReason>(flags >> 9 & 15);
}

void addStep(const ServoRecord& record, std::int64_t before_ns, proto::ServoSteps& out) {
  out.add_time_ns(wrappedDifference_ns(record.sample.time_ns, before_ns));
  add(*out.mutable_position(), record.sample.position);
  out.add_buttons(record.sample.buttons);
  out.add_flags(flagsOf(record));
  add(*out.mutable_target_proxy(), record.target.proxy_D);
  out.add_target_time_ns(wrappedDifference_ns(record.target.time_ns, record.sample.time_ns));
  out.add_target_stiffness(record.target.stiffness);
  out.add_target_paid_j(record.target.paid_J);
  add(*out.mutable_force_n(), record.out.force_N);
  out.add_work_ns(record.work_ns);
}

ServoRecord step(const proto::ServoSteps& in, int i, std::int64_t before_ns) {
  ServoRecord record;
  setFlags(in.flags(i), record);
  record.sample.time_ns = wrappedSum_ns(before_ns, in.time_ns(i));
  record.sample.position = at(in.position(), i);
  record.sample.buttons = in.buttons(i);
  if (in.weight_n_size() > 0) record.sample.weight_N = at(in.weight_n(), i);
  if (in.age_ns_size() > 0) record.sample.age_ns = in.age_ns(i);
  if (in.field_n_size() > 0) record.target.field_N = at(in.field_n(), i);
  if (in.field_drag_ns_m_size() > 0) record.target.field_drag_Ns_m = in.field_drag_ns_m(i);
  record.sample.stylus = stylusAt(in, i);
  record.target.proxy_D = at(in.target_proxy(), i);
  record.target.time_ns = wrappedSum_ns(record.sample.time_ns, in.target_time_ns(i));
  record.target.stiffness = in.target_stiffness(i);
  record.target.paid_J = in.target_paid_j(i);
  record.out.force_N = at(in.force_n(), i);
  record.work_ns = in.work_ns(i);
  return record;
}

bool consistent(const proto::ServoSteps& in) {
  const std::int64_t n = in.flags_size();
  const auto all = [n](std::initializer_list<std::int64_t> sizes, std::int64_t each) {
    return std::all_of(sizes.begin(), sizes.end(), [=](std::int64_t size) { return size == each * n; });
  };
  return n > 0 && in.settings_size() > 0 && in.settings(0).at() == 0 &&
         (in.weight_n_size() == 0 || in.weight_n_size() == 3 * n) && (in.age_ns_size() == 0 || in.age_ns_size() == n) &&
         stylusAgrees(in, n) && (in.field_n_size() == 0 || in.field_n_size() == 3 * n) &&
         3 * in.field_drag_ns_m_size() == in.field_n_size() &&
         all({in.time_ns_size(), in.buttons_size(), in.target_time_ns_size(), in.target_stiffness_size(),
              in.target_paid_j_size(), in.work_ns_size()},
             1) &&
         all({in.position_size(), in.target_proxy_size(), in.force_n_size()}, 3);
}

constexpr const char* kMisfit = "the lists of a block of servo steps do not agree";

// What few devices report is written for all steps or for none.
void addRare(std::span<const ServoRecord> records, proto::ServoSteps& out) {
  const auto weighs = [](const ServoRecord& record) { return !isZeroToTheBit(record.sample.weight_N); };
  if (std::any_of(records.begin(), records.end(), weighs)) {
    for (const ServoRecord& record : records) add(*out.mutable_weight_n(), record.sample.weight_N);
  }
  const auto late = [](const ServoRecord& record) { return record.sample.age_ns != 0; };
  if (std::any_of(records.begin(), records.end(), late)) {
    for (const ServoRecord& record : records) out.add_age_ns(record.sample.age_ns);
  }
  addFields(records, out);
  addStylus(records, out);
}

// Of a structure of today that ends with what was added.
LaterForms laterAtEnd(const Values& now, const Values& added) {
  LaterValues later;
  const std::size_t numbers = now.numbers.size() - added.numbers.size();
  for (std::size_t i = 0; i < added.numbers.size(); ++i) later.numbers.emplace_back(numbers + i, added.numbers[i]);
  const std::size_t integers = now.integers.size() - added.integers.size();
  for (std::size_t i = 0; i < added.integers.size(); ++i) later.integers.emplace_back(integers + i, added.integers[i]);
  return {later};
}

// The settings and the state of a servo before there was a port to a robot far away.
LaterForms laterOfSettings() { return laterAtEnd(valuesOf(ServoSettings{}), valuesOf(RemoteInput{})); }
LaterForms laterOfState() { return laterAtEnd(valuesOf(ServoState{}), valuesOf(RemotePort{})); }

}  // namespace

void toProto(std::span<const ServoRecord> records, std::uint64_t first, proto::ServoSteps& out) {
  out.set_first(first);
  toProto(valuesOf(records.front().before), *out.mutable_start());
  Values settings;
  std::int64_t before_ns = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    addStep(records[i], before_ns, out);
    before_ns = records[i].sample.time_ns;
    Values now = valuesOf(records[i].settings);
    if (i > 0 && now == settings) continue;
    proto::ValuesChange& change = *out.add_settings();
    change.set_at(static_cast<std::uint32_t>(i));
    toProto(now, *change.mutable_values());
    settings = std::move(now);
  }
  addRare(records, out);
}

std::vector<ServoRecord> fromProto(const proto::ServoSteps& in) {
  if (!consistent(in)) throw Error(kMisfit);
  std::vector<ServoRecord> records;
  ServoSettings settings;
  std::int64_t before_ns = 0;
  for (int i = 0, change = 0; i < in.flags_size(); ++i) {
    if (change < in.settings_size() && in.settings(change).at() == static_cast<std::uint32_t>(i)) {
      readValues(in.settings(change++).values(), "the servo's settings", settings, laterOfSettings());
    }
    if (i == in.flags_size() - 1 && change != in.settings_size()) throw Error(kMisfit);
    records.push_back(step(in, i, before_ns));
    records.back().settings = settings;
    before_ns = records.back().sample.time_ns;
  }
  readValues(in.start(), "the servo's state", records.front().before, laterOfState());
  return records;
}

}  // namespace hl

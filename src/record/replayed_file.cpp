#include "record/replayed_file.h"

#include <fmt/core.h>

#include "base/error.h"
#include "io/value_messages.h"
#include "record/recorded_bodies.h"
#include "record/recorded_proxy.h"
#include "record/recorded_servo.h"
#include "record/recorded_stylus.h"
#include "record/replay_values.h"

namespace hl {

namespace {

/// How many are missing before number `first`. Blocks rise, and no session comes near the last number there is.
std::uint64_t gapOf(std::uint64_t first, std::uint64_t next) {
  constexpr std::uint64_t kMax = std::uint64_t{1} << 62;
  if (first < next || first > kMax) throw Error("its steps or ticks are not in their order");
  return first - next;
}

ReplayReport reportOf(const proto::RecordingStart& start) {
  ReplayReport report;
  report.version = start.version();
  report.device = start.device_name();
  report.label = start.device_label();
  report.black_box = start.black_box();
  report.fault = start.fault();
  return report;
}

}  // namespace

void ServoReplay::play(const proto::ServoSteps& message, std::int64_t begin_ns, const StepVisitor& visit) {
  std::vector<ServoRecord> records = fromProto(message);
  // A black box begins in the middle.
  const bool gap = message.first() != next_ && (begun_ || !report_.black_box);
  if (gap) report_.lost_steps += gapOf(message.first(), next_);
  if (!begun_ || gap || report_.difference)
    state_ = records.front().before;
  else if (!(valuesOf(state_) == valuesOf(records.front().before)))
    differ(message.first(), age_s(records.front().sample.time_ns, begin_ns), "the state between two steps");
  next_ = message.first();
  for (const ServoRecord& record : records) {
    const double time_s = age_s(record.sample.time_ns, begin_ns);
    if (!begun_) report_.first_s = time_s;
    begun_ = true;
    step(record, time_s);
    if (visit) visit(time_s, record);
  }
}

void ServoReplay::step(const ServoRecord& record, double time_s) {
  apply(state_, record.command);
  const ServoOutput out = stepServo(state_, record.settings, record.target, record.sample);
  if (!(partsOf(out) == partsOf(record.out)))
    differ(next_, time_s,
           fmt::format("force {} N, state {} are recorded, and {} N, state {} come out", textOf(record.out.force_N),
                       static_cast<int>(record.out.safety), textOf(out.force_N), static_cast<int>(out.safety)));
  report_.last_s = time_s;
  ++report_.steps;
  ++next_;
}

void ServoReplay::differ(std::uint64_t number, double time_s, std::string text) {
  if (!report_.difference) report_.difference = {"servo step", number, time_s, std::move(text)};
}

ReplayedFile::ReplayedFile(const std::string& path, StepVisitor visit)
    : path_(path), visit_(std::move(visit)), reader_(path) {
  try {
    start_ = startOf(reader_);
    report_ = reportOf(start_);
    DeviceInfo device;
    readValues(start_.device(), "the device", device, laterOfDevice());
    checkRecorded(device);
    proxySettings();
  } catch (const Error& error) {
    throw errorOf(error);
  }
}

ErrorOfFile ReplayedFile::errorOf(const std::exception& why) const { return ErrorOfFile(path_ + ": " + why.what()); }

ProxySettings ReplayedFile::proxySettings() const {
  constexpr double kMaxPasses = 1e6;  // what a tick of a wrong file may cost
  ProxySettings settings;
  // Before the surfaces: radius, spring, period, scale; two caps, shading, ledger.
  readValues(start_.proxy(), "the proxy", settings, laterOfOverride(4, 4));
  settings.work_cap = kNoWorkCap;  // each tick says after how many looks it had used up its work
  checkRanges("the proxy", {{"iteration_cap", static_cast<double>(settings.iteration_cap), 1, kMaxPasses}});
  return settings;
}

double ReplayedFile::time_s(std::int64_t time_ns) const { return age_s(time_ns, start_.begin_ns()); }

bool ReplayedFile::readOn() {
  proto::RecordingBlock block;
  try {
    if (reader_.next(block)) {
      take(block);
      return true;
    }
  } catch (const Error& error) {
    throw errorOf(error);
  }
  report_.damage = reader_.damage();
  return false;
}

const ReplayedTick* ReplayedFile::tick() {
  while (ticks_.empty()) {
    if (!readOn()) return nullptr;
  }
  return &ticks_.front();
}

void ReplayedFile::take(const proto::RecordingBlock& block) {
  if (add_) takeScenes(block);
  if (block.has_scene()) ++report_.scenes;
  if (block.has_proxy()) {
    memory_ = fromProto(block.proxy());
    if (block.proxy().has_bodies()) bodies_ = fromProto(block.proxy().bodies());
  }
  if (block.has_ticks()) take(block.ticks());
  if (block.has_steps()) servo_.play(block.steps(), start_.begin_ns(), visit_);
  if (block.has_end()) report_.end = block.end().reason();
}

void ReplayedFile::takeScenes(const proto::RecordingBlock& block) {
  if (block.has_shape()) scenes_.add(block.shape());
  if (block.has_heights()) scenes_.add(block.heights());
  if (block.has_volume()) scenes_.add(block.volume());
  if (block.has_cloud()) scenes_.add(block.cloud());
  if (block.has_implicit()) scenes_.add(block.implicit());
  if (block.has_surfaces()) scenes_.add(block.surfaces());
  if (block.has_rigid_body()) scenes_.add(block.rigid_body());
  if (block.has_scene()) add_({block.scene().identity(), scenes_.scene(block.scene())});
}

void ReplayedFile::take(const proto::ProxyTicks& message) {
  const std::vector<TickRecord> records = fromProto(message);
  report_.ticks += records.size();
  if (message.first() != next_tick_) {
    report_.lost_ticks += gapOf(message.first(), next_tick_);
    known_ = false;
  }
  next_tick_ = message.first();
  for (const TickRecord& record : records) ticks_.push_back({record, next_tick_++, known_});
}

}  // namespace hl

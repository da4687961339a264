#include "record/replay.h"

#include <fmt/core.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include "base/error.h"
#include "io/value_messages.h"
#include "record/recorded_bodies.h"
#include "record/recorded_proxy.h"
#include "record/recorded_scene.h"
#include "record/recorded_servo.h"
#include "record/recorded_stylus.h"
#include "record/recording_file.h"

namespace hl {

namespace {

std::string textOf(const Vec3& v) { return fmt::format("({:.17g}, {:.17g}, {:.17g})", v.x(), v.y(), v.z()); }

/// All that a step or a tick gives, to be compared bit for bit.
template <typename... Parts>
Values partsOf(const Parts&... parts) {
  Values values;
  ValueWriter writer(values);
  (writer(parts), ...);
  return values;
}

Values partsOf(const ServoOutput& out) { return partsOf(out.force_N, out.safety, out.fault); }
Values partsOf(const ServoTarget& t) {
  return partsOf(t.proxy_D, t.time_ns, t.valid, t.stiffness, t.paid_J, t.field_N, t.field_drag_Ns_m);
}

/// How many are missing before number `first`. Blocks rise, and no session comes near the last number there is.
std::uint64_t gapOf(std::uint64_t first, std::uint64_t next) {
  constexpr std::uint64_t kMax = std::uint64_t{1} << 62;
  if (first < next || first > kMax) throw Error("its steps or ticks are not in their order");
  return first - next;
}

/// The servo again. A gap, and each block after a difference, begins with the state that is recorded.
class ServoReplay {
 public:
  explicit ServoReplay(ReplayReport& report) : report_(report) {}

  void play(const proto::ServoSteps& message, std::int64_t begin_ns, const StepVisitor& visit) {
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

 private:
  void step(const ServoRecord& record, double time_s) {
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
  void differ(std::uint64_t number, double time_s, std::string text) {
    if (!report_.difference) report_.difference = {"servo step", number, time_s, std::move(text)};
  }

  ReplayReport& report_;
  ServoState state_;
  std::uint64_t next_ = 0;
  bool begun_ = false;
};

/// The proxy loop again, with the scenes as it took them.
class ProxyReplay {
 public:
  /// `one_of_several`: of the devices of a server, whose hands are at the same bodies.
  ProxyReplay(ReplayReport& report, const ProxySettings& settings, bool one_of_several)
      : report_(report), settings_(settings), one_of_several_(one_of_several) {}

  void add(const proto::RecordedShape& shape) { reader_.add(shape); }
  void add(const proto::RecordedHeights& heights) { reader_.add(heights); }
  void add(const proto::RecordedVolume& volume) { reader_.add(volume); }
  void add(const proto::RecordedCloud& cloud) { reader_.add(cloud); }
  void add(const proto::RecordedImplicit& surface) { reader_.add(surface); }
  void add(const proto::RecordedSurfaces& surfaces) { reader_.add(surfaces); }
  void add(const proto::RecordedBody& body) { reader_.add(body); }
  void add(const proto::RecordedProxy& proxy) {
    memory_ = fromProto(proxy);
    if (proxy.has_bodies()) bodies_ = fromProto(proxy.bodies());
  }
  void add(const proto::RecordedScene& scene) {
    scenes_.push_back({scene.identity(), reader_.scene(scene)});
    if (one_of_several_ && movingBodies(*scenes_.back().snapshot) > 0) among_hands_ = true;
    ++report_.scenes;
  }

  void play(const proto::ProxyTicks& message, std::int64_t begin_ns) {
    const std::vector<TickRecord> records = fromProto(message);
    report_.ticks += records.size();
    if (message.first() != next_) {
      report_.lost_ticks += gapOf(message.first(), next_);
      unknown_ = true;
    }
    next_ = message.first();
    for (const TickRecord& record : records) {
      check(record, age_s(record.in.time_ns, begin_ns));
      ++next_;
    }
  }

 private:
  // The loop takes each scene in turn, those without a tick in them too: bodies go on from one to the next.
  void show(std::uint64_t identity) {
    if (shown_ == identity) return;
    const auto is_it = [&](const Shown& scene) { return scene.identity == identity; };
    const auto it = std::find_if(scenes_.begin(), scenes_.end(), is_it);
    if (it == scenes_.end()) throw Error("the recording lacks a scene that it touches");
    if (slot_)
      slot_->publish(scenes_.front().snapshot);
    else
      begin();
    for (; scenes_.front().identity != identity; slot_->publish(scenes_.front().snapshot)) {
      loop_->skip();
      slot_->dropBefore();
      scenes_.pop_front();
    }
    scenes_.pop_front();
    shown_ = identity;
  }
  void begin() {
    slot_ = std::make_unique<SnapshotSlot>(scenes_.front().snapshot);
    loop_ = std::make_unique<ProxyLoop>(*slot_, settings_);
    if (memory_) loop_->resume(*memory_);
    if (bodies_) loop_->resume(*bodies_);
  }
  void check(const TickRecord& record, double time_s) {
    if (among_hands_)
      ++report_.ticks_among_hands;
    else if (unknown_)
      ++report_.unchecked_ticks;
    else
      tick(record, time_s);
  }
  void tick(const TickRecord& record, double time_s) {
    show(record.scene);
    const int most_looks = record.used_up_at > 0 ? record.used_up_at : kNoWorkCap;
    loop_->act(record.in.on_bodies);
    const ProxyStep step =
        loop_->step(record.in.time_ns, record.in.finger_D, record.in.commands, record.in.spring, most_looks);
    slot_->dropBefore();
    if (!report_.difference) compare(record, step, time_s);
  }
  void compare(const TickRecord& record, const ProxyStep& step, double time_s) {
    const Vec3& proxy = loop_->state().position;
    if (!(partsOf(step.held.target) == partsOf(record.target)) || !(partsOf(proxy) == partsOf(record.proxy))) {
      differ(time_s, fmt::format("proxy {} m, target {} m are recorded, and {} m, {} m come out", textOf(record.proxy),
                                 textOf(record.target.proxy_D), textOf(proxy), textOf(step.held.target.proxy_D)));
      return;
    }
    if (record.world_hash == 0) return;
    ++report_.world_hashes;
    const std::uint64_t hash = worldHash(*loop_, HashedSteps::kAll);
    if (hash != record.world_hash)
      differ(time_s,
             fmt::format("bodies whose hash is {:016x} are recorded, and {:016x} comes out", record.world_hash, hash));
  }
  void differ(double time_s, std::string text) { report_.difference = {"tick", next_, time_s, std::move(text)}; }

  ReplayReport& report_;
  ProxySettings settings_;
  std::optional<ProxyMemory> memory_;  // before the first tick, where the recording begins within a session
  std::optional<BodiesMemory> bodies_;
  SceneReader reader_;
  struct Shown {
    std::uint64_t identity;
    std::shared_ptr<const Snapshot> snapshot;
  };
  std::deque<Shown> scenes_;  // not taken yet, as they were shown
  std::unique_ptr<SnapshotSlot> slot_;
  std::unique_ptr<ProxyLoop> loop_;
  std::uint64_t shown_ = 0, next_ = 0;
  bool unknown_ = false;  // ticks are missing: what the proxy remembers is not known
  const bool one_of_several_;
  bool among_hands_ = false;  // bodies were moved by hands that the recording does not have
};

ProxySettings proxySettingsOf(const proto::RecordingStart& start) {
  constexpr double kMaxPasses = 1e6;  // what a tick of a wrong file may cost
  ProxySettings settings;
  // Before the surfaces: radius, spring, period, scale; two caps, shading, ledger.
  readValues(start.proxy(), "the proxy", settings, laterOfOverride(4, 4));
  settings.work_cap = kNoWorkCap;  // each tick says after how many looks it had used up its work
  checkRanges("the proxy", {{"iteration_cap", static_cast<double>(settings.iteration_cap), 1, kMaxPasses}});
  return settings;
}

ReplayReport replayed(RecordingReader& reader, const StepVisitor& visit) {
  const proto::RecordingStart start = startOf(reader);
  ReplayReport report;
  report.version = start.version();
  report.device = start.device_name();
  report.label = start.device_label();
  report.black_box = start.black_box();
  report.fault = start.fault();
  DeviceInfo device;
  readValues(start.device(), "the device", device, laterOfDevice());
  checkRecorded(device);
  ServoReplay servo(report);
  ProxyReplay proxy(report, proxySettingsOf(start), !start.device_label().empty());
  proto::RecordingBlock block;
  while (reader.next(block)) {
    if (block.has_shape()) proxy.add(block.shape());
    if (block.has_heights()) proxy.add(block.heights());
    if (block.has_volume()) proxy.add(block.volume());
    if (block.has_cloud()) proxy.add(block.cloud());
    if (block.has_implicit()) proxy.add(block.implicit());
    if (block.has_surfaces()) proxy.add(block.surfaces());
    if (block.has_scene()) proxy.add(block.scene());
    if (block.has_rigid_body()) proxy.add(block.rigid_body());
    if (block.has_proxy()) proxy.add(block.proxy());
    if (block.has_ticks()) proxy.play(block.ticks(), start.begin_ns());
    if (block.has_steps()) servo.play(block.steps(), start.begin_ns(), visit);
    if (block.has_end()) report.end = block.end().reason();
  }
  report.damage = reader.damage();
  return report;
}

}  // namespace

ReplayReport replay(const std::string& path, const StepVisitor& visit) {
  RecordingReader reader(path);
  try {
    return replayed(reader, visit);
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
}

}  // namespace hl

#include "record/replay.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "record/replay_values.h"
#include "record/replayed_file.h"
#include "record/replayed_scenes.h"
#include "touch/hands_step.h"

namespace hl {

namespace {

constexpr std::int64_t kOneSession_ms = 10'000;  // in which the recordings of its devices begin

/// The proxy's loop of one device again, with the scenes as it took them.
class HandReplay {
 public:
  HandReplay(ReplayedFile& file, ReplayedScenes& scenes, SnapshotSlot::Bodies bodies)
      : file_(file), has_world_(bodies == SnapshotSlot::Bodies::kHere), scenes_(scenes, bodies) {}

  ReplayedFile& file() { return file_; }
  ProxyLoop& loop() { return *loop_; }
  static int looksOf(const TickRecord& record) { return record.used_up_at > 0 ? record.used_up_at : kNoWorkCap; }

  void show(std::uint64_t identity) {
    scenes_.show(
        identity, [this] { begin(); }, [this] { loop_->skip(); });
  }
  /// The next tick, of the device alone.
  void tick() {
    const ReplayedTick& tick = *file_.tick();
    if (lost_among_hands_)
      ++file_.report().ticks_among_hands;
    else if (!tick.known)
      ++file_.report().unchecked_ticks;
    else
      step(tick);
    file_.popTick();
  }
  /// The next tick is not made again: what other hands did is not known, nor what this one does after it.
  void loseAmongHands() {
    lost_among_hands_ = true;
    ++file_.report().ticks_among_hands;
    file_.popTick();
  }
  void compare(const ReplayedTick& tick, const ProxyStep& step) {
    if (file_.report().difference) return;
    const TickRecord& record = tick.record;
    const Vec3& proxy = loop_->state().position;
    if (!(partsOf(step.held.target) == partsOf(record.target)) || !(partsOf(proxy) == partsOf(record.proxy))) {
      differ(tick, fmt::format("proxy {} m, target {} m are recorded, and {} m, {} m come out", textOf(record.proxy),
                               textOf(record.target.proxy_D), textOf(proxy), textOf(step.held.target.proxy_D)));
      return;
    }
    if (record.world_hash == 0) return;
    ++file_.report().world_hashes;
    const std::uint64_t hash = worldHash(*loop_, HashedSteps::kAll);
    if (hash != record.world_hash)
      differ(tick,
             fmt::format("bodies whose hash is {:016x} are recorded, and {:016x} comes out", record.world_hash, hash));
  }

 private:
  void step(const ReplayedTick& tick) {
    const TickRecord& record = tick.record;
    show(record.scene);
    loop_->act(record.in.on_bodies);
    const ProxyStep step =
        loop_->step(record.in.time_ns, record.in.finger_D, record.in.commands, record.in.spring, looksOf(record));
    scenes_.slot().dropBefore();
    compare(tick, step);
  }
  void begin() {
    loop_ = std::make_unique<ProxyLoop>(scenes_.slot(), file_.proxySettings());
    if (file_.memory()) loop_->resume(*file_.memory());
    if (file_.bodies() && has_world_) loop_->resume(*file_.bodies());
  }
  void differ(const ReplayedTick& tick, std::string text) {
    file_.report().difference = {"tick", tick.number, file_.time_s(tick.record.in.time_ns), std::move(text)};
  }

  ReplayedFile& file_;
  const bool has_world_;  // of bodies, for itself
  SceneFollower scenes_;
  std::unique_ptr<ProxyLoop> loop_;
  bool lost_among_hands_ = false;
};

/// The recordings of one session, by the numbers of their devices.
class SessionReplay {
 public:
  /// `files`: at least one, all of one session.
  explicit SessionReplay(std::vector<ReplayedFile*> files)
      : scenes_([first = files.front()] { return first->readOn(); }), among_hands_(stateOf(files)) {
    files.front()->giveScenesTo([this](ReplayedScene scene) { scenes_.add(std::move(scene)); });
    const auto bodies = among_hands_ == Among::kNobody ? SnapshotSlot::Bodies::kHere : SnapshotSlot::Bodies::kElsewhere;
    for (ReplayedFile* file : files) hands_.push_back(std::make_unique<HandReplay>(*file, scenes_, bodies));
    if (among_hands_ == Among::kAll) world_.emplace(scenes_, SnapshotSlot::Bodies::kHere);
  }

  void run() {
    while (HandReplay* const next = earliest()) {
      const ReplayedTick& tick = *next->file().tick();
      try {
        amongHands(tick.record) ? together(tick.record) : next->tick();
      } catch (const ErrorOfFile&) {
        throw;
      } catch (const Error& error) {
        throw next->file().errorOf(error);
      }
    }
    for (const auto& hand : hands_) hand->file().tick();  // to the end of the file
  }

 private:
  /// Whose hands are at the bodies, beside that of a recording.
  enum class Among { kNobody, kAll, kUnknown };

  static Among stateOf(const std::vector<ReplayedFile*>& files) {
    const proto::RecordingStart& start = files.front()->start();
    if (start.device_label().empty()) return Among::kNobody;
    const bool all = files.size() > 1 && files.size() == start.devices() && files.size() <= kMaxHands;
    return all ? Among::kAll : Among::kUnknown;
  }

  HandReplay* earliest() {
    HandReplay* first = nullptr;
    for (const auto& hand : hands_) {
      const ReplayedTick* const tick = hand->file().tick();
      if (tick == nullptr) continue;
      if (first == nullptr || tick->record.in.time_ns < first->file().tick()->record.in.time_ns) first = hand.get();
    }
    return first;
  }

  bool amongHands(const TickRecord& record) {
    return among_hands_ != Among::kNobody && scenes_.hasBodies(record.scene);
  }

  // What all hands did at the moment of this tick. A hand of which ticks are missing makes the bodies unknown.
  void together(const TickRecord& first) {
    const std::int64_t time_ns = first.in.time_ns;
    std::vector<const ReplayedTick*> ticks;
    for (const auto& hand : hands_) {
      const ReplayedTick* const tick = hand->file().tick();
      const bool now = tick != nullptr && tick->record.in.time_ns == time_ns && tick->record.scene == first.scene;
      ticks.push_back(now ? tick : nullptr);
      known_ &= tick != nullptr && tick->known && !hand->file().memory();
    }
    const bool again = known_ && among_hands_ == Among::kAll;
    if (again) step(first.scene, ticks);
    for (std::size_t i = 0; i < hands_.size(); ++i) {
      if (ticks[i] != nullptr) again ? hands_[i]->file().popTick() : hands_[i]->loseAmongHands();
    }
  }

  void step(std::uint64_t identity, const std::vector<const ReplayedTick*>& ticks) {
    world_->show(
        identity, [] {}, [this] { world_->slot().take(); });
    const Snapshot& scene = world_->slot().take();
    FixedVector<HandInStep, kMaxHands> hands;
    for (std::size_t i = 0; i < hands_.size(); ++i) {
      HandInStep hand;
      if (ticks[i] != nullptr) {
        const TickRecord& record = ticks[i]->record;
        hands_[i]->show(identity);
        hands_[i]->loop().act(record.in.on_bodies);
        hand = {&hands_[i]->loop(), &record.in, HandReplay::looksOf(record)};
      }
      hands.push(hand);
    }
    stepHands(scene, world_->slot().bodies(), body_loop_, {hands.begin(), hands.size()});
    world_->slot().dropBefore();
    for (std::size_t i = 0; i < hands_.size(); ++i) {
      if (ticks[i] != nullptr) hands_[i]->compare(*ticks[i], hands[i].out);
    }
  }

  ReplayedScenes scenes_;
  const Among among_hands_;
  std::vector<std::unique_ptr<HandReplay>> hands_;
  std::optional<SceneFollower> world_;
  BodyLoop body_loop_;
  bool known_ = true;  // what all hands have done so far
};

// Throws hl::Error unless they are of several devices of one session.
void requireOneSession(const std::vector<ReplayedFile*>& files) {
  const auto same_device = [](const ReplayedFile* a, const ReplayedFile* b) {
    return a->start().device_number() == b->start().device_number();
  };
  const std::int64_t first_ms = files.front()->start().begin_unix_ms();
  for (const ReplayedFile* file : files) {
    if (std::abs(file->start().begin_unix_ms() - first_ms) > kOneSession_ms)
      throw file->errorOf(Error("it is of another session than the others: give those of one, or one at a time"));
  }
  if (std::adjacent_find(files.begin(), files.end(), same_device) != files.end())
    throw Error("two of the recordings are of the same device: give one of each, or one at a time");
}

std::vector<ReplayReport> replayed(const std::vector<std::string>& paths, const StepVisitor& visit) {
  std::vector<std::unique_ptr<ReplayedFile>> files;
  std::vector<ReplayedFile*> by_number;
  for (const std::string& path : paths) {
    files.push_back(std::make_unique<ReplayedFile>(path, visit));
    by_number.push_back(files.back().get());
  }
  std::stable_sort(by_number.begin(), by_number.end(), [](const ReplayedFile* a, const ReplayedFile* b) {
    return a->start().device_number() < b->start().device_number();
  });
  if (by_number.size() > 1) requireOneSession(by_number);
  SessionReplay(by_number).run();
  std::vector<ReplayReport> reports;
  reports.reserve(files.size());
  for (const auto& file : files) reports.push_back(file->report());
  return reports;
}

}  // namespace

ReplayReport replay(const std::string& path, const StepVisitor& visit) { return replayed({path}, visit).front(); }

std::vector<ReplayReport> replayTogether(const std::vector<std::string>& paths) { return replayed(paths, {}); }

}  // namespace hl

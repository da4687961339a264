#include "record/black_boxes.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/duration.h"
#include "base/error.h"
#include "record/record_runs.h"
#include "record/recorded_scene.h"
#include "record/recorded_servo.h"

namespace hl {

namespace {

// A black box goes on for so long after the fault.
constexpr double kAfter_s = 0.2;
// From one checkpoint to the next.
constexpr std::int64_t kBetween_ns = 1'000'000'000;
// The loops go on while a scene is written.
constexpr std::size_t kMaxPrimitives = 1'000'000;
constexpr const char* kPrefix = "fault-";
constexpr const char* kEnding = ".hlr";

// The oldest go first: their names begin with the time.
void removeOldest(const std::filesystem::path& folder, std::size_t keep) {
  std::vector<std::filesystem::path> boxes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kPrefix) && name.ends_with(kEnding)) boxes.push_back(entry.path());
  }
  std::sort(boxes.begin(), boxes.end());
  for (std::size_t i = 0; i + keep < boxes.size(); ++i) std::filesystem::remove(boxes[i]);
}

std::string blackBoxName(const std::string& device) {
  static std::atomic<unsigned> made{0};
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t now_ms = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
  return fmt::format("{}{:%Y%m%dT%H%M%S}.{:03}-{}{}{}{}", kPrefix, fmt::gmtime(static_cast<std::time_t>(now_ms / 1000)),
                     now_ms % 1000, ++made, device.empty() ? "" : "-", device, kEnding);
}

// The blocks of a scene that can be recorded; none of one that cannot.
std::vector<proto::RecordingBlock> blocksOf(const Snapshot& scene) {
  std::vector<proto::RecordingBlock> blocks;
  if (scene.primitives > kMaxPrimitives) return blocks;
  try {
    SceneWriter().write(scene, [&](const proto::RecordingBlock& block) { blocks.push_back(block); });
  } catch (const Error&) {
    blocks.clear();
  }
  return blocks;
}

}  // namespace

BlackBoxes::BlackBoxes(const RecorderSettings& settings, const LoopRings& rings,
                       std::function<proto::RecordingBlock(FaultReason)> start)
    : settings_(settings), rings_(rings), start_(std::move(start)) {}

void BlackBoxes::step(const ServoRecord& record) noexcept {
  const bool fails = record.out.safety == SafetyState::kFault && record.before.safety != SafetyState::kFault;
  if (fails && record.out.fault != FaultReason::kStalled)
    fault_.store(rings_.steps.pushed(), std::memory_order_release);
}

// A fault is written a little after it was; a stall at once, as no more steps may come.
void BlackBoxes::look(bool all) {
  if (isOn()) remember();
  if (stalled_.exchange(false, std::memory_order_acquire)) write(rings_.steps.pushed(), FaultReason::kStalled);
  const std::uint64_t fault = fault_.load(std::memory_order_acquire);
  if (fault == written_fault_) return;
  const std::uint64_t end = fault + countIn(kAfter_s, rings_.servo_rate_Hz);
  if (!all && rings_.steps.pushed() < end) return;
  written_fault_ = fault;
  ServoRecord record;
  if (!rings_.steps.read(fault - 1, record)) return;
  write(std::min(end, rings_.steps.pushed()), record.out.fault);
}

// Where the loops are in another scene, what was remembered is of no use.
void BlackBoxes::followScene(std::uint64_t scene) {
  if (scene_ && scene_->identity == scene) return;
  checkpoints_.clear();
  scene_ = scenes_.beginAt(scene);
}

// Each second the loops give what they remember. Of what is kept, the first is of the time where a box would begin.
void BlackBoxes::remember() {
  TickRecord last;
  const std::uint64_t ticks = rings_.ticks.pushed();
  if (ticks == 0 || !rings_.ticks.read(ticks - 1, last)) return;
  followScene(last.scene);
  scenes_.forgetBefore(last.scene);
  const std::int64_t now_ns = monotonicNow_ns();
  if (capture_.stateAmong(rings_.ticks) == MemoryCapture::State::kReady && capture_.scene() == last.scene &&
      (checkpoints_.empty() || checkpoints_.back().next_tick != capture_.nextTick()))
    checkpoints_.push_back({capture_.block(), capture_.nextTick(), now_ns});
  while (checkpoints_.size() > 1 && now_ns - checkpoints_[1].time_ns > durationOf(kBefore_s).count())
    checkpoints_.pop_front();
  const bool due = checkpoints_.empty() || now_ns - checkpoints_.back().time_ns >= kBetween_ns;
  if (scene_ && due && !capture_.isWanted()) capture_.want(scenes_);
}

void BlackBoxes::write(std::uint64_t end, FaultReason reason) {
  if (!isOn()) return report(fmt::format("fault: {}; no black box: they are off", faultText(reason)));
  const std::filesystem::path folder = settings_.black_box_folder;
  try {
    std::filesystem::create_directories(folder);
    removeOldest(folder, settings_.black_boxes - 1);
    RecordingWriter box((folder / blackBoxName(rings_.device)).string());
    box.write(start_(reason));
    writeWorld(box);
    writeSteps(box, end);
    proto::RecordingBlock last;
    last.mutable_end()->set_reason("black box");
    box.write(last);
    report(fmt::format("fault: {}; black box: {}", faultText(reason), box.path()));
  } catch (const std::exception& error) {
    report(fmt::format("fault: {}; no black box: {}", faultText(reason), error.what()));
  }
}

void BlackBoxes::writeSteps(RecordingWriter& box, std::uint64_t end) const {
  const double rate_Hz = rings_.servo_rate_Hz;
  std::uint64_t next = end - std::min(end, countIn(kBefore_s + kAfter_s, rate_Hz));
  forRuns(rings_.steps, next, end, countIn(1, rate_Hz),
          [&box](const std::vector<ServoRecord>& run, std::uint64_t first) {
            proto::RecordingBlock out;
            toProto(run, first, *out.mutable_steps());
            box.write(out);
          });
}

// From the first checkpoint whose ticks are all there still, in its scene alone.
void BlackBoxes::writeWorld(RecordingWriter& box) const {
  TickRecord tick;
  const auto begin = std::find_if(checkpoints_.begin(), checkpoints_.end(),
                                  [&](const Checkpoint& one) { return rings_.ticks.read(one.next_tick, tick); });
  if (begin == checkpoints_.end()) return;
  std::vector<TickRecord> ticks;
  for (std::uint64_t next = begin->next_tick; rings_.ticks.read(next, tick) && tick.scene == scene_->identity; ++next)
    ticks.push_back(tick);
  const std::vector<proto::RecordingBlock> scene = blocksOf(*scene_);
  if (scene.empty() || ticks.empty()) return;
  box.write(begin->memory);
  for (const proto::RecordingBlock& block : scene) box.write(block);
  const std::size_t most = countIn(1, rings_.servo_rate_Hz);
  for (std::size_t first = 0; first < ticks.size(); first += most) {
    proto::RecordingBlock out;
    toProto(std::span(ticks).subspan(first, std::min(most, ticks.size() - first)), first, *out.mutable_ticks());
    box.write(out);
  }
}

void BlackBoxes::report(const std::string& line) const {
  if (settings_.report) settings_.report(rings_.device, line);
}

}  // namespace hl

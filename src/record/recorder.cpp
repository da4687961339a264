#include "record/recorder.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/error.h"
#include "base/guarded_thread.h"
#include "io/value_messages.h"
#include "record/recorded_bodies.h"
#include "record/recorded_proxy.h"
#include "record/recorded_servo.h"

namespace hl {

namespace {

// The rings hold a second more than a black box: time enough to write it before it is overwritten.
constexpr double kRing_s = Recorder::kBlackBox_s + 1;
// A black box goes on for so long after the fault.
constexpr double kAfter_s = 0.2;
constexpr auto kPeriod = std::chrono::milliseconds(20);
// A block holds a tenth of a second, or what there is at the end; more makes files smaller and loses more to a kill.
constexpr double kBlock_s = 0.1;
// What is left at the end is worth more than one try, and the end must come.
constexpr int kLastTries = 10;
constexpr const char* kPrefix = "fault-";
constexpr const char* kEnding = ".hlr";

std::size_t room(bool wanted, double rate_Hz) { return wanted ? static_cast<std::size_t>(kRing_s * rate_Hz) : 1; }

std::uint64_t countOf(double seconds, double rate_Hz) {
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(seconds * rate_Hz));
}

std::int64_t unixNow_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

// Gives `write` the records from `next` to `end` in runs without a gap, of at most `most`; what the ring no longer has
// is passed over. `next` is the first that is not written yet, also when `write` throws.
template <typename Record, typename Write>
void forRuns(const LogRing<Record>& ring, std::uint64_t& next, std::uint64_t end, std::uint64_t most, Write write) {
  std::vector<Record> run;
  std::uint64_t at = next;
  const auto flush = [&] {
    if (!run.empty()) write(run, at - run.size());
    run.clear();
    next = at;
  };
  for (; at < end; ++at) {
    Record record;
    const bool there = ring.read(at, record);
    if (!there || run.size() == most) flush();
    if (there) run.push_back(record);
  }
  flush();
}

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

std::string blackBoxName() {
  static std::atomic<unsigned> made{0};
  const std::int64_t now_ms = unixNow_ms();
  return fmt::format("{}{:%Y%m%dT%H%M%S}.{:03}-{}{}", kPrefix, fmt::gmtime(static_cast<std::time_t>(now_ms / 1000)),
                     now_ms % 1000, ++made, kEnding);
}

}  // namespace

Recorder::Recorder(const RecorderSettings& settings, const SessionInfo& session)
    : settings_(settings),
      session_(session),
      begin_{unixNow_ms(), monotonicNow_ns()},
      steps_(
          room(!settings.file.empty() || settings.pages || !settings.black_box_folder.empty(), session.servo_rate_Hz)),
      ticks_(room(!settings.file.empty() || settings.pages, std::max(session.servo_rate_Hz, session.proxy_rate_Hz))) {
  capture_.hashing = !settings_.file.empty();
  if (settings_.file.empty()) return;
  file_ = std::make_unique<RecordingWriter>(settings_.file);
  file_->write(startBlock(FaultReason::kNone));
}

Recorder::~Recorder() { stop(); }

void Recorder::start() {
  if (settings_.file.empty() && settings_.black_box_folder.empty() && !settings_.pages) return;
  running_ = true;
  thread_ = startThread("recorder", [this] { run(); });
}

void Recorder::stop() {
  {
    const std::lock_guard lock(mutex_);
    if (!running_) return;
    running_ = false;
  }
  wake_.notify_all();
  thread_.join();
}

void Recorder::step(const ServoRecord& record) noexcept {
  steps_.push(record);
  const bool fails = record.out.safety == SafetyState::kFault && record.before.safety != SafetyState::kFault;
  if (fails && record.out.fault != FaultReason::kStalled) fault_.store(steps_.pushed(), std::memory_order_release);
}

void Recorder::tick(const TickRequest& request, const ProxyStep& step, const ProxyLoop& proxy,
                    std::int64_t work_ns) noexcept {
  if (step.scene == 0) return;
  ticks_.push({request, step.scene, step.held.target, proxy.state().position, step.report.contacts.size(), work_ns,
               step.report.used_up_at, capture_.hashing.load(std::memory_order_relaxed) ? worldHash(proxy) : 0});
  if (capture_.phase.load(std::memory_order_acquire) != Capture::kWanted) return;
  capture_.memory = proxy.memory();
  capture_.has_bodies = proxy.bodies() != nullptr;
  capture_.has_room = proxy.remember(capture_.bodies);
  capture_.scene = step.scene;
  capture_.next_tick = ticks_.pushed();
  capture_.phase.store(Capture::kTaken, std::memory_order_release);
}

void Recorder::scene(std::shared_ptr<const Snapshot> scene) noexcept {
  if (settings_.file.empty() && !settings_.pages) return;
  scenes_.push(std::move(scene));
}

void Recorder::run() {
  std::unique_lock lock(mutex_);
  while (running_) {
    wake_.wait_for(lock, kPeriod);
    lock.unlock();
    guarded([this] { drain(false); });
    lock.lock();
  }
  lock.unlock();
  int tries = 0;
  keepTrying([&] { return tries++ < kLastTries; }, [this] { drain(true); });
}

// What it could not do for want of memory it does the next time.
void Recorder::drain(bool all) {
  watchFaults(all);
  const bool for_pages = settings_.pages && settings_.file.empty();
  try {
    if (for_pages) followPages();
    if (file_) writeFile(all);
  } catch (const Error& error) {
    file_.reset();
    written_.page = 0;
    for_pages ? settings_.pages->refuse(error.what()) : tell(fmt::format("the recording ends: {}", error.what()));
  }
  if (!file_) forgetOldScenes();
  capture_.hashing.store(file_ || capture_.wanted_ns != 0, std::memory_order_relaxed);
}

void Recorder::writeFile(bool all) {
  if (scenes_.hasLost()) return endRecording("there was no memory to keep a scene for it");
  writeTicks(all);
  writeSteps(all);
  scene_writer_.writePoses(monotonicNow_ns(), [this](const proto::RecordingBlock& block) { file_->write(block); });
  if (written_.page != 0)
    tellPages();
  else if (all)
    endRecording("stopped");
  else if (file_->bytes() > settings_.most_bytes)
    endRecording(fmt::format("{} bytes are reached", settings_.most_bytes));
}

// Where a page may ask for another recording the last one stays: the loops may be in it for long.
void Recorder::writeScenes() {
  while (const auto scene = scenes_.next()) {
    scene_writer_.write(*scene, [this](const proto::RecordingBlock& block) { file_->write(block); });
    scenes_.written(settings_.pages != nullptr);
  }
}

// Ticks are counted before the scenes that they may have taken are asked for.
void Recorder::writeTicks(bool all) {
  const std::uint64_t end = ticks_.pushed();
  const std::uint64_t block = countOf(kBlock_s, std::max(session_.servo_rate_Hz, session_.proxy_rate_Hz));
  if (!all && end - written_.ticks < block) return;
  writeScenes();
  forRuns(ticks_, written_.ticks, end, 4 * block, [this](const std::vector<TickRecord>& run, std::uint64_t first) {
    proto::RecordingBlock out;
    toProto(run, first - written_.first_tick, *out.mutable_ticks());
    file_->write(out);
  });
}

void Recorder::writeSteps(bool all) {
  const std::uint64_t end = steps_.pushed();
  const std::uint64_t block = countOf(kBlock_s, session_.servo_rate_Hz);
  if (!all && end - written_.steps < block) return;
  forRuns(steps_, written_.steps, end, 4 * block, [this](const std::vector<ServoRecord>& run, std::uint64_t first) {
    proto::RecordingBlock out;
    toProto(run, first - written_.first_step, *out.mutable_steps());
    file_->write(out);
  });
}

void Recorder::endRecording(const std::string& reason) {
  proto::RecordingBlock end;
  end.mutable_end()->set_reason(reason);
  file_->write(end);
  const auto file = std::move(file_);
  if (std::exchange(written_.page, 0) != 0) return settings_.pages->keep(file->file(), reason, monotonicNow_ns());
  tell(fmt::format("recorded: {} ({} bytes; {})", file->path(), file->bytes(), reason));
}

// A recording that a page wants begins when the proxy's memory is known, and ends when the page does not want it.
void Recorder::followPages() {
  const auto wanted = settings_.pages->wanted(monotonicNow_ns());
  if (written_.page != 0 && wanted != written_.page) return endForPage();
  if (written_.page != 0) return;
  if (wanted) return beginForPage(*wanted);
  if (settings_.pages->status().phase == PageRecordingStatus::Phase::kStarting) settings_.pages->drop();
  capture_.wanted_ns = 0;
}

void Recorder::beginForPage(std::uint32_t page) {
  const std::int64_t now_ns = monotonicNow_ns();
  if (capture_.wanted_ns == 0) {
    capture_.wanted_ns = now_ns;
    wantCapture();
  } else if (captured(now_ns)) {
    openForPage(page);
  }
}

// While the loops may write to it nothing here does.
void Recorder::wantCapture() {
  capture_.hashing.store(true, std::memory_order_relaxed);
  if (capture_.phase.load(std::memory_order_acquire) != Capture::kWanted)
    capture_.bodies.reserve(scenes_.mostBodies(), scenes_.mostJoints());
  capture_.phase.store(Capture::kWanted, std::memory_order_release);
}

// The next tick must be in the scene of the last one: what the proxy keeps for a change of scenes is not recorded.
bool Recorder::captured(std::int64_t now_ns) {
  constexpr double kMaxWait_s = 2;
  if (1e-9 * static_cast<double>(now_ns - capture_.wanted_ns) > kMaxWait_s)
    throw Error("the loops make no ticks now, or the scene changes all the time: try again later");
  TickRecord next;
  if (capture_.phase.load(std::memory_order_acquire) != Capture::kTaken || ticks_.pushed() == capture_.next_tick)
    return false;
  const bool goes_on = ticks_.read(capture_.next_tick, next) && next.scene == capture_.scene;
  if (capture_.has_room && goes_on && scenes_.beginAt(capture_.scene)) return true;
  wantCapture();
  return false;
}

void Recorder::openForPage(std::uint32_t page) {
  // Each primitive takes a few indices, and a share of the vertices: no fewer bytes than this.
  constexpr std::uint64_t kLeast_bytes = 8;
  capture_.wanted_ns = 0;
  if (scenes_.next()->primitives * kLeast_bytes > PageRecordings::kMaxBytes)
    throw Error("the scene is too large for a recording by the page: use hl record");
  scene_writer_ = SceneWriter();
  begin_ = {unixNow_ms(), monotonicNow_ns()};
  written_.first_tick = written_.ticks = capture_.next_tick;
  written_.first_step = written_.steps = steps_.pushed();
  auto file = std::make_unique<RecordingWriter>(makePrivateFile(), "the recording");
  file->write(startBlock(FaultReason::kNone));
  proto::RecordingBlock memory;
  toProto(capture_.memory, *memory.mutable_proxy());
  if (capture_.has_bodies) toProto(capture_.bodies, *memory.mutable_proxy()->mutable_bodies());
  file->write(memory);
  file_ = std::move(file);
  written_.page = page;
  writeScenes();
  tellPages();
}

void Recorder::endForPage() {
  if (settings_.pages->abandoned()) {
    file_.reset();
    written_.page = 0;
    return settings_.pages->drop();
  }
  writeTicks(true);
  writeSteps(true);
  endRecording("stopped");
}

void Recorder::tellPages() {
  const double time_s = 1e-9 * static_cast<double>(monotonicNow_ns() - begin_.monotonic_ns);
  settings_.pages->tell(time_s, file_->bytes());
  if (file_->bytes() > PageRecordings::kMaxBytes)
    endRecording(fmt::format("{} MB are reached", PageRecordings::kMaxBytes / 1'000'000));
  else if (time_s > PageRecordings::kMaxTime_s)
    endRecording(fmt::format("{:.0f} minutes are reached", PageRecordings::kMaxTime_s / 60));
}

// A recording may begin at any time, in the scene of the last tick.
void Recorder::forgetOldScenes() {
  TickRecord last;
  const std::uint64_t ticks = ticks_.pushed();
  const bool ticked = ticks > 0 && ticks_.read(ticks - 1, last);
  scenes_.forgetBefore(ticked ? std::optional(last.scene) : std::nullopt);
}

// A fault is written a little after it was; a stall at once, as no more steps may come.
void Recorder::watchFaults(bool all) {
  if (settings_.black_box_folder.empty()) return;
  if (stalled_.exchange(false, std::memory_order_acquire)) writeBlackBox(steps_.pushed(), FaultReason::kStalled);
  const std::uint64_t fault = fault_.load(std::memory_order_acquire);
  if (fault == written_.fault) return;
  const std::uint64_t end = fault + countOf(kAfter_s, session_.servo_rate_Hz);
  if (!all && steps_.pushed() < end) return;
  written_.fault = fault;
  ServoRecord record;
  if (!steps_.read(fault - 1, record)) return;
  writeBlackBox(std::min(end, steps_.pushed()), record.out.fault);
}

void Recorder::writeBlackBox(std::uint64_t end, FaultReason reason) {
  const std::filesystem::path folder = settings_.black_box_folder;
  try {
    std::filesystem::create_directories(folder);
    removeOldest(folder, settings_.black_boxes - 1);
    RecordingWriter box((folder / blackBoxName()).string());
    box.write(startBlock(reason));
    std::uint64_t next = end - std::min(end, countOf(kBlackBox_s + kAfter_s, session_.servo_rate_Hz));
    forRuns(steps_, next, end, countOf(1, session_.servo_rate_Hz),
            [&box](const std::vector<ServoRecord>& run, std::uint64_t first) {
              proto::RecordingBlock out;
              toProto(run, first, *out.mutable_steps());
              box.write(out);
            });
    proto::RecordingBlock last;
    last.mutable_end()->set_reason("black box");
    box.write(last);
    tell(fmt::format("fault: {}; black box: {}", faultText(reason), box.path()));
  } catch (const std::exception& error) {
    tell(fmt::format("fault: {}; no black box: {}", faultText(reason), error.what()));
  }
}

proto::RecordingBlock Recorder::startBlock(FaultReason reason) const {
  proto::RecordingBlock block;
  proto::RecordingStart& start = *block.mutable_start();
  start.set_version(settings_.version);
  start.set_begin_unix_ms(begin_.unix_ms);
  start.set_begin_ns(begin_.monotonic_ns);
  start.set_black_box(reason != FaultReason::kNone);
  start.set_fault(faultText(reason));
  start.set_device_name(session_.device.name);
  toProto(valuesOf(session_.device), *start.mutable_device());
  toProto(valuesOf(session_.proxy), *start.mutable_proxy());
  start.set_servo_rate_hz(session_.servo_rate_Hz);
  start.set_proxy_rate_hz(session_.proxy_rate_Hz);
  return block;
}

void Recorder::tell(const std::string& line) const {
  if (settings_.tell) settings_.tell(line);
}

MakeStepSink recorderWith(const RecorderSettings& settings) {
  return [settings](const SessionInfo& session) { return std::make_unique<Recorder>(settings, session); };
}

}  // namespace hl

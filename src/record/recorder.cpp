#include "record/recorder.h"

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
#include "record/record_runs.h"
#include "record/recorded_servo.h"

namespace hl {

namespace {

// The rings hold a second more than a black box: time enough to write it before it is overwritten.
constexpr double kRing_s = BlackBoxes::kBefore_s + 1;
constexpr auto kPeriod = std::chrono::milliseconds(20);
// A block holds a tenth of a second, or what there is at the end; more makes files smaller and loses more to a kill.
constexpr double kBlock_s = 0.1;
// What is left at the end is worth more than one try, and the end must come.
constexpr int kLastTries = 10;

std::size_t room(bool wanted, double rate_Hz) { return wanted ? static_cast<std::size_t>(kRing_s * rate_Hz) : 1; }

bool recordsAny(const RecorderSettings& settings) {
  return !settings.file.empty() || settings.pages || !settings.black_box_folder.empty() || settings.report;
}

std::int64_t unixNow_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

}  // namespace

Recorder::Recorder(const RecorderSettings& settings, const SessionInfo& session)
    : settings_(settings),
      session_(session),
      begin_{unixNow_ms(), monotonicNow_ns()},
      steps_(room(recordsAny(settings), session.servo_rate_Hz)),
      ticks_(room(recordsAny(settings), std::max(session.servo_rate_Hz, session.proxy_rate_Hz))),
      boxes_(settings_, {steps_, ticks_, session.servo_rate_Hz, session.label.name},
             [this](FaultReason why) { return startBlock(why); }) {
  hashing_ = !settings_.file.empty();
  if (settings_.file.empty()) return;
  file_ = std::make_unique<RecordingWriter>(settings_.file);
  file_->write(startBlock(FaultReason::kNone));
}

Recorder::~Recorder() { stop(); }

void Recorder::start() {
  if (!recordsAny(settings_)) return;
  running_ = true;
  thread_ = startThread("recorder", [this] { run(); });
}

void Recorder::stop() {
  {
    const std::lock_guard lock(mutex_);
    running_ = false;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Recorder::step(const ServoRecord& record) noexcept {
  steps_.push(record);
  boxes_.step(record);
}

void Recorder::tick(const TickRequest& request, const ProxyStep& step, const ProxyLoop& proxy,
                    std::int64_t work_ns) noexcept {
  const HashedSteps hashed = hashing_.load(std::memory_order_relaxed) ? HashedSteps::kAll : HashedSteps::kSome;
  ticks_.push({request, step.scene, step.held.target, proxy.state().position, step.report.contacts.size(), work_ns,
               step.report.used_up_at, worldHash(proxy, hashed)});
  capture_.memory.take(proxy, step.scene, ticks_.pushed());
  boxes_.tick(proxy, step.scene, ticks_.pushed());
}

void Recorder::scene(std::shared_ptr<const Snapshot> scene) noexcept {
  if (!settings_.black_box_folder.empty()) boxes_.scene(scene);
  if (!settings_.file.empty() || settings_.pages) scenes_.push(std::move(scene));
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
  boxes_.look(all);
  const bool for_pages = settings_.pages && settings_.file.empty();
  try {
    if (for_pages) followPages();
    if (file_) writeFile(all);
  } catch (const Error& error) {
    file_.reset();
    written_.page = 0;
    for_pages ? settings_.pages->refuse(error.what()) : lose(fmt::format("the recording ends: {}", error.what()));
  }
  if (!file_) forgetOldScenes();
  hashing_.store(file_ || capture_.wanted_ns != 0, std::memory_order_relaxed);
}

void Recorder::writeFile(bool all) {
  if (scenes_.hasLost()) {
    if (settings_.lost && written_.page == 0) settings_.lost();
    return endRecording("there was no memory to keep a scene for it");
  }
  writeTicks(all);
  writeSteps(all);
  scene_writer_.writePoses(monotonicNow_ns(), [this](const proto::RecordingBlock& block) { file_->write(block); });
  if (written_.page != 0)
    reportToPages();
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
  const std::uint64_t block = countIn(kBlock_s, std::max(session_.servo_rate_Hz, session_.proxy_rate_Hz));
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
  const std::uint64_t block = countIn(kBlock_s, session_.servo_rate_Hz);
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
  report(fmt::format("recorded: {} ({} bytes; {})", file->path(), file->bytes(), reason));
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
    hashing_.store(true, std::memory_order_relaxed);
    capture_.memory.want(scenes_);
  } else if (captured(now_ns)) {
    openForPage(page);
  }
}

bool Recorder::captured(std::int64_t now_ns) {
  constexpr double kMaxWait_s = 2;
  if (seconds(now_ns - capture_.wanted_ns) > kMaxWait_s)
    throw Error("the loops make no ticks now, or the scene changes all the time: try again later");
  const MemoryCapture::State state = capture_.memory.stateAmong(ticks_);
  if (state == MemoryCapture::State::kWaiting) return false;
  if (state == MemoryCapture::State::kReady && scenes_.beginAt(capture_.memory.scene())) return true;
  capture_.memory.want(scenes_);
  return false;
}

void Recorder::openForPage(std::uint32_t page) {
  // Each primitive takes a few indices, and a share of the vertices: no fewer bytes than this.
  constexpr std::uint64_t kMin_bytes = 8;
  capture_.wanted_ns = 0;
  if (scenes_.next()->primitives * kMin_bytes > PageRecordings::kMaxBytes)
    throw Error("the scene is too large for a recording by the page: use hl record");
  scene_writer_ = SceneWriter();
  begin_ = {unixNow_ms(), monotonicNow_ns()};
  written_.first_tick = written_.ticks = capture_.memory.nextTick();
  written_.first_step = written_.steps = steps_.pushed();
  auto file = std::make_unique<RecordingWriter>(makePrivateFile(), "the recording");
  file->write(startBlock(FaultReason::kNone));
  file->write(capture_.memory.block());
  file_ = std::move(file);
  written_.page = page;
  writeScenes();
  reportToPages();
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

void Recorder::reportToPages() {
  const double time_s = seconds(monotonicNow_ns() - begin_.monotonic_ns);
  settings_.pages->report(time_s, file_->bytes());
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

proto::RecordingBlock Recorder::startBlock(FaultReason reason) const {
  proto::RecordingBlock block;
  proto::RecordingStart& start = *block.mutable_start();
  start.set_version(settings_.version);
  start.set_begin_unix_ms(begin_.unix_ms);
  start.set_begin_ns(begin_.monotonic_ns);
  start.set_black_box(reason != FaultReason::kNone);
  start.set_fault(faultText(reason));
  start.set_device_name(session_.device.name);
  start.set_device_label(session_.label.name);
  start.set_device_number(session_.label.number);
  start.set_devices(session_.label.of);
  toProto(valuesOf(session_.device), *start.mutable_device());
  toProto(valuesOf(session_.proxy), *start.mutable_proxy());
  start.set_servo_rate_hz(session_.servo_rate_Hz);
  start.set_proxy_rate_hz(session_.proxy_rate_Hz);
  return block;
}

void Recorder::lose(const std::string& line) const {
  report(line);
  if (settings_.lost) settings_.lost();
}

void Recorder::report(const std::string& line) const {
  if (settings_.report) settings_.report(session_.label.name, line);
}

std::string recordingOf(const std::string& file, const std::string& device) {
  const std::filesystem::path path(file);
  const std::string name = path.stem().string() + "-" + device + path.extension().string();
  return (path.parent_path() / name).string();
}

MakeStepSink recorderWith(const RecorderSettings& settings) {
  return [settings](const SessionInfo& session) {
    RecorderSettings own = settings;
    if (own.several && !own.file.empty()) own.file = recordingOf(own.file, session.label.name);
    if (session.label.number != 0) own.pages = nullptr;
    return std::make_unique<Recorder>(own, session);
  };
}

}  // namespace hl

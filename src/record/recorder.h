// Recorder: what the loops did, kept for later. The loops push each step and tick into rings of the last seconds and
// never wait; a thread of its own reads them and writes files (docs/recording.md): the session as it goes on, or a part
// of it that a page asks for, and, when the servo goes into fault, a black box of the seconds before.
#pragma once

#include <recording.pb.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "base/log_ring.h"
#include "control/servo_record.h"
#include "record/page_recordings.h"
#include "record/recorded_scene.h"
#include "record/recorded_ticks.h"
#include "record/recording_file.h"
#include "record/scene_queue.h"
#include "touch/step_sink.h"

namespace hl {

struct RecorderSettings {
  std::string file;                              ///< of the session; empty: it is not recorded
  std::uint64_t most_bytes = 4'000'000'000;      ///< of that file; then the recording ends, not the session
  std::shared_ptr<PageRecordings> pages;         ///< what pages ask for; null, or with a file: they cannot
  std::string black_box_folder;                  ///< made when needed; empty: no black boxes
  std::size_t black_boxes = 20;                  ///< kept there, >= 1; the oldest go
  std::string version;                           ///< of HL, for the files
  std::function<void(const std::string&)> tell;  ///< gets a line when a file is written or can not be; or empty
};

/// Made, started, stopped and destroyed by one thread.
class Recorder final : public StepSink {
 public:
  static constexpr double kBlackBox_s = 5;

  /// Makes the file of the session. Throws hl::Error.
  Recorder(const RecorderSettings& settings, const SessionInfo& session);
  ~Recorder() override;
  void start() override;
  void stop() override;  ///< writes what is left

  void step(const ServoRecord& record) noexcept override;
  void tick(const TickRequest& request, const ProxyStep& step, const ProxyLoop& proxy,
            std::int64_t work_ns) noexcept override;
  /// Without memory for it the recording ends.
  void scene(std::shared_ptr<const Snapshot> scene) noexcept override;
  void stall() noexcept override { stalled_.store(true, std::memory_order_release); }

 private:
  /// One moment on two clocks.
  struct RecordingBegin {
    std::int64_t unix_ms, monotonic_ns;
  };
  /// How far it has come.
  struct Written {
    std::uint64_t steps = 0, ticks = 0;            // numbers of the next
    std::uint64_t first_step = 0, first_tick = 0;  // of the file
    std::uint64_t fault = 0;                       // the last
    std::uint32_t page = 0;                        // whose recording the file is; 0: no page's
  };
  /// What the proxy and the bodies remembered after a tick, taken by the loop that made it, when the recorder's thread
  /// wants it.
  struct Capture {
    enum Phase { kNone, kWanted, kTaken };
    std::atomic<Phase> phase{kNone};
    std::atomic<bool> hashing{false};  // ticks are for a file: they get hashes of the bodies
    ProxyMemory memory;
    BodiesMemory bodies;  // with room for those of the scenes that are waited for
    bool has_bodies = false, has_room = false;
    std::uint64_t scene = 0, next_tick = 0;
    std::int64_t wanted_ns = 0;
  };

  void run();
  void drain(bool all);
  void writeFile(bool all);
  void writeScenes();
  void writeTicks(bool all);
  void writeSteps(bool all);
  void endRecording(const std::string& reason);
  void followPages();
  void beginForPage(std::uint32_t page);
  void wantCapture();
  bool captured(std::int64_t now_ns);
  void openForPage(std::uint32_t page);
  void endForPage();
  void tellPages();
  void forgetOldScenes();
  void watchFaults(bool all);
  void writeBlackBox(std::uint64_t end, FaultReason reason);
  proto::RecordingBlock startBlock(FaultReason reason) const;
  void tell(const std::string& line) const;

  const RecorderSettings settings_;
  const SessionInfo session_;
  RecordingBegin begin_;  // of the file
  LogRing<ServoRecord> steps_;
  LogRing<TickRecord> ticks_;
  std::atomic<std::uint64_t> fault_{0};  // 1 + number of the step that went into fault last; 0: none
  std::atomic<bool> stalled_{false};
  SceneQueue scenes_;

  // Of the recorder's thread.
  std::unique_ptr<RecordingWriter> file_;
  SceneWriter scene_writer_;
  Written written_;

  Capture capture_;

  std::mutex mutex_;
  std::condition_variable wake_;
  bool running_ = false;
  std::thread thread_;
};

/// For TouchSettings.
MakeStepSink recorderWith(const RecorderSettings& settings);

}  // namespace hl

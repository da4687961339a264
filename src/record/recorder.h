// Recorder: what the loops did, kept for later. The loops push each step and tick into rings of the last seconds and
// never wait; a thread of its own reads them and writes files (docs/recording.md): the session as it goes on, or a part
// of it that a page asks for, and, when the servo goes into fault, a black box of the seconds before.
#pragma once

#include <recording.pb.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "base/log_ring.h"
#include "control/servo_record.h"
#include "record/black_boxes.h"
#include "record/memory_capture.h"
#include "record/recorded_scene.h"
#include "record/recorded_ticks.h"
#include "record/recorder_settings.h"
#include "record/recording_file.h"
#include "record/scene_queue.h"
#include "touch/step_sink.h"

namespace hl {

/// Made, started, stopped and destroyed by one thread.
class Recorder final : public StepSink {
 public:
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
  void stall() noexcept override { boxes_.stall(); }

 private:
  /// One moment on two clocks.
  struct RecordingBegin {
    std::int64_t unix_ms, monotonic_ns;
  };
  /// How far it has come.
  struct Written {
    std::uint64_t steps = 0, ticks = 0;            // numbers of the next
    std::uint64_t first_step = 0, first_tick = 0;  // of the file
    std::uint32_t page = 0;                        // whose recording the file is; 0: no page's
  };
  /// Where a recording of a page begins.
  struct PageCapture {
    MemoryCapture memory;
    std::int64_t wanted_ns = 0;  // since when; 0: it is not
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
  bool captured(std::int64_t now_ns);
  void openForPage(std::uint32_t page);
  void endForPage();
  void reportToPages();
  void forgetOldScenes();
  proto::RecordingBlock startBlock(FaultReason reason) const;
  void report(const std::string& line) const;
  void lose(const std::string& line) const;

  const RecorderSettings settings_;
  const SessionInfo session_;
  RecordingBegin begin_;  // of the file
  LogRing<ServoRecord> steps_;
  LogRing<TickRecord> ticks_;
  SceneQueue scenes_;
  BlackBoxes boxes_;

  // Of the recorder's thread.
  std::unique_ptr<RecordingWriter> file_;
  SceneWriter scene_writer_;
  Written written_;
  PageCapture capture_;
  std::atomic<bool> hashing_{false};  // ticks are for a file: they get hashes of the bodies

  std::mutex mutex_;
  std::condition_variable wake_;
  bool running_ = false;
  std::thread thread_;
};

/// For TouchSettings.
MakeStepSink recorderWith(const RecorderSettings& settings);

}  // namespace hl

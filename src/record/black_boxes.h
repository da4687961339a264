// Black boxes: when the servo goes into fault, the seconds before it go into a file of their own: the servo steps, and
// what proxy and bodies did, as far back as the scene has been the same (docs/recording.md).
#pragma once

#include <recording.pb.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>

#include "control/servo_record.h"
#include "record/memory_capture.h"
#include "record/recorder_settings.h"
#include "record/recording_file.h"

namespace hl {

/// The rings of the loops, which go on.
struct LoopRings {
  const LogRing<ServoRecord>& steps;
  const LogRing<TickRecord>& ticks;
  double servo_rate_Hz;
  std::string device;  ///< its name; empty: there is one
};

/// step(), tick() and stall() by the loops, RT-safe; scene() by any thread but those; look() by the recorder's.
class BlackBoxes {
 public:
  static constexpr double kBefore_s = 5;

  /// `start`: the first block of a file.
  BlackBoxes(const RecorderSettings& settings, const LoopRings& rings,
             std::function<proto::RecordingBlock(FaultReason)> start);

  /// After it was pushed.
  void step(const ServoRecord& record) noexcept;
  /// The same. The next tick has this number.
  void tick(const ProxyLoop& proxy, std::uint64_t scene, std::uint64_t next_tick) noexcept {
    capture_.take(proxy, scene, next_tick);
  }
  void stall() noexcept { stalled_.store(true, std::memory_order_release); }
  void scene(std::shared_ptr<const Snapshot> scene) noexcept { scenes_.push(std::move(scene)); }
  /// Again and again. `all`: there will be no more steps.
  void look(bool all);

 private:
  /// From where a box may show what the proxy and the bodies did.
  struct Checkpoint {
    proto::RecordingBlock memory;
    std::uint64_t next_tick = 0;
    std::int64_t time_ns = 0;
  };

  bool isOn() const { return !settings_.black_box_folder.empty(); }
  void remember();
  void followScene(std::uint64_t scene);
  void write(std::uint64_t end, FaultReason reason);
  void writeSteps(RecordingWriter& box, std::uint64_t end) const;
  void writeWorld(RecordingWriter& box) const;
  void report(const std::string& line) const;

  const RecorderSettings& settings_;
  const LoopRings rings_;
  const std::function<proto::RecordingBlock(FaultReason)> start_;
  std::atomic<std::uint64_t> fault_{0};  // 1 + number of the step that went into fault last; 0: none
  std::atomic<bool> stalled_{false};
  SceneQueue scenes_;
  MemoryCapture capture_;

  // Of the recorder's thread.
  std::uint64_t written_fault_ = 0;
  std::shared_ptr<const Snapshot> scene_;  // of the checkpoints
  std::deque<Checkpoint> checkpoints_;     // the oldest first
};

}  // namespace hl

// ReplayedFile: a recording as it is read on. Its servo steps are made again at once; its scenes and ticks are given
// out in their order.
#pragma once

#include <recording.pb.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "record/recorded_scene.h"
#include "record/recorded_ticks.h"
#include "record/recording_file.h"
#include "record/replay_report.h"

namespace hl {

/// The servo again. A gap, and each block after a difference, begins with the state that is recorded.
class ServoReplay {
 public:
  explicit ServoReplay(ReplayReport& report) : report_(report) {}
  void play(const proto::ServoSteps& message, std::int64_t begin_ns, const StepVisitor& visit);

 private:
  void step(const ServoRecord& record, double time_s);
  void differ(std::uint64_t number, double time_s, std::string text);

  ReplayReport& report_;
  ServoState state_;
  std::uint64_t next_ = 0;
  bool begun_ = false;
};

struct ReplayedScene {
  std::uint64_t identity = 0;
  std::shared_ptr<const Snapshot> snapshot;
};

struct ReplayedTick {
  TickRecord record;
  std::uint64_t number = 0;
  bool known = true;  ///< false: ticks before it are missing, so what the proxy did is not known
};

/// That names its file.
class ErrorOfFile : public Error {
  using Error::Error;
};

/// One thread. Everything throws ErrorOfFile when it makes no sense.
class ReplayedFile {
 public:
  using AddScene = std::function<void(ReplayedScene)>;

  ReplayedFile(const std::string& path, StepVisitor visit);
  ReplayedFile(const ReplayedFile&) = delete;
  ReplayedFile& operator=(const ReplayedFile&) = delete;

  /// Who gets its scenes, before the first tick in each; nobody: they are left out.
  void giveScenesTo(AddScene add) { add_ = std::move(add); }
  /// The next block is read; false: there is none.
  bool readOn();
  /// The next tick; null: there is none any more. Reads on where it must.
  const ReplayedTick* tick();
  void popTick() { ticks_.pop_front(); }

  const proto::RecordingStart& start() const { return start_; }
  ProxySettings proxySettings() const;
  double time_s(std::int64_t time_ns) const;  ///< since the recording began
  /// Of a recording that begins within a session.
  const std::optional<ProxyMemory>& memory() const { return memory_; }
  const std::optional<BodiesMemory>& bodies() const { return bodies_; }
  ReplayReport& report() { return report_; }
  /// `why` with the name of the file.
  [[nodiscard]] ErrorOfFile errorOf(const std::exception& why) const;

 private:
  void take(const proto::RecordingBlock& block);
  void takeScenes(const proto::RecordingBlock& block);
  void take(const proto::ProxyTicks& message);

  const std::string path_;
  const StepVisitor visit_;
  RecordingReader reader_;
  proto::RecordingStart start_;
  ReplayReport report_;
  ServoReplay servo_{report_};
  SceneReader scenes_;
  AddScene add_;
  std::optional<ProxyMemory> memory_;
  std::optional<BodiesMemory> bodies_;
  std::deque<ReplayedTick> ticks_;  // read, and not taken yet
  std::uint64_t next_tick_ = 0;
  bool known_ = true;
};

}  // namespace hl

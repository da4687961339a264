// Isolated: runs a parser of foreign files in a child process that may only read files and answer, with limits on time
// and memory. A corrupt or hostile file ends the child and not HL, and what comes of it is checked.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "io/cloud_sink.h"
#include "io/height_sink.h"
#include "io/volume_sink.h"
#include "scene/scene_model.h"

namespace hl {

struct IsolationLimits {
  unsigned cpu_s = 120;  ///< processor time of the parser
  /// Of the parser, and of the scene that it gives. Or the machine's memory, where that is less.
  std::size_t memory_bytes = std::size_t{12} << 30;
  /// Of the samples of height fields and volumes and the points of clouds, which the parser need not hold. Or the
  /// machine's memory, where that is less.
  std::size_t samples_bytes = std::numeric_limits<std::size_t>::max();
  double wall_s = 600;  ///< from beginning to end
  double idle_s = 10;   ///< without using the processor or giving anything: it waits for what will not come
};

/// To whom a parser reports how far it is, and gives samples.
class ReadingReport {
 public:
  ReadingReport(std::function<void(double fraction)> progress, HeightSink& heights, VolumeSink& volume,
                CloudSink& cloud)
      : progress_(std::move(progress)), heights_(heights), volume_(volume), cloud_(cloud) {}
  void operator()(double fraction) const { progress_(fraction); }
  /// One field, volume or cloud at most; it goes with the scene that the parser returns.
  HeightSink& heights() const { return heights_; }
  VolumeSink& volume() const { return volume_; }
  CloudSink& cloud() const { return cloud_; }

 private:
  std::function<void(double fraction)> progress_;
  HeightSink& heights_;
  VolumeSink& volume_;
  CloudSink& cloud_;
};

using Parse = std::function<SceneModel(const ReadingReport& report)>;

/// Forks, runs `parse` in the child and returns its scene. Throws hl::Error (with `name` in front) with what parse
/// threw, or with what became of the child; then it is gone. The child has no descriptors but its pipe, and a sandbox
/// where the kernel has one (io/sandbox.h); where it has none, the scene has a warning. Call it before the program
/// starts threads: only the calling one goes along.
/// `progress` is called here, with fractions that the child's parse reports through its argument.
SceneModel runIsolated(const std::string& name, const IsolationLimits& limits, const Parse& parse,
                       const std::function<void(double)>& progress);

/// What a reading program is started with: its file, and its words, the name first.
struct ReaderProgram {
  std::string file;
  std::vector<std::string> words;
};

/// The same from a process with threads, which must not fork: starts `program`, with `descriptor` as its standard input
/// and the pipe as its standard output; it calls answerAsProgram(). Ends, with an error, soon after `given_up` is set.
SceneModel runProgram(const std::string& name, const IsolationLimits& limits, const ReaderProgram& program,
                      int descriptor, const std::atomic<bool>& given_up,
                      const std::function<void(double)>& progress = {});

/// In that program, before it has done anything else: does what the child of runIsolated() does, and ends. The file is
/// kKeptFile of io/sandbox.h.
[[noreturn]] void answerAsProgram(const IsolationLimits& limits, const Parse& parse);

}  // namespace hl

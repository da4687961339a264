// PageRecordings: what pages ask of the recorder. One recording at a time, into a private file without a name, which is
// gone when nobody has it open any more, however the program ends. A page repeats what it asks for; when it falls
// silent its recording ends and is removed.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "record/private_file.h"

namespace hl {

/// Of the recording that a page has asked for, or of the last one.
struct PageRecordingStatus {
  enum class Phase { kNone, kStarting, kRunning, kReady };
  Phase phase = Phase::kNone;
  std::uint32_t owner = 0;
  double time_s = 0;
  std::uint64_t bytes = 0;
  std::string text;         ///< why there is none, or why it has ended; one line
  std::uint64_t begun = 0;  ///< recordings so far
};

/// Any thread.
class PageRecordings {
 public:
  static constexpr double kMaxTime_s = 600;
  static constexpr std::uint64_t kMaxBytes = 200'000'000;
  static constexpr double kMaxSilence_s = 5;
  /// So long is a finished one kept for its page to fetch.
  static constexpr double kKept_s = 60;

  // For pages.
  /// `owner` > 0 wants a recording, or no longer. Changes nothing while another one's runs.
  void ask(std::uint32_t owner, bool on, std::int64_t now_ns);
  PageRecordingStatus status() const;
  /// The finished recording of `owner`, to be read by a descriptor of its own; null: there is none.
  FilePointer open(std::uint32_t owner) const;

  // For the recorder.
  /// Who wants a recording now, if anybody. What is out of date is removed.
  std::optional<std::uint32_t> wanted(std::int64_t now_ns);
  /// Whether its page has gone without a word.
  bool abandoned() const;
  void refuse(const std::string& why);
  void report(double time_s, std::uint64_t bytes);
  void keep(FilePointer file, const std::string& reason, std::int64_t now_ns);
  void drop();

 private:
  void clear(std::string text);  // holding mutex_

  mutable std::mutex mutex_;
  PageRecordingStatus status_;
  bool wanted_ = false, abandoned_ = false;
  std::int64_t heard_ns_ = 0, ready_ns_ = 0;
  FilePointer file_;
};

}  // namespace hl

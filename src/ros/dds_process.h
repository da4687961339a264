// DdsProcess: a program that speaks DDS for a server, started with a socket to it. What comes from a network ends that
// program at the worst, and not the loops that hold somebody's hand.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hl {

/// Where a program is that HL brings along, and what to do without it.
struct DdsProgram {
  const char* name;
  const char* absent;  ///< reported where it is not
};

/// Ends with this object. One thread at a time; after the start nothing but wait() and startAgain() waits.
class DdsProcess {
 public:
  /// Returns when others can find what it serves. Throws hl::Error, with what to do, when the program is not there or
  /// cannot serve these words.
  DdsProcess(const DdsProgram& program, const std::vector<std::string>& words);
  ~DdsProcess() { end(); }
  DdsProcess(const DdsProcess&) = delete;
  DdsProcess& operator=(const DdsProcess&) = delete;

  /// Until there is a packet, or the program has ended; `most_ns` at most.
  void wait(std::int64_t most_ns) const;
  /// After its end, with the same words, as the constructor. False: it cannot serve now.
  bool startAgain();
  /// False: the program is behind, or has ended.
  bool send(std::span<const char> packet) const;
  /// The next one that has come, in `buffer`; one that is longer is cut.
  std::optional<std::span<const char>> receive(std::span<char> buffer);
  bool ended() const { return ended_; }

 private:
  void start();
  void waitUntilReady() const;
  void end();

  const DdsProgram program_;
  const std::vector<std::string> words_;
  int socket_ = -1;
  pid_t id_ = 0;
  bool ended_ = false;
};

/// Where the program is; empty: nowhere.
std::string placeOf(const DdsProgram& program);

}  // namespace hl

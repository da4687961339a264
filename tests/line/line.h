// Line: hl_line for tests in C++: network namespaces joined by a bad line, for sockets of this program and for programs
// that it starts.
#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "line/hub.h"

namespace hl::line {

class Line {
 public:
  /// `order` as in orders.h; the namespaces are there when it returns. Throws LineRefused where this machine does not
  /// allow them, hl::Error when there is no line for another reason.
  explicit Line(int ends, const std::string& order = {}, std::uint64_t seed = 1);
  /// Ends hl_line. Programs that are still in the namespaces have no device any more.
  ~Line();
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  /// Returns when the order has been done; what was asked for. Throws hl::Error for one that cannot be done.
  std::string say(const std::string& order);
  LinkCounts counts(int from, int to);
  /// On a thread that is in the namespace of this end: the sockets that it makes and the programs that it starts are
  /// there for good. What it throws comes here.
  void inside(int end, const std::function<void()>& act) const;
  /// Of hl_line.
  pid_t id() const { return id_; }

 private:
  // Of what hl_line says; nothing when it has ended.
  std::optional<std::string> readLine();

  pid_t id_ = 0;
  int socket_ = -1;
  std::string read_;                      // and not yet asked for
  std::vector<std::string> name_spaces_;  // files, of the ends from 1 on
};

/// Why no line can be made here, for GTEST_SKIP(); nothing where it can.
std::optional<std::string> lineRefusal();

}  // namespace hl::line

// FleetResult: what is kept of one trace.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/sha256.h"
#include "proxy/tick_report.h"
#include "tools/trace.h"

namespace hl {

/// Numbers of one trace. Counts too are doubles: they are far below 2^53.
struct FleetSummary {
  double ticks = 0, contact_ticks = 0;
  double gap_max_m = 0;                      ///< largest distance from the proxy to the finger
  double gap_mean_m = 0;                     ///< over the ticks in contact; 0 if there are none
  double force_max_N = 0, force_mean_N = 0;  ///< the same of the force
  double injected_J = 0, dissipated_J = 0;
  std::array<double, kEndings - 1> ended{};  ///< ticks by ending, in the order of Ending from the second on
};

/// The names of the members of FleetSummary, in their order; counts are whole numbers.
struct FleetColumn {
  std::string name;
  bool count = false;
};
std::vector<FleetColumn> fleetColumns();

/// t, finger, proxy, target, force (three each), contacts, iterations, injected_J: a row without its time.
inline constexpr std::size_t kFleetRowNumbers = 16;

struct FleetResult {
  std::string name;  ///< of the task
  FleetSummary summary;
  std::string rows_sha256;   ///< of all rows, with bodies and snaps
  std::vector<double> rows;  ///< kFleetRowNumbers each, if they are kept
};

/// Takes in the rows of a trace.
class FleetRecorder {
 public:
  explicit FleetRecorder(bool keeps_rows) : keeps_rows_(keeps_rows) {}
  void add(const TraceRow& row);
  FleetResult take(const std::string& name, const TraceTotals& totals);

 private:
  const bool keeps_rows_;
  FleetResult result_;
  Sha256 sha_;
};

/// The bytes of a file of results, without its digest, and back; nullopt of bytes that are none. Throws hl::Error for
/// more rows than a file may have.
std::string bytesOf(const FleetResult& result);
std::optional<FleetResult> fleetResultOf(std::string_view bytes);

}  // namespace hl

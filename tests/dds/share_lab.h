// ShareLab: three servers of a shared world in three network namespaces, joined by a bad line and guarded by keys. One
// of them has a plate that circles upright, on which the hands of the others lie.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "line/line.h"
#include "share/share_process.h"
#include "shared_server.h"

namespace hl::test {

struct LabLine {
  double delay_ms = 0, jitter_ms = 0, loss_percent = 0;
};

/// What a server far away from the plate has felt and shown.
struct LabResult {
  double staleness_p50_ms = 0, staleness_p99_ms = 0, staleness_max_ms = 0;  ///< of the plate as it is shown
  double apart_ms = 0;      ///< from the last motion until it is at the same place to the bit
  double playout_ms = 0;    ///< as the server reports it
  double least_tank_J = 1;  ///< of the hand on the plate
  double moving_J = 0;      ///< that the motion has added, as booked
  double force_mean_N = 0;  ///< on that hand
  std::uint64_t steps = 0, missed = 0, timer_missed = 0;  ///< of its servo, and of a bare timer
};

class ShareLab {
 public:
  /// Throws LineRefused where this machine allows no namespaces.
  explicit ShareLab(const LabLine& line);
  ~ShareLab();
  ShareLab(const ShareLab&) = delete;
  ShareLab& operator=(const ShareLab&) = delete;

  LabResult run(double seconds);

 private:
  std::unique_ptr<SharedServer> join(int end, const std::string& name);
  void placePlate(double time_s);

  line::Line line_;
  std::unique_ptr<SharedServer> anna_, bert_, carl_;
  std::unique_ptr<PlacedClient> plate_;
  std::shared_ptr<const Shape> shape_;
};

}  // namespace hl::test

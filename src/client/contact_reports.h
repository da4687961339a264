// ContactReports: where and how strongly the hand has pressed since the application asked last. Reports that came
// meanwhile are one: mean forces over the sum of their intervals.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace hl::client {

class ContactReports {
 public:
  void keep(bool wanted);
  void add(const proto::ContactReport& report);

  /// What came since the last call, those of the largest force first, with the vertices of their items; it is
  /// forgotten.
  struct Taken {
    HLcontactreport report{};
    std::vector<proto::PressedPoint> points;  ///< with mean forces over the whole interval
  };
  Taken take(HLuint session);
  /// The mean force on the hand of an object of the session, in what was taken last; 0: it was not touched.
  std::array<double, 3> forceOf(HLuint object) const;

 private:
  bool wanted_ = false;
  double time_s_ = 0, interval_s_ = 0;
  std::array<double, 3> impulse_Ns_{};
  std::vector<proto::PressedPoint> points_;  // force_N: the impulse, N s
  std::map<HLuint, std::array<double, 3>> last_N_;
};

}  // namespace hl::client

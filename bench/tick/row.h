// Row: one line of the benchmark's table.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "tick/cost.h"
#include "tick/peer.h"
#include "tick/timing.h"

namespace hl::bench {

/// Of a ratio or a size that has no meaning in a row.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Row {
  std::string scene, motion, radius;  ///< the radius is "fixed", or "scaled" with the mesh
  double radius_m = 0;
  std::string who, question;       ///< "hl" or a peer, and "tick" or a Question
  std::string hierarchy, surface;  ///< of HL; empty for a peer
  std::size_t primitives = 0;
  double mean_edge_m = 0;
  Timing times;                 ///< PassTimes::middle()
  Timing single;                ///< PassTimes::all()
  std::size_t capped = 0;       ///< ticks that the iteration cap ended
  std::size_t out_of_work = 0;  ///< ticks that ended as they had done all that one may
  Cost cost{kNone, kNone, kNone, kNone, kNone};
  double to_plain = kNone;  ///< mean time of this tick over that of the same without surface effects
  double to_tick = kNone;   ///< median time of this query over that of HL's whole tick
  double to_query = kNone;  ///< median time of this query over that of HL's own
  Agreement agreement;
  std::string note;  ///< what is unusual about the row
};

/// How the median tick grows: with the number of primitives to the power of `slope`.
struct Growth {
  std::string scene, motion, radius;
  double slope = 0;
  std::size_t least = 0, most = 0;  ///< primitives, of the rows that it comes from
};

}  // namespace hl::bench

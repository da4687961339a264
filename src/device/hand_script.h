// HandScript: hand goals given in advance, as samples over time with straight lines between them.
#pragma once

#include <algorithm>
#include <vector>

#include "base/vec.h"

namespace hl {

/// Times strictly increasing, in seconds; positions in metres, in the frame its user says.
struct HandScript {
  struct Sample {
    double time_s = 0;
    Vec3 position = Vec3::Zero();
  };
  std::vector<Sample> samples;

  /// Before the first sample the first position, after the last one the last. Needs at least one sample.
  Vec3 at(double time_s) const {
    const auto later = [](const Sample& sample, double t) { return sample.time_s < t; };
    const auto next = std::lower_bound(samples.begin(), samples.end(), time_s, later);
    if (next == samples.begin()) return samples.front().position;
    if (next == samples.end()) return samples.back().position;
    const auto before = next - 1;
    const double part = (time_s - before->time_s) / (next->time_s - before->time_s);
    return before->position + part * (next->position - before->position);
  }
};

}  // namespace hl

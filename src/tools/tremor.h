// Tremor: what a real hand adds to a path, drawn by a seed, so that one path becomes as many hands as wanted.
//
// On each axis the sum of kTremorWaves waves of equal size, their frequencies and phases drawn evenly:
//   d(t) = a sum_j sin(2 pi (f_j t + p_j)),  f_j in 8..12 Hz, p_j in 0..1,  a = rms sqrt(2 / kTremorWaves)
// The physiological tremor of the hand lies at 8 to 12 Hz (Elble and Koller, Tremor, 1990).
#pragma once

#include <cstdint>
#include <vector>

#include "io/csv_path.h"

namespace hl {

inline constexpr int kTremorWaves = 8;  // on each axis: enough that no beat is heard out
inline constexpr double kTremorLow_Hz = 8, kTremorHigh_Hz = 12;
inline constexpr double kMaxTremor_m = 1;

/// Adds the tremor that `seed` draws to each row: `rms_m` is its root mean square on each axis, over long times. 0 m
/// changes nothing. The same bits on every machine.
void addTremor(std::vector<PathSample>& path, double rms_m, std::uint64_t seed);

}  // namespace hl

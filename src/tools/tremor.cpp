#include "tools/tremor.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "base/plain_math.h"

namespace hl {

namespace {

struct TremorWave {
  double frequency_Hz, phase;  // phase in turns
};

// 0..1 from the upper 53 bits: the standard's own distributions differ from library to library.
double evenlyDrawn(std::mt19937_64& random) { return 0x1p-53 * static_cast<double>(random() >> 11U); }

// The part of a turn alone, as plain::sin takes no large angles.
double valueAt(const TremorWave& wave, double t) {
  const double turns = std::fmod(wave.frequency_Hz * t + wave.phase, 1.0);
  return plain::sin(2 * std::numbers::pi * turns);
}

}  // namespace

void addTremor(std::vector<PathSample>& path, double rms_m, std::uint64_t seed) {
  if (rms_m == 0) return;
  std::mt19937_64 random(seed);
  std::array<std::array<TremorWave, kTremorWaves>, 3> waves{};
  for (auto& axis : waves) {
    for (TremorWave& wave : axis) {
      wave.frequency_Hz = kTremorLow_Hz + (kTremorHigh_Hz - kTremorLow_Hz) * evenlyDrawn(random);
      wave.phase = evenlyDrawn(random);
    }
  }
  const double size_m = rms_m * std::sqrt(2.0 / kTremorWaves);
  for (PathSample& sample : path) {
    for (int axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (const TremorWave& wave : waves[static_cast<std::size_t>(axis)]) sum += valueAt(wave, sample.t);
      sample.position[axis] += size_m * sum;
    }
  }
}

}  // namespace hl

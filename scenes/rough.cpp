#include "rough.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/plain_math.h"
#include "base/splitmix64.h"
#include "surfaces.h"

namespace hl {

namespace {

constexpr double kRoughSide = 0.2;  // m
constexpr int kMaxOctaves = 8;

// Pseudo-random numbers of a member.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(splitmix64(seed)) {}
  double uniform(double low, double high) {
    state_ = splitmix64(state_);
    return low + (high - low) * 0x1p-53 * static_cast<double>(state_ >> 11);
  }

 private:
  std::uint64_t state_;
};

// Gradient noise on a lattice (Perlin, "Improving noise", 2002): in -1..1, 0 at integers, slopes about 1.
double noise(std::uint64_t seed, double x, double z) {
  const double x0 = std::floor(x), z0 = std::floor(z);
  const double fx = x - x0, fz = z - z0;
  const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const auto corner = [&](int i, int k) {
    const auto at = static_cast<std::uint64_t>(static_cast<std::int64_t>(x0) + i) * 0x1f123bb5U +
                    static_cast<std::uint64_t>(static_cast<std::int64_t>(z0) + k);
    const std::uint64_t bits = splitmix64(seed ^ splitmix64(at));
    const double gx = 0x1p-15 * static_cast<double>(bits & 0xffff) - 1;
    const double gz = 0x1p-15 * static_cast<double>(bits >> 16 & 0xffff) - 1;
    return gx * (fx - i) + gz * (fz - k);
  };
  const double a = corner(0, 0), b = corner(1, 0), c = corner(0, 1), d = corner(1, 1);
  const double u = fade(fx), v = fade(fz);
  return a + u * (b - a) + v * ((c + u * (d - c)) - (a + u * (b - a)));
}

// Detail of one size.
struct Octave {
  double per_m, height_m, cosine, sine, shift;
  bool ridged;  // sharp crests instead of smooth ones
  std::uint64_t seed;

  double at(double x, double z) const {
    const double turned_x = per_m * (cosine * x - sine * z) + shift, turned_z = per_m * (sine * x + cosine * z) - shift;
    const double n = noise(seed, turned_x, turned_z);
    return height_m * (ridged ? 0.5 - std::abs(n) : n);
  }
};

struct Rough {
  std::array<Octave, kMaxOctaves> octaves;
  int count;

  double at(double x, double z) const {
    double y = 0;
    for (int i = 0; i < count; ++i) y += octaves[static_cast<std::size_t>(i)].at(x, z);
    return y;
  }
};

// Five to eight octaves from about half the side down. The slopes of each are about a fixed fraction of those of the
// previous one.
Rough roughOf(std::uint64_t member) {
  constexpr double kLacunarity = 2;
  Dice dice(member);
  Rough rough{};
  rough.count = static_cast<int>(dice.uniform(5, kMaxOctaves + 1));
  double wavelength_m = dice.uniform(0.05, 0.12), slope = dice.uniform(0.15, 0.5);
  const double gain = dice.uniform(0.75, 1.15), ridges = dice.uniform(-0.5, 1);
  for (int i = 0; i < rough.count; ++i) {
    Octave& octave = rough.octaves[static_cast<std::size_t>(i)];
    const double angle = dice.uniform(0, 2 * M_PI);
    octave = {1 / wavelength_m,
              slope * wavelength_m,
              plain::cos(angle),
              plain::sin(angle),
              dice.uniform(0, 1000),
              dice.uniform(0, 1) < ridges,
              splitmix64(member * kMaxOctaves + static_cast<std::uint64_t>(i))};
    wavelength_m /= kLacunarity;
    slope *= gain;
  }
  return rough;
}

}  // namespace

Model makeRough(std::size_t triangles, std::uint64_t member) {
  const Rough rough = roughOf(member);
  const auto n = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(static_cast<double>(triangles) / 2))));
  return makeSurface(n, n, [&rough](double u, double v) {
    const double x = kRoughSide * (u - 0.5), z = kRoughSide * (0.5 - v);
    return Vec3(x, rough.at(x, z), z);
  });
}

}  // namespace hl

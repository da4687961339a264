// Long work cut into numbered pieces, each with a generator of its own, on as many threads as one likes. A piece knows
// nothing but its seed and its number, so the outcome does not depend on the threads, and each can be run again alone.
#pragma once

#include <fmt/core.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "geometry/scenes.h"

namespace hl::soak {

/// The generator of one piece.
inline test::Random generatorOf(std::uint64_t seed, std::uint64_t piece) {
  std::seed_seq both{seed & 0xffffffff, seed >> 32, piece & 0xffffffff, piece >> 32};
  std::uint64_t mixed[1];
  both.generate(mixed, mixed + 1);
  return test::Random(mixed[0]);
}

struct Pieces {
  std::uint64_t first = 0, end = 0, step = 1;  ///< first, first + step, ... below end
  int threads = 1;
  std::uint64_t count() const { return first < end ? (end - first + step - 1) / step : 0; }
};

/// Says on stderr, every ten seconds, how much is done and how long the rest may take.
class Progress {
 public:
  explicit Progress(std::uint64_t all) : all_(all) {}
  void add() {
    ++done_;
    const double now_s = std::chrono::duration<double>(Clock::now() - start_).count();
    if (now_s < next_s_) return;
    next_s_ = now_s + 10;
    const double part = static_cast<double>(done_) / static_cast<double>(all_);
    fmt::print(stderr, "{:5.1f} %, {:.0f} s, about {:.0f} s more\n", 100 * part, now_s, now_s * (1 - part) / part);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const std::uint64_t all_;
  const Clock::time_point start_ = Clock::now();
  std::uint64_t done_ = 0;
  double next_s_ = 10;
};

/// Calls run(piece) for each piece and collect(piece, result) with what it returned, one at a time, in any order.
template <typename Run, typename Collect>
void runPieces(const Pieces& pieces, Progress& progress, Run run, Collect collect) {
  std::atomic<std::uint64_t> next{0};
  std::mutex collecting;
  const auto work = [&] {
    for (std::uint64_t i = next++; i < pieces.count(); i = next++) {
      const std::uint64_t piece = pieces.first + i * pieces.step;
      const auto result = run(piece);
      const std::lock_guard lock(collecting);
      collect(piece, result);
      progress.add();
    }
  };
  std::vector<std::jthread> threads;
  for (int i = 0; i < pieces.threads; ++i) threads.emplace_back(work);
}

}  // namespace hl::soak

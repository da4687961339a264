#include "depth_session.h"

#include <fmt/core.h>
#include <hl/hl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <random>
#include <thread>
#include <vector>

namespace hl::bench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr HLsizei kColumns = 1280, kRows = 720;
constexpr std::array<double, 4> kCamera{1050, 1050, 0.5 * (kColumns - 1), 0.5 * (kRows - 1)};
constexpr double kUnit_m = 1e-4, kJoin = 0.02, kSmoothing = 0.9, kWall_m = 0.5, kSigma_m = 6e-4, kRadius_m = 2e-3;
constexpr double kRate_Hz = 30, kWindow_s = 5;

double secondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// A wall with waves, and noise. Some pictures that differ in their noise, as a client has no time to draw more.
class Pictures {
 public:
  Pictures() {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, kSigma_m);
    for (std::vector<HLushort>& picture : pictures_) {
      picture.reserve(std::size_t{kColumns} * kRows);
      for (HLsizei row = 0; row < kRows; ++row) {
        for (HLsizei column = 0; column < kColumns; ++column) {
          const double depth_m = kWall_m + 0.01 * std::sin(0.02 * column) * std::cos(0.03 * row) + noise(random);
          picture.push_back(static_cast<HLushort>(std::lround(depth_m / kUnit_m)));
        }
      }
    }
  }

  void send() {
    hlNewObject(1);
    hlDepthFrame(kColumns, kRows, pictures_[next_++ % pictures_.size()].data(), kCamera.data(), kUnit_m, kJoin,
                 kSmoothing);
    hlEndObject();
    hlCallObject(1);
    hlFlush();
    hlGetError();  // a server that is behind lets pictures wait: that is counted
  }

 private:
  std::array<std::vector<HLushort>, 8> pictures_;
  std::size_t next_ = 0;
};

/// Deadlines of the server.
struct Missed {
  HLint servo = 0, proxy = 0;
  Missed operator-(const Missed& other) const { return {servo - other.servo, proxy - other.proxy}; }
  void add(const Missed& more) {
    servo += more.servo;
    proxy += more.proxy;
  }
};

Missed missedSoFar() {
  Missed missed;
  hlGetIntegerv(HL_SERVO_DEADLINES_MISSED, &missed.servo);
  hlGetIntegerv(HL_PROXY_DEADLINES_MISSED, &missed.proxy);
  return missed;
}

HLint numberOf(HLenum name) {
  HLint number = 0;
  hlGetIntegerv(name, &number);
  return number;
}

class DepthSession {
 public:
  bool run(double seconds) {
    hlWorkspaced(0, 0, -kWall_m, 1);
    hlProxyd(HL_PROXY_RADIUS, kRadius_m);
    hlStateRate(100);
    pictures_.send();
    if (hlFinishTimeout(60) == HL_FALSE) return false;
    const int windows = std::max(1, static_cast<int>(std::lround(seconds / kWindow_s)));
    window_s_ = seconds / windows;
    stroke(true, nullptr);  // until the hand is there
    for (int i = 0; i < windows; ++i) {
      for (const bool first : {true, false}) {
        const bool shows = first == (i % 2 == 0);  // whatever grows with time counts for both
        stroke(shows, shows ? &with_ : &without_);
      }
    }
    return true;
  }

  void print() {
    std::sort(until_s_.begin(), until_s_.end());
    const auto at_ms = [&](double part) {
      return until_s_.empty() ? NAN : 1e3 * until_s_[static_cast<std::size_t>(part * (until_s_.size() - 1.0))];
    };
    fmt::print(
        "{:>9} depth pictures of {} x {} at {:.0f} Hz: in place {:.1f} ms after the first call in the median, "
        "{:.1f} ms at p99, {:.1f} ms at most\n",
        came_, kColumns, kRows, kRate_Hz, at_ms(0.5), at_ms(0.99), at_ms(1));
    fmt::print("{:>24}: {}, of these left out as two were on their way: {}\n", "came before the last one was in place",
               late_, left_out_);
    print("with pictures", with_);
    print("without", without_);
  }

 private:
  struct Window {
    Missed missed;
    double seconds = 0;
  };
  struct OnWay {
    HLint number;
    Clock::time_point begin;
  };
  static constexpr std::size_t kMaxOnWay = 2;

  // One window; the hand strokes the wall 4 mm beneath it. `into`: what the window adds to; null: nothing.
  void stroke(bool shows, Window* into) {
    counts_ = into != nullptr;
    const Clock::time_point begin = Clock::now();
    const Missed before = missedSoFar();
    auto next = begin;
    while (secondsBetween(begin, Clock::now()) < window_s_) {
      const double turn = 1.5 * secondsBetween(start_, Clock::now());
      hlHandGoal3d(0.06 * std::sin(turn), 0.04 * std::cos(1.3 * turn), -kWall_m - 0.004);
      if (shows) show();
      next += std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / kRate_Hz));
      do {
        hlPoll();
        noteShown();
        std::this_thread::sleep_until(std::min(next, Clock::now() + std::chrono::microseconds(500)));
      } while (Clock::now() < next);
    }
    if (into == nullptr) return;
    into->missed.add(missedSoFar() - before);
    into->seconds += secondsBetween(begin, Clock::now());
  }

  // The next picture. Where two are on their way it is left out: it would only wait behind them.
  void show() {
    came_ += counts_ ? 1 : 0;
    late_ += counts_ && !on_way_.empty() ? 1 : 0;
    if (on_way_.size() >= kMaxOnWay) {
      left_out_ += counts_ ? 1 : 0;
      return;
    }
    const auto begin = Clock::now();
    pictures_.send();
    on_way_.push_back({numberOf(HL_FRAME_SENT) + numberOf(HL_FRAME_WAITING), begin});
  }
  void noteShown() {
    const HLint shown = numberOf(HL_FRAME_SHOWN);
    while (!on_way_.empty() && on_way_.front().number <= shown) {
      if (counts_) until_s_.push_back(secondsBetween(on_way_.front().begin, Clock::now()));
      on_way_.pop_front();
    }
  }

  static void print(const char* what, const Window& window) {
    fmt::print("{:>24}: {} servo and {} proxy deadlines missed in {:.0f} s\n", what, window.missed.servo,
               window.missed.proxy, window.seconds);
  }

  Pictures pictures_;
  const Clock::time_point start_ = Clock::now();
  double window_s_ = 0;
  Window with_, without_;
  bool counts_ = false;
  std::deque<OnWay> on_way_;
  std::size_t came_ = 0, late_ = 0, left_out_ = 0;
  std::vector<double> until_s_;
};

}  // namespace

bool measureDepthSession(double seconds) {
  DepthSession session;
  if (!session.run(seconds)) return false;
  session.print();
  return true;
}

}  // namespace hl::bench

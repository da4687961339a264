#include "dds/share_lab.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <thread>

#include "base/clock.h"
#include "ros/keystore.h"
#include "temp_folder.h"
#include "wait_for.h"

namespace hl::test {

namespace {

constexpr std::uint32_t kDomain = 43;
constexpr double kRadius_m = 0.01, kTurns_Hz = 0.5, kFrame_s = 1.0 / 60;
// The hand comes to the plate, and what came late while the servers joined is forgotten.
constexpr double kSettle_s = 5;
const Vec3 kHalf(0.3, 0.02, 0.3);

std::string orderOf(const LabLine& line) {
  return "delay " + std::to_string(line.delay_ms) + " jitter " + std::to_string(line.jitter_ms) + " loss " +
         std::to_string(line.loss_percent);
}

TouchServerSettings labSettings() {
  TouchServerSettings settings = settingsOf();
  settings.touch.timer_reference = true;
  return settings;
}

double angleOf(const Instance& plate) {
  const Vec3 place = plate.shownAt(monotonicNow_ns()).origin;
  return std::atan2(place.y(), place.x());
}

/// An angle that goes on beyond a whole turn, over time.
class Turning {
 public:
  void add(double time_s, double angle_rad) {
    constexpr double kTurn = 2 * std::numbers::pi;
    if (!samples_.empty()) {
      while (angle_rad - samples_.back().second > kTurn / 2) angle_rad -= kTurn;
      while (angle_rad - samples_.back().second < -kTurn / 2) angle_rad += kTurn;
    }
    samples_.emplace_back(time_s, angle_rad);
  }
  double last() const { return samples_.back().second; }
  /// When it was at this angle, modulo whole turns, last before the end.
  double timeOf(double angle_rad) const {
    constexpr double kTurn = 2 * std::numbers::pi;
    while (angle_rad > last()) angle_rad -= kTurn;
    while (angle_rad < last() - kTurn) angle_rad += kTurn;
    const auto after = std::find_if(samples_.rbegin(), samples_.rend(),
                                    [&](const auto& sample) { return sample.second <= angle_rad; });
    if (after == samples_.rbegin() || after == samples_.rend()) return samples_.back().first;
    const auto& [t0, a0] = *after;
    const auto& [t1, a1] = *std::prev(after);
    return a1 > a0 ? t0 + (t1 - t0) * (angle_rad - a0) / (a1 - a0) : t0;
  }

 private:
  std::vector<std::pair<double, double>> samples_;
};

double shareOf(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace

ShareLab::ShareLab(const LabLine& line) : line_(3, orderOf(line)), shape_(boxInstance(1, kHalf, Vec3::Zero()).shape) {
  std::filesystem::remove_all(tempFile("lab_keys"));
  makeEnclaves(tempFile("lab_keys"), {"anna", "bert", "carl"}, kDomain);
  anna_ = join(1, "anna");
  plate_ = anna_->touch.placeClient();
  placePlate(0);
  bert_ = join(2, "bert");
  carl_ = join(3, "carl");
  waitFor([this] { return bert_->other() && carl_->other(); });
}

ShareLab::~ShareLab() {
  plate_.reset();
  std::filesystem::remove_all(tempFile("lab_keys"));
}

std::unique_ptr<SharedServer> ShareLab::join(int end, const std::string& name) {
  const auto id = static_cast<ServerId>(end);
  std::unique_ptr<ShareProcess> process;
  line_.inside(end, [&] {
    process = std::make_unique<ShareProcess>(
        ShareTask{HL_VERSION, kDomain, "lab", id, {"line0", tempFile("lab_keys") + "/enclaves/" + name, {}}});
  });
  return std::make_unique<SharedServer>(std::move(process), id, name, nothing(), labSettings());
}

void ShareLab::placePlate(double time_s) {
  const double angle = 2 * std::numbers::pi * kTurns_Hz * time_s;
  auto placed = std::make_shared<PlacedList>();
  placed->push_back({shape_, surfacesOf(shape_),
                     Pose{Mat3::Identity(), Vec3(kRadius_m * std::cos(angle), kRadius_m * std::sin(angle), 0)}, 99});
  placed->back().session = plate_->session();
  plate_->place(placed, static_cast<std::int64_t>(1e9 * kFrame_s));
}

LabResult ShareLab::run(double seconds) {
  LabResult result;
  Turning here, there;
  std::vector<double> stale_ms;
  // On the plate, pressed in a little at its lowest.
  bert_->touch.device().live().setWorkspace({});
  const Vec3 goal(0, kHalf.y() - kRadius_m - 0.003, 0);
  const auto begin = std::chrono::steady_clock::now();
  double next_s = 0, force_N = 0, samples = 0;
  for (double now_s = 0; now_s < seconds;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    now_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (now_s >= next_s) {
      placePlate(now_s);
      bert_->touch.device().hand().setGoal(goal);
      bert_->keepOn();
      next_s += kFrame_s;
    }
    here.add(now_s, angleOf(*anna_->other()));
    there.add(now_s, angleOf(*bert_->other()));
    if (now_s < kSettle_s) continue;
    stale_ms.push_back(1e3 * (now_s - here.timeOf(there.last())));
    ServoView servo;
    ProxyView proxy;
    bert_->touch.device().views(servo, proxy);
    result.least_tank_J = std::min(result.least_tank_J, proxy.ledger.tank_J);
    result.moving_J = proxy.ledger.by_cause_J[static_cast<std::size_t>(EnergyCause::kMoving)];
    force_N += servo.force_N.norm();
    ++samples;
  }
  const auto end = std::chrono::steady_clock::now();
  waitFor([&] {
    return bert_->other()->shownAt(monotonicNow_ns()) == anna_->other()->shownAt(monotonicNow_ns()) &&
           carl_->other()->shownAt(monotonicNow_ns()) == anna_->other()->shownAt(monotonicNow_ns());
  });
  result.apart_ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - end).count();
  result.staleness_p50_ms = shareOf(stale_ms, 0.5);
  result.staleness_p99_ms = shareOf(stale_ms, 0.99);
  result.staleness_max_ms = shareOf(stale_ms, 1);
  for (const PeerView& peer : bert_->bridge.view().peers) {
    if (peer.name == "anna") result.playout_ms = peer.playout_ms;
  }
  result.force_mean_N = samples > 0 ? force_N / samples : 0;
  const LoopTotals servo = bert_->touch.device().servoTotals();
  result.steps = servo.steps;
  result.missed = servo.missed;
  result.timer_missed = bert_->touch.device().referenceTotals().missed;
  return result;
}

}  // namespace hl::test

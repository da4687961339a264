// Fault injection: a servo that meets everything: devices that fail, positions and targets that are no numbers, clocks
// that jump, stalls, switches let go, settings changed. Never a force above the limit, never a change of it above the
// limit of its rate but to zero where the states say so, and always the state that the model says.
//
//   fault_injection [--steps N] [--seed S]
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "control/safety_model.h"
#include "control/servo.h"

namespace hl {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array kRates_Hz{1000.0, 4000.0, 10'000.0};
constexpr std::int64_t kLifeSteps = 50'000;  // then another servo
constexpr double kBlowSeen_s = 0.003;        // after which a blow has been found

class Life {
 public:
  Life(std::uint64_t seed, double rate_Hz)
      : random_(seed),
        settings_(settingsFor(rate_Hz, random_() % 2 == 0)),
        model_(rate_Hz, settings_.ramp_s, settings_.arm_again) {}

  /// Empty, or what was wrong.
  std::string step();
  const ServoState& state() const { return state_; }

 private:
  static ServoSettings settingsFor(double rate_Hz, bool arm_again) {
    ServoSettings settings;
    settings.period_s = 1 / rate_Hz;
    settings.stiffness_N_m = 1000;
    settings.damping_Ns_m = 2;
    settings.force_limit_N = 8;
    settings.force_rate_limit_N_s = 4000;
    settings.velocity_limit_m_s = 3;
    settings.ramp_s = 0.02;
    settings.friction_N = 0.04;
    settings.arm_again = arm_again;
    return settings;
  }
  bool oneIn(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)) == 0; }
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  Vec3 within(double reach) { return reach * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) / std::sqrt(3); }
  double oddNumber() {
    static constexpr std::array kOdd{kNaN, kInfinity, -kInfinity};
    return kOdd[random_() % kOdd.size()];
  }
  void command();
  void changeSettings();
  DeviceSample sample(test::Injected& in);
  void move(test::Injected& in);
  ServoTarget target(test::Injected& in, std::int64_t now_ns);
  std::string judge(const test::Injected& in, const ServoOutput& out);

  std::mt19937_64 random_;
  ServoSettings settings_;
  ServoState state_;
  test::SafetyModel model_;
  std::int64_t now_ns_ = 1'000'000'000;
  Vec3 finger_ = Vec3::Zero();
  Vec3 before_N_ = Vec3::Zero();
  Vec3 reported_ = Vec3::Zero();  // where the finger was when the driver last said so
  std::int64_t reported_ns_ = 0;
  int away_steps_ = 0;     // left of a loss of the device
  int held_up_steps_ = 0;  // left in which the driver says nothing new
  int since_blow_steps_ = 0;
  bool pressed_ = true;
};

void Life::command() {
  if (oneIn(2000) || (state_.safety == SafetyState::kFault && oneIn(50))) arm(state_), model_.arm();
  if (oneIn(20'000)) disarm(state_), model_.disarm();
  if (oneIn(10'000)) fail(state_, FaultReason::kStalled), model_.stall();
}

void Life::changeSettings() {
  settings_.stiffness_N_m = uniform(0, 3500);
  settings_.damping_Ns_m = uniform(0, 5);
  settings_.ledger = static_cast<LedgerMode>(random_() % 3);
  settings_.passivity.on = oneIn(2);
  settings_.vibration.on = oneIn(2);
  settings_.effects = {uniform(0, 0.2), uniform(0, 5), uniform(0, 500), within(0.1), within(3)};
  settings_.remote.on = oneIn(2);
  settings_.remote.engaged = !oneIn(4);
  settings_.remote.fresh_until_ns = now_ns_ + static_cast<std::int64_t>(random_() % 1'000'000'000);
  settings_.remote.force_N = oneIn(20) ? Vec3(oddNumber(), 0, 0) : within(20);
  settings_.remote.given_up_J = oneIn(20) ? oddNumber() : settings_.remote.given_up_J + uniform(0, 0.1);
  settings_.dead_man = static_cast<DeadMan>(random_() % 3);
  settings_.dead_man_button = static_cast<std::uint32_t>(random_() % 3);
}

DeviceSample Life::sample(test::Injected& in) {
  double periods = uniform(0.75, 1.25);
  if (oneIn(100)) periods = uniform(0.05, 0.2);
  if (oneIn(200)) periods += static_cast<double>(in.missed = static_cast<std::int64_t>(random_() % 40));
  std::int64_t elapsed_ns = static_cast<std::int64_t>(1e9 * periods * settings_.period_s);
  if (oneIn(20'000)) {  // an absurd clock
    const bool back = oneIn(2);
    elapsed_ns = back ? -now_ns_ / 2 : 1'000'000'000'000'000;
    in.missed = back ? 0 : static_cast<std::int64_t>(1e6 / settings_.period_s);
  } else {
    finger_ += within(0.4 * settings_.velocity_limit_m_s * 1e-9 * static_cast<double>(elapsed_ns));
  }
  now_ns_ += elapsed_ns;
  if (now_ns_ > 4'000'000'000'000'000'000) now_ns_ = 1'000'000'000;  // back again
  move(in);
  DeviceSample sample{now_ns_, reported_, 0, DeviceStatus::kOk};
  sample.age_ns = now_ns_ - reported_ns_;
  if (oneIn(8000)) away_steps_ = static_cast<int>(random_() % 200);
  if (away_steps_ > 0) {
    --away_steps_;
    in.status = sample.status = oneIn(10) ? DeviceStatus::kNotReady : DeviceStatus::kLost;
  }
  if (oneIn(8000)) {
    in.position_is_number = false;
    sample.position[static_cast<Eigen::Index>(random_() % 3)] = oddNumber();
  }
  if (oneIn(1000)) sample.weight_N = oneIn(2) ? within(1e300) : Vec3(oddNumber(), 0, 0);
  if (oneIn(3000)) pressed_ = !pressed_;
  sample.buttons = pressed_ ? 1U << settings_.dead_man_button : ~(1U << settings_.dead_man_button);
  sample.held = pressed_;
  in.held = pressed_ || settings_.dead_man == DeadMan::kNone;
  return sample;
}

// A driver that is held up does not see a blow, so none comes then, nor before the last one can be seen.
void Life::move(test::Injected& in) {
  ++since_blow_steps_;
  if (held_up_steps_ == 0 && oneIn(10'000)) {
    in.blow = true;
    since_blow_steps_ = 0;
    finger_ = finger_.x() > 0 ? Vec3(-1, 0, 0) : Vec3(1, 0, 0);
  }
  if (held_up_steps_ > 0 && --held_up_steps_ > 0) return;
  if (since_blow_steps_ > kBlowSeen_s / settings_.period_s && oneIn(500))
    held_up_steps_ = 1 + static_cast<int>(random_() % 40);
  reported_ = finger_;
  reported_ns_ = now_ns_;
}

ServoTarget Life::target(test::Injected& in, std::int64_t now_ns) {
  ServoTarget target{finger_ + within(0.02), now_ns, !oneIn(16), uniform(-0.2, 1.2), uniform(-1e-4, 1e-4)};
  if (oneIn(1000)) target.proxy_D = within(1e300);
  if (oneIn(100)) target.time_ns = now_ns - static_cast<std::int64_t>(uniform(60e6, 900e6));
  if (oneIn(100)) target.paid_J = oddNumber();
  if (oneIn(8000)) {
    in.target_lost = true;
    target.time_ns = now_ns + static_cast<std::int64_t>(uniform(1.1e9, 1e15)) * (oneIn(2) ? 1 : -1);
  }
  if (oneIn(8000)) {
    in.target_is_number = !target.valid;
    (oneIn(2) ? target.stiffness : target.proxy_D.y()) = oddNumber();
  }
  return target;
}

std::string Life::judge(const test::Injected& in, const ServoOutput& out) {
  const SafetyState was = model_.state();
  if (!model_.agrees(in, out.safety, out.fault))
    return fmt::format("state {} ({}), and the model has {} after {}", static_cast<int>(out.safety),
                       faultText(out.fault), static_cast<int>(model_.state()), static_cast<int>(was));
  if (!out.force_N.allFinite()) return "a force that is no number";
  if (out.force_N.norm() > settings_.force_limit_N * (1 + 1e-12))
    return fmt::format("a force of {} N", out.force_N.norm());
  const bool without = out.safety != SafetyState::kArming && out.safety != SafetyState::kOn;
  if (without && !out.force_N.isZero(0)) return "a force where there must be none";
  const double change_N = (out.force_N - before_N_).norm();
  // An arm after a fault or off follows on zero; a disarm and an arm between two steps are seen as one change.
  const bool from_zero = was == SafetyState::kArming && out.force_N.norm() < change_N;
  const double most_N = settings_.force_rate_limit_N_s * settings_.period_s * (1 + 1e-9);
  if (!without && change_N > most_N && !(from_zero && out.force_N.norm() <= most_N))
    return fmt::format("a change of {} N in a step", change_N);
  before_N_ = out.force_N;
  return {};
}

std::string Life::step() {
  command();
  if (oneIn(5000)) changeSettings();
  test::Injected in;
  const DeviceSample read = sample(in);
  const ServoTarget wanted = target(in, read.time_ns);
  return judge(in, stepServo(state_, settings_, wanted, read));
}

struct Counts {
  std::map<SafetyState, std::int64_t> states;
  std::map<FaultReason, std::int64_t> faults;
  std::int64_t forced = 0;

  void add(const ServoState& state, SafetyState before) {
    ++states[state.safety];
    if (state.safety == SafetyState::kFault && before != SafetyState::kFault) ++faults[state.fault];
    forced += state.force_N.isZero(0) ? 0 : 1;
  }
  // A run that never met something has proved nothing of it.
  bool complete() const { return states.size() == 5 && faults.size() >= 8; }
};

int run(std::int64_t steps, std::uint64_t seed) {
  Counts counts;
  for (std::int64_t begin = 0, life = 0; begin < steps; begin += kLifeSteps, ++life) {
    const std::uint64_t own_seed = seed + static_cast<std::uint64_t>(life);
    const double rate_Hz = kRates_Hz[own_seed % kRates_Hz.size()];
    Life servo(own_seed, rate_Hz);
    for (std::int64_t i = 0; i < kLifeSteps; ++i) {
      const SafetyState before = servo.state().safety;
      if (const std::string wrong = servo.step(); !wrong.empty()) {
        fmt::print("FAULT at step {} at {} Hz: {}; again: --seed {} --steps {}\n", i, rate_Hz, wrong, own_seed,
                   kLifeSteps);
        return 1;
      }
      counts.add(servo.state(), before);
    }
  }
  fmt::print("{} steps, {} with force; in off, arming, on, fault, waiting:", steps, counts.forced);
  for (const auto& [state, n] : counts.states) fmt::print(" {}", n);
  fmt::print("\n");
  for (const auto& [reason, n] : counts.faults) fmt::print("{:>8}  {}\n", n, faultText(reason));
  if (!counts.complete()) fmt::print("too few steps: some state or fault never came\n");
  return counts.complete() ? 0 : 1;
}

}  // namespace
}  // namespace hl

int main(int argc, char** argv) {
  CLI::App app("Injects faults into the servo step and holds it against a model.");
  double steps = 1e6;
  std::uint64_t seed = 1;
  app.add_option("--steps", steps, "how many")->capture_default_str();
  app.add_option("--seed", seed, "of the random numbers")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return hl::run(static_cast<std::int64_t>(steps), seed);
}

// The vibration guard with everything real: simulated device in a hand, servo step, proxy on a surface. A spring that
// is too stiff for the loop is softened soon, whatever the device; and what hands and surfaces do is no alarm.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "builtin.h"
#include "device/simulated_device.h"
#include "guard/realtime_guard.h"
#include "proxy/effect_scenes.h"
#include "tools/stability.h"
#include "touch/touch_step.h"

namespace hl::test_vibration {
namespace {

constexpr double kRadius_m = 0.002;
constexpr double kAbove_m = 0.001;  // the tip begins so far above the surface

// A floor that a proxy at the device's origin is kAbove_m away from.
Model floorBelow(Model model = test::floorModel()) {
  placeModel(model, {Mat3::Identity(), Vec3(0, -(kRadius_m + kAbove_m), 0)});
  return model;
}

// One loop at 1 kHz.
class Session {
 public:
  Session(const SimulatedDeviceSettings& device, double stiffness_N_m, bool guard, Model model = floorBelow())
      : device_(device), scenes_(makeSnapshot(std::move(model))), proxy_(scenes_, {}) {
    settings_ = ServoSettings::of(device_.info());
    settings_.stiffness_N_m = stiffness_N_m;
    settings_.damping_Ns_m = 0;
    settings_.ramp_s = settings_.period_s;
    settings_.vibration.on = guard;
    commands_.radius_W = kRadius_m;
    arm(step_.servo());
    for (int i = 0; i < 100; ++i) step();  // the scene is faded in
  }
  ServoOutput step() {
    const ServoOutput out = step_.onTime(proxy_, commands_, settings_, device_.read(time_ns_));
    device_.write(out.force_N);
    time_ns_ += 1'000'000;
    return out;
  }
  SimulatedDevice& device() { return device_; }
  ServoSettings& settings() { return settings_; }
  const ServoState& servo() { return step_.servo(); }

 private:
  SimulatedDevice device_;
  SnapshotSlot scenes_;
  ProxyLoop proxy_;
  ProxyCommands commands_;
  ServoSettings settings_;
  TouchStep step_;
  std::int64_t time_ns_ = 0;
};

SimulatedDeviceSettings deviceOf(const DeviceModel& model, bool firm, int delay_steps) {
  SimulatedDeviceSettings device;
  device.model = model;
  device.firm = firm;
  device.delay_steps = delay_steps;
  device.step_s = model.name == std::string("premium1.5") ? 50e-6 : 20e-6;
  return device;
}

// Deep enough that the hand presses with so many newtons: its springs and the floor's in series.
Vec3 pressingGoal(bool firm, double stiffness_N_m, double push_N) {
  const GripParameters& grip = firm ? kFirmGrip : kLightGrip;
  const double softness_m_N = 1 / grip.pad_stiffness_N_m + 1 / grip.arm_stiffness_N_m + 1 / stiffness_N_m;
  return {0, -kAbove_m - push_N * softness_m_N, 0};
}

// The longest time for which the force goes to and fro by at least `swing_N`, each way within kHalf_s.
class Ringing {
 public:
  static constexpr double kHalf_s = 0.065, kStep_s = 1e-3;

  explicit Ringing(double swing_N) : swing_N_(swing_N) {}
  void add(double force_N) {
    const double now_s = kStep_s * ++steps_;
    if (up_ ? force_N >= best_N_ : force_N <= best_N_) {
      best_N_ = force_N;
      best_s_ = now_s;
    }
    if (std::abs(force_N - best_N_) < swing_N_) return;
    if (best_s_ - turn_s_ > kHalf_s) begin_s_ = best_s_;
    longest_s_ = std::max(longest_s_, best_s_ - begin_s_);
    turn_s_ = best_s_;
    best_N_ = force_N;
    best_s_ = now_s;
    up_ = !up_;
  }
  double longest_s() const { return longest_s_; }

 private:
  double swing_N_;
  int steps_ = 0;
  bool up_ = true;
  double best_N_ = 0, best_s_ = 0, turn_s_ = 0, begin_s_ = 0, longest_s_ = 0;
};

struct Landed {
  double ringing_s = 0, loud_s = 0;  // by half a newton, by two
  double last_N = 0;                 // the force's swing in the last 0.2 s
  std::uint32_t alarms = 0;
  double dissipated_J = 0;
};

Landed land(const SimulatedDeviceSettings& device, double stiffness_N_m, const Landing& landing, bool guard,
            int steps = 2000) {
  constexpr int kLast = 200;
  Session session(device, stiffness_N_m, guard);
  session.device().place(session.device().trueTip_D(), {0, -landing.speed_m_s, 0});
  session.device().setHandGoal(pressingGoal(device.firm, stiffness_N_m, landing.push_N));
  Ringing ringing(0.5), loud(2);
  double low_N = std::numeric_limits<double>::infinity(), high_N = 0;
  for (int i = 0; i < steps; ++i) {
    const double force_N = session.step().force_N.y();
    ringing.add(force_N);
    loud.add(force_N);
    if (i < steps - kLast) continue;
    low_N = std::min(low_N, force_N);
    high_N = std::max(high_N, force_N);
  }
  const VibrationGuard& seen = session.servo().vibration;
  return {ringing.longest_s(), loud.longest_s(), high_N - low_N, seen.alarms, seen.dissipated_J};
}

constexpr std::array<Landing, 4> kLandings{{{0.05, 3}, {0.2, 0.3}, {0.2, 3}, {0.4, 1}}};

template <typename Visit>
void forEveryLoop(const Visit& visit) {
  for (const DeviceModel& model : deviceModels()) {
    for (const bool firm : {false, true}) {
      for (const int delay_steps : {0, 1, 2}) visit(deviceOf(model, firm, delay_steps));
    }
  }
}

std::string nameOf(const SimulatedDeviceSettings& device, double stiffness_N_m, const Landing& landing) {
  return std::string(device.model.name) + (device.firm ? " firm " : " light ") + std::to_string(device.delay_steps) +
         " late, " + std::to_string(stiffness_N_m) + " N/m, " + std::to_string(landing.speed_m_s) + " m/s, " +
         std::to_string(landing.push_N) + " N";
}

// Up to the highest stiffness that the page's slider gives. By themselves some of these swing to the limit of the
// force. What does not die away is softened; what a hand might do, a small or slow swing, is believed later.
TEST(Vibration, IsOverSoonOnEveryDeviceAtEveryStiffness) {
  constexpr double kLongest_s = 0.7, kLongestLoud_s = 0.45, kRest_N = 0.5;
  std::vector<double> loud;
  forEveryLoop([&](const SimulatedDeviceSettings& device) {
    const double most_N_m = device.model.info.stiffness_max_N_m;
    for (double stiffness_N_m = most_N_m; stiffness_N_m > 300; stiffness_N_m /= 1.7) {
      for (const Landing& landing : kLandings) {
        const Landed landed = land(device, stiffness_N_m, landing, true);
        EXPECT_LT(landed.ringing_s, kLongest_s) << nameOf(device, stiffness_N_m, landing);
        EXPECT_LT(landed.loud_s, kLongestLoud_s) << nameOf(device, stiffness_N_m, landing);
        EXPECT_LT(landed.last_N, kRest_N) << nameOf(device, stiffness_N_m, landing);
        EXPECT_EQ(landed.alarms > 0, landed.dissipated_J > 0);
        if (landed.alarms > 0) loud.push_back(landed.loud_s);
      }
    }
  });
  ASSERT_GT(loud.size(), 100U);
  std::sort(loud.begin(), loud.end());
  EXPECT_LT(loud[loud.size() / 2], 0.2);
}

// What the same loop does by itself.
TEST(Vibration, WithoutTheGuardTheForceSwingsForGood) {
  const SimulatedDeviceSettings device = deviceOf(premium15(), false, 0);
  const Landed landed = land(device, device.model.info.stiffness_max_N_m, {0.2, 3}, false);
  EXPECT_GT(landed.last_N, 6);
  EXPECT_GT(landed.ringing_s, 0.9);
  EXPECT_EQ(landed.alarms, 0U);
}

// Where every landing of the stability bench comes to rest with twice the stiffness, none is taken for a vibration.
TEST(Vibration, NoLandingIsAnAlarmAtHalfOfWhatSettles) {
  int loops = 0;
  forEveryLoop([&](const SimulatedDeviceSettings& device) {
    const double most_N_m = device.model.info.stiffness_max_N_m;
    const auto settles = [&](double stiffness_N_m) {
      return std::all_of(kLandings.begin(), kLandings.end(), [&](const Landing& landing) {
        return land(device, stiffness_N_m, landing, false).last_N < kSettled_m * stiffness_N_m;
      });
    };
    double stiffness_N_m = 300;
    while (2 * stiffness_N_m <= most_N_m && settles(2 * stiffness_N_m)) {
      for (const double speed_m_s : kImpactSpeeds_m_s) {
        for (const double push_N : kPushes_N) {
          const Landing landing{speed_m_s, push_N};
          EXPECT_EQ(land(device, stiffness_N_m, landing, true, 700).alarms, 0U)
              << nameOf(device, stiffness_N_m, landing);
        }
      }
      stiffness_N_m *= 2;
      ++loops;
    }
  });
  EXPECT_GT(loops, 40);
}

// ---- What hands do, at half of the highest stiffness that the bench finds to come to rest ---------------------------

// The figures of docs/stability.md, after everything together, at 1 kHz without delay. Near to them a blow rings on by
// itself for half a second and more, and that is softened.
double halfOfSettling_N_m(bool firm) { return 0.5 * (firm ? 5210 : 2287); }

Model ridged(Quantity quantity, const char* kind, double low, double high) {
  Model model = floorBelow();
  for (Vec2& uv : model.texcoords) uv *= 100;  // tiles of 2 mm
  model.textures = {makeTexture(kind, 32)};
  model.materials[0].textureOf(quantity) = {0, low, high};
  model.materials[0].dynamic_friction = model.materials[0].static_friction = 0.3;
  return model;
}

Model terrainBelow() {
  Model model = makeBuiltinScene("terrain:20000");
  placeModel(model, {Mat3::Identity(), Vec3(0, -0.017, 0)});
  return model;
}

// Strokes to and fro at up to `speed_m_s`, pressed by `deep_m` of the hand's springs, for 3 s.
std::uint32_t alarmsOfStroking(bool firm, double speed_m_s, double deep_m, Model model) {
  Session session(deviceOf(premium10(), firm, 0), halfOfSettling_N_m(firm), true, std::move(model));
  constexpr double kHalfWay_m = 0.03;
  for (int i = 0; i < 3000; ++i) {
    const double s = std::sin(1e-3 * i * speed_m_s / kHalfWay_m);
    session.device().setHandGoal({kHalfWay_m * s, -deep_m, 0.3 * kHalfWay_m * s});
    session.step();
  }
  return session.servo().vibration.alarms;
}

TEST(Vibration, StrokingRoughAndTexturedSurfacesIsNoAlarm) {
  for (const bool firm : {false, true}) {
    for (const double speed_m_s : {0.05, 0.15, 0.3}) {
      for (const double deep_m : {0.005, 0.015}) {
        const auto alarms = [&](Model model) { return alarmsOfStroking(firm, speed_m_s, deep_m, std::move(model)); };
        const std::string how = std::string(firm ? "firm " : "light ") + std::to_string(speed_m_s) + " m/s, " +
                                std::to_string(deep_m) + " m deep";
        EXPECT_EQ(alarms(floorBelow()), 0U) << how << ": floor";
        EXPECT_EQ(alarms(terrainBelow()), 0U) << how << ": terrain";
        EXPECT_EQ(alarms(ridged(Quantity::kHeight, "sine", 0, 2e-4)), 0U) << how << ": bumps";
        EXPECT_EQ(alarms(ridged(Quantity::kStiffness, "lines", 0.4, 1)), 0U) << how << ": stripes of stiffness";
        EXPECT_EQ(alarms(ridged(Quantity::kDynamicFriction, "lines", 0, 0.5)), 0U) << how << ": stripes of friction";
      }
    }
  }
}

// A force of the hand that goes to and fro: a tremor while it presses, or taps from above the surface.
std::uint32_t alarmsUnder(bool firm, double load_N, double rate_Hz, double push_N) {
  const double stiffness_N_m = halfOfSettling_N_m(firm);
  Session session(deviceOf(premium10(), firm, 0), stiffness_N_m, true);
  session.device().setHandGoal(push_N > 0 ? pressingGoal(firm, stiffness_N_m, push_N) : Vec3(0, 0.002, 0));
  for (int i = 0; i < 3000; ++i) {
    session.device().setLoad({0, load_N * std::sin(2e-3 * M_PI * rate_Hz * i), 0});
    session.step();
  }
  return session.servo().vibration.alarms;
}

TEST(Vibration, ATremblingHandIsNoAlarm) {
  for (const bool firm : {false, true}) {
    for (const double rate_Hz : {8.0, 10.0, 12.0}) {
      for (const double push_N : {0.3, 1.0, 3.0}) {
        EXPECT_EQ(alarmsUnder(firm, 0.3, rate_Hz, push_N), 0U)
            << (firm ? "firm " : "light ") << rate_Hz << " Hz " << push_N;
      }
    }
  }
}

TEST(Vibration, TappingIsNoAlarm) {
  for (const bool firm : {false, true}) {
    for (const double rate_Hz : {2.0, 4.0, 6.0, 8.0, 10.0}) {
      for (const double load_N : {0.5, 1.0, 2.0}) {
        EXPECT_EQ(alarmsUnder(firm, load_N, rate_Hz, 0), 0U)
            << (firm ? "firm " : "light ") << rate_Hz << " Hz " << load_N;
      }
    }
  }
}

// A plate that an application shakes is felt as it is.
TEST(Vibration, ASurfaceThatMovesIsNoAlarm) {
  ServoSettings settings = ServoSettings::of(premium10().info);
  settings.ramp_s = settings.period_s;
  settings.stiffness_N_m = 1000;
  ServoState state;
  arm(state);
  for (int i = 1; i <= 2000; ++i) {
    DeviceSample sample;
    sample.status = DeviceStatus::kOk;
    sample.time_ns = i * 1'000'000;
    const Vec3 proxy(0, 0.002 + 0.001 * std::sin(2e-3 * M_PI * 30 * i), 0);
    stepServo(state, settings, {proxy, sample.time_ns, true, 1, 1e-3}, sample);
  }
  EXPECT_GT(state.force_N.norm(), 0.5);
  EXPECT_EQ(state.vibration.alarms, 0U);
}

// ---- What comes after ----------------------------------------------------------------------------------------------

TEST(Vibration, TheLimitGoesUpInTheOpenOnlyAndALowerStiffnessIsNotTouched) {
  VibrationGuard guard;
  guard.limit_N_m = 500;
  EXPECT_EQ(limitedStiffness_N_m(guard, 400, 1), 400);
  EXPECT_EQ(limitedStiffness_N_m(guard, 1000, 1), 500);
  EXPECT_EQ(limitedStiffness_N_m(guard, 1000, 0.8), 625);  // 500 N/m of a soft surface
  SpringStep touching;
  touching.pulling = true;
  const auto pass = [&](const SpringStep& step, int seconds) {
    for (int i = 0; i < 1000 * seconds; ++i) watchVibration(guard, {}, step, 2000, Vec3::Zero(), 1e-3);
  };
  pass(touching, 20);
  EXPECT_EQ(guard.limit_N_m, 500);
  pass({}, 5);
  EXPECT_GT(guard.limit_N_m, 600);
  EXPECT_LT(guard.limit_N_m, 900);
  pass({}, 20);
  EXPECT_EQ(guard.limit_N_m, 0);
}

TEST(Vibration, TheGuardAllocatesNothing) {
  Session session(deviceOf(premium10(), false, 0), premium10().info.stiffness_max_N_m, true);
  session.device().setHandGoal({0, -0.01, 0});
  const RealtimeGuard guard;
  for (int i = 0; i < 500; ++i) session.step();
  EXPECT_GT(session.servo().vibration.alarms, 0U);
}

}  // namespace
}  // namespace hl::test_vibration

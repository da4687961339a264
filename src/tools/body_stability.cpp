#include "tools/body_stability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bodies/convex.h"
#include "scene/rigid_body.h"
#include "tools/bench_session.h"

namespace hl {

namespace {

constexpr double kTheirSwing = 0.05;  // of the stretch at rest, at the begin

// The bracket of the inequality, with 1 + rho.
double costOf(const BodyOnDevice& on, const Coupling& coupling) {
  const double rho = on.device_kg / on.body_kg;
  return (1 + rho) * (0.5 + on.delay_steps + rho * (coupling.body_late_steps - coupling.theta));
}

// Two masses on a spring, and nothing else.
class TwoMasses {
 public:
  TwoMasses(const BodyOnDevice& on, const Coupling& coupling, double stiffness_N_m)
      : on_(on), coupling_(coupling), stiffness_N_m_(stiffness_N_m), period_s_(1 / on.rate_Hz) {
    decay_ = std::exp(-on.damping_Ns_m * period_s_ / on.device_kg);
  }

  void step() {
    const double node_kg = coupling_.theta * stiffness_N_m_ * period_s_ * period_s_;
    const double before_N = stiffness_N_m_ * (body_m_ - device_m_);
    // What the body gets begins with the stretch of an earlier step, if it is late.
    const double begin_N = coupling_.body_late_steps > 0 ? last_N_ : before_N;
    const double slowed = on_.body_kg * body_m_s_ - period_s_ * begin_N;
    body_m_s_ = slowed / (on_.body_kg + node_kg);
    body_m_ += period_s_ * body_m_s_;
    const double force_N = before_N + coupling_.theta * stiffness_N_m_ * period_s_ * body_m_s_;
    last_N_ = before_N;
    moveDevice(coupling_.theta > 0 ? force_N : before_N);
  }
  double stretch_m() const { return body_m_ - device_m_; }

 private:
  // Exactly, with a constant force; of no damping the limit.
  void moveDevice(double force_N) {
    on_the_way_[written_ % on_the_way_.size()] = force_N;
    const std::size_t room = on_the_way_.size();
    const double arrived_N = on_the_way_[(written_ + room - static_cast<std::size_t>(on_.delay_steps)) % room];
    ++written_;
    const double b = on_.damping_Ns_m, m = on_.device_kg, T = period_s_;
    if (b * T < 1e-9 * m) {
      device_m_ += T * device_m_s_ + T * T / 2 * arrived_N / m;
      device_m_s_ += T * arrived_N / m;
      return;
    }
    const double end_m_s = arrived_N / b;
    device_m_ += T * end_m_s + m / b * (1 - decay_) * (device_m_s_ - end_m_s);
    device_m_s_ = end_m_s + decay_ * (device_m_s_ - end_m_s);
  }

  BodyOnDevice on_;
  Coupling coupling_;
  double stiffness_N_m_, period_s_, decay_ = 1;
  double body_m_ = 1, body_m_s_ = 0, device_m_ = 0, device_m_s_ = 0, last_N_ = 0;
  std::array<double, 16> on_the_way_{};
  std::size_t written_ = 0;
};

// A wide plate that tips over slowly, above a proxy at the device's origin: it weighs `weight_N`, or nothing.
class PlateScene {
 public:
  static constexpr double kGap_m = 1e-6;

  explicit PlateScene(double mass_kg) : mass_kg_(mass_kg) {
    const Vec3 half(0.5, 0.005, 0.5);
    Model model;
    const Convex box = boxShape(half);
    model.positions = box.vertices;
    for (const Convex::Face& face : box.faces) {
      model.triangles.push_back({face.corners[0], face.corners[1], face.corners[2]});
      model.triangles.push_back({face.corners[0], face.corners[2], face.corners[3]});
    }
    plate_.shape = makeShape(std::move(model), HierarchyKind::kNone);
    plate_.surfaces = surfacesOf(plate_.shape);
    plate_.key = 1;
    BodySpec spec;
    spec.mass_kg = mass_kg;
    spec.shape = BodyShape::kBox;
    spec.surface = {0, 0, 0};
    const Pose start{Mat3::Identity(), {0, BenchSession::kRadius_m + kGap_m + half.y(), 0}};
    plate_.body = makeRigidBody("plate", spec, start, plate_.shape->bounds, {Vec3::Constant(-10), Vec3::Constant(10)});
    plate_.driver = plate_.body->poses;
  }
  std::shared_ptr<const Snapshot> that(double weight_N) const {
    return makeSnapshot({plate_}, {}, 1, 0, {Vec3(0, -weight_N / mass_kg_, 0), {}});
  }

 private:
  double mass_kg_;
  Instance plate_;
};

// Of a force or a stretch, whose swings are given one by one.
class Growth {
 public:
  explicit Growth(double whole) : whole_(whole) {}
  void add(double part, double swing) {
    if (part > 0.2 && part < 0.4) early_ = std::max(early_, swing);
    if (part > 0.8) late_ = std::max(late_, swing);
  }
  // A swing that stays is distinguished from one that grows: samples miss its peaks by different parts.
  bool grows(double least) const { return late_ > 1.001 * early_ && late_ > least * whole_; }

 private:
  double whole_, early_ = 0, late_ = 0;
};

template <typename Grows>
double border(double low_N_m, double high_N_m, Grows grows) {
  while (high_N_m / low_N_m > 1.005) {
    const double middle = std::sqrt(low_N_m * high_N_m);
    (grows(middle) ? high_N_m : low_N_m) = middle;
  }
  return std::sqrt(low_N_m * high_N_m);
}

// The first stiffness of steps of root two whose swing grows is above the border.
template <typename Grows>
double borderFrom(double low_N_m, Grows grows) {
  for (double high_N_m = low_N_m * M_SQRT2; high_N_m < kBodyStiffnessHigh_N_m; high_N_m *= M_SQRT2) {
    if (grows(high_N_m)) return border(high_N_m / M_SQRT2, high_N_m, grows);
  }
  return kBodyStiffnessHigh_N_m;
}

}  // namespace

double leastDamping_Ns_m(const BodyOnDevice& on, const Coupling& coupling, double stiffness_N_m) {
  return std::max(0.0, stiffness_N_m / on.rate_Hz * costOf(on, coupling));
}

double mostStiffness_N_m(const BodyOnDevice& on, const Coupling& coupling) {
  const double cost = costOf(on, coupling);
  return cost > 0 ? on.damping_Ns_m * on.rate_Hz / cost : std::numeric_limits<double>::infinity();
}

bool swingGrows(const BodyOnDevice& on, const Coupling& coupling, double stiffness_N_m) {
  constexpr int kSteps = 400'000;
  TwoMasses masses(on, coupling, stiffness_N_m);
  Growth growth(1);
  for (int i = 0; i < kSteps; ++i) {
    masses.step();
    const double swing_m = std::abs(masses.stretch_m());
    if (!(swing_m < 1e6)) return true;
    growth.add(static_cast<double>(i) / kSteps, swing_m);
  }
  return growth.grows(1e-9);
}

bool swingGrows(const BodyOnDevice& on, double stiffness_N_m) {
  constexpr double kTime_s = 5, kMaxWeight_N = 0.05, kGravity_m_s2 = 9.81, kMin = 0.01;
  const double weight_N = std::min(kMaxWeight_N, kGravity_m_s2 * on.body_kg);
  StabilityCase loop;
  loop.device.model = linearDevice(on.device_kg, on.damping_Ns_m);
  loop.device.held = false;
  loop.device.delay_steps = on.delay_steps;
  loop.rate_Hz = on.rate_Hz;
  const PlateScene scene(on.body_kg);
  BenchSession session(loop, stiffness_N_m, scene.that(0));
  session.steps(BenchSession::kReady_s);
  const double rest_m = weight_N / stiffness_N_m;
  session.device().setLoad({0, weight_N, 0});
  session.device().place({0, PlateScene::kGap_m + (1 + kTheirSwing) * rest_m, 0}, Vec3::Zero());
  session.show(scene.that(weight_N));
  Growth growth(weight_N);
  for (double t = 0; t < kTime_s; t += session.period_s()) {
    session.step();
    const double swing_N = std::abs(-session.force_N().y() - weight_N);
    if (!session.on() || (t > 0.2 * kTime_s && swing_N > 0.9 * weight_N)) return true;
    growth.add(t / kTime_s, swing_N);
  }
  return growth.grows(kMin);
}

double highestStiffnessOnBody_N_m(const BodyOnDevice& on, const Coupling& coupling) {
  return borderFrom(kBodyStiffnessLow_N_m,
                    [&](double stiffness_N_m) { return swingGrows(on, coupling, stiffness_N_m); });
}

double highestStiffnessOnBody_N_m(const BodyOnDevice& on) {
  const double wall_N_m = on.damping_Ns_m * on.rate_Hz / (0.5 + on.delay_steps);
  return borderFrom(std::min(wall_N_m / 2, kBodyStiffnessHigh_N_m / 2),
                    [&](double stiffness_N_m) { return swingGrows(on, stiffness_N_m); });
}

}  // namespace hl

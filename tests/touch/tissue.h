// A client that computes its own deformation, on a virtual clock: a mesh of compliance C_t, moved as a whole by frames
// that come at a fixed rate and were computed for the force of some frames before.
#pragma once

#include <cmath>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "device/device_models.h"
#include "proxy/effect_scenes.h"
#include "touch/touch_step.h"

namespace hl::test {

inline constexpr std::int64_t kMilli_ns = 1'000'000;

struct TissueClient {
  double compliance_m_N = 0.01;  ///< C_t
  double frames_Hz = 30;
  int latency = 1;                    ///< frames from the force to the mesh that was computed for it
  std::optional<double> given_m_N{};  ///< C that it gives; none: it gives nothing
  double moving = 0.5;                ///< part of a frame in which the mesh moves
  Model surface = floorModel();       ///< of which the proxy touches the point at the origin, or above it
  /// In the place of C_t F: the depth of the floor, m, by the force that a frame was computed for and its length, s.
  std::function<double(double force_N, double frame_s)> depth{};
};

/// Servo of K, without damping and limits, and the finger where the test puts it.
class Tissue {
 public:
  explicit Tissue(const TissueClient& client, double spring_N_m = 1000, double friction = 0)
      : client_(client),
        period_ms_(std::llround(1000 / client.frames_Hz)),
        floor_(makeFloor(0, friction)),
        scenes_(sceneOf(nullptr)),
        loop_(scenes_, {}) {
    settings_ = ServoSettings::of(premium10().info);
    settings_.stiffness_N_m = spring_N_m;
    settings_.damping_Ns_m = settings_.friction_N = 0;
    settings_.ramp_s = settings_.period_s;
    settings_.velocity_limit_m_s = settings_.force_rate_limit_N_s = settings_.force_limit_N = 1e9;
    commands_.radius_W = kRadius_m;
    arm(step_.servo());
    used_N_.assign(static_cast<std::size_t>(client.latency), Vec3(Vec3::Zero()));
    for (int i = 0; i < 100; ++i) step({0, 0.05, 0});  // the first scene has been faded in
  }

  /// As if it had been pressed by f along y for long; the finger is to be at restFinger(f).
  void startAt(double f_N) {
    used_N_.assign(used_N_.size(), Vec3(0, f_N, 0));
    const Vec3 above(0, kRadius_m, 0);
    for (int i = 0; i < 4 * client_.latency; ++i) {
      const Vec3 kept = force_N_;
      force_N_ = {0, f_N, 0};
      frame(0);
      for (int ms = 0; ms < period_ms_; ++ms) step(above);
      force_N_ = kept;
    }
    force_N_ = {0, f_N, 0};
    finger_ = restFinger(f_N);
    for (int i = 0; i < 2; ++i) step(finger_);
  }
  Vec3 restFinger(double f_N) const {
    return {0, kRadius_m - f_N * (1 / settings_.stiffness_N_m + client_.compliance_m_N), 0};
  }

  /// One frame, and the steps up to the next. Returns the force at its end.
  double run(const Vec3& finger) {
    frame(std::exchange(push_m_, 0));
    for (int ms = 0; ms < period_ms_; ++ms) step(finger);
    return force_N_.y();
  }
  /// The same with the finger where `finger()` says at each step.
  double runFollowing(const std::function<Vec3()>& finger) {
    frame(0);
    for (int ms = 0; ms < period_ms_; ++ms) step(finger());
    return force_N_.y();
  }
  void frameOnly() { frame(0); }
  Vec3 step(const Vec3& finger) {
    now_ns_ += kMilli_ns;
    DeviceSample sample;
    sample.time_ns = now_ns_;
    sample.position = finger_ = finger;
    sample.status = DeviceStatus::kOk;
    const Vec3 before_N = force_N_;
    force_N_ = step_.onTime(loop_, commands_, settings_, sample).force_N;
    largest_change_N_ = std::max(largest_change_N_, (force_N_ - before_N).norm());
    return force_N_;
  }
  /// Raises the mesh of the next frame by this.
  void push(double up_m) { push_m_ = up_m; }
  const Vec3& force_N() const { return force_N_; }
  double takeLargestChange_N() { return std::exchange(largest_change_N_, 0); }
  double frame_s() const { return 1e-3 * static_cast<double>(period_ms_); }
  ProxyLoop& loop() { return loop_; }
  const TouchStep& touch() const { return step_; }
  ServoSettings& settings() { return settings_; }
  static constexpr double kRadius_m = 0.002;

 private:
  Model floorAt(double depth_m, double friction, double x = 0) const {
    Model model = client_.surface;
    for (Vec3& p : model.positions) p += Vec3(x, -depth_m, 0);
    model.materials[0].static_friction = model.materials[0].dynamic_friction = friction;
    return model;
  }
  std::shared_ptr<const Shape> makeFloor(double depth_m, double friction) {
    friction_ = friction;
    return makeShape(floorAt(depth_m, friction));
  }
  std::shared_ptr<const Snapshot> sceneOf(std::shared_ptr<const MeshMotion> motion) {
    Instance instance;
    instance.shape = floor_;
    instance.surfaces = surfacesOf(floor_);
    instance.key = 1;
    instance.mesh_motion = std::move(motion);
    instance.answers_force = true;
    if (compliance_) instance.compliance = std::make_shared<const ComplianceMotion>(*compliance_);
    return makeSnapshot({instance}, "tissue", ++number_, 0);
  }
  // The floor goes to where the force of some frames ago has pressed it.
  void frame(double by_itself_m) {
    used_N_.push_back(force_N_);
    const Vec3 used_N = used_N_[used_N_.size() - static_cast<std::size_t>(client_.latency)];
    if (used_N_.size() > 8) used_N_.pop_front();
    const double depth_m = client_.depth ? client_.depth(used_N.y(), frame_s()) : client_.compliance_m_N * used_N.y();
    const double x = client_.depth ? 0 : -client_.compliance_m_N * used_N.x();
    const auto before = floor_;
    floor_ = makeShape(floorAt(depth_m - by_itself_m, friction_, x), *before);
    const auto end_ns = now_ns_ + std::llround(client_.moving * static_cast<double>(period_ms_)) * kMilli_ns;
    auto motion = motion_ && motion_->end_ns() > now_ns_
                      ? std::make_shared<MeshMotion>(motion_->then(floor_, now_ns_, end_ns))
                      : std::make_shared<MeshMotion>(MeshTransition(before, floor_, now_ns_, end_ns));
    motion_ = motion;
    if (client_.given_m_N) {
      const Compliance to{*client_.given_m_N, *client_.given_m_N, used_N};
      compliance_ = compliance_.value_or(ComplianceMotion(Compliance{to.normal_m_N, to.tangential_m_N, Vec3::Zero()}))
                        .then(to, motion->last().begin_ns(), motion->last().end_ns());
    }
    scenes_.publish(sceneOf(motion));
  }

  TissueClient client_;
  std::int64_t period_ms_, now_ns_ = 0;
  std::uint64_t number_ = 0;
  double push_m_ = 0, friction_ = 0, largest_change_N_ = 0;
  std::shared_ptr<const Shape> floor_;
  std::shared_ptr<const MeshMotion> motion_;
  std::optional<ComplianceMotion> compliance_;
  SnapshotSlot scenes_;
  ProxyLoop loop_;
  TouchStep step_;
  ServoSettings settings_;
  ProxyCommands commands_;
  std::deque<Vec3> used_N_;
  Vec3 force_N_ = Vec3::Zero(), finger_ = Vec3::Zero();
};

}  // namespace hl::test

// SessionBodies: the moving bodies and the joints of one client in the scene that is shown.
#pragma once

#include <hl.pb.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scene/snapshot.h"
#include "touch/body_events.h"

namespace hl {

/// One thread, but for wantsEvent().
class SessionBodies {
 public:
  explicit SessionBodies(std::uint32_t session) : session_(session) {}

  /// Whether states list them.
  void want(bool wanted) { wanted_ = wanted; }
  /// From now on the client is sent their events, of impacts those of more than `impacts_above_N_s`; absent: none.
  void wantEvents(std::optional<double> impacts_above_N_s) { sent_above_N_s_ = impacts_above_N_s.value_or(kNothing); }
  /// Whether the client is sent this one. Any thread.
  bool wantsEvent(const BodyEvent& event) const {
    const double above_N_s = sent_above_N_s_;
    if (event.object.session != session_ || above_N_s < 0) return false;
    return event.kind != BodyEventKind::kImpact || event.impulse_N_s > above_N_s;
  }
  bool wanted() const { return wanted_; }
  /// From now on those of this scene.
  void follow(const Snapshot& scene);
  /// Where they are now, and what the joints do.
  void describe(proto::ClientState& out) const;
  /// Of those of an object, or of the ones of this name among them. In the order of their calls' keys.
  std::vector<std::uint64_t> keysOf(std::uint32_t object, std::optional<std::uint32_t> name) const;

 private:
  struct One {
    std::uint64_t key = 0;
    std::uint32_t object = 0, name = 0;
    std::shared_ptr<const RigidBody> body;
  };

  const std::uint32_t session_;
  bool wanted_ = false;
  static constexpr double kNothing = -1;
  std::atomic<double> sent_above_N_s_{kNothing};
  std::uint64_t scene_ = 0;  // identity; 0: none yet
  std::vector<One> bodies_;
  struct OneJoint {
    std::uint32_t id = 0;
    std::shared_ptr<const SharedJoint> shown;
  };
  std::vector<OneJoint> joints_;  // by id
};

}  // namespace hl

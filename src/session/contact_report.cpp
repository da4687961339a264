#include "session/contact_report.h"

#include <algorithm>
#include <array>
#include <vector>

#include "session/state_messages.h"

namespace hl {

namespace {

// A finger that slides over a fine mesh meets many primitives in a frame: of more than these, the forces go to those
// of the same item that are nearest.
constexpr std::size_t kMaxPressed = 64;

// What one primitive has borne. Places are means, weighted by the forces.
struct Pressed {
  FeltContact first;
  Vec3 impulse_N = Vec3::Zero();  // sum over steps
  double weight_N = 0;
  Vec3 point_N_m = Vec3::Zero();
  std::array<double, 3> weights_N{};

  bool isOf(const FeltContact& contact) const {
    return first.session == contact.session && first.object == contact.object && first.item == contact.item &&
           first.name == contact.name;
  }
  void add(const FeltContact& contact) {
    const double force_N = contact.force_N.norm();
    impulse_N += contact.force_N;
    if (first.kind != contact.kind || first.primitive != contact.primitive) return;
    weight_N += force_N;
    point_N_m += force_N * contact.point_W;
    for (std::size_t i = 0; i < 3; ++i) weights_N[i] += force_N * contact.weights[i];
  }
};

class PressedList {
 public:
  void add(const FeltContact& contact) {
    const auto same = [&](const Pressed& one) {
      return one.isOf(contact) && one.first.kind == contact.kind && one.first.primitive == contact.primitive;
    };
    auto found = std::find_if(all_.begin(), all_.end(), same);
    if (found == all_.end() && all_.size() >= kMaxPressed) found = nearest(contact);
    if (found == all_.end()) {
      Pressed fresh;
      fresh.first = contact;
      found = all_.insert(found, fresh);
    }
    found->add(contact);
  }
  const std::vector<Pressed>& all() const { return all_; }

 private:
  std::vector<Pressed>::iterator nearest(const FeltContact& contact) {
    auto best = all_.end();
    for (auto at = all_.begin(); at != all_.end(); ++at) {
      if (!at->isOf(contact)) continue;
      const auto distance = [&](const Pressed& one) { return (one.first.point_W - contact.point_W).squaredNorm(); };
      if (best == all_.end() || distance(*at) < distance(*best)) best = at;
    }
    return best;
  }

  std::vector<Pressed> all_;
};

void describe(const Pressed& pressed, double steps, proto::PressedPoint& out) {
  const FeltContact& first = pressed.first;
  out.set_object(first.object);
  out.set_name(first.name);
  out.set_session(first.session);
  out.set_item(first.item);
  out.set_primitive(first.primitive);
  const bool known = pressed.weight_N > 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(first.kind); ++i) {
    out.add_vertices(first.vertices[i]);
    out.add_weights(known ? pressed.weights_N[i] / pressed.weight_N : first.weights[i]);
  }
  toProto(known ? Vec3(pressed.point_N_m / pressed.weight_N) : first.point_W, *out.mutable_point());
  toProto(pressed.impulse_N / steps, *out.mutable_force_n());
}

}  // namespace

void reportContacts(const TouchSession& session, std::uint64_t& next, proto::ContactReport& out) {
  const LogRing<ServoMoment>& moments = session.moments();
  const std::uint64_t end = moments.pushed();
  if (end - next > moments.room()) next = end - moments.room();
  PressedList pressed;
  Vec3 sum_N = Vec3::Zero();
  std::uint64_t steps = 0;
  std::int64_t last_ns = 0;
  for (ServoMoment moment; next < end; ++next) {
    if (!moments.read(next, moment)) continue;  // the servo has passed it meanwhile
    ++steps;
    last_ns = moment.time_ns;
    sum_N += moment.force_N;
    for (const FeltContact& contact : moment.contacts) pressed.add(contact);
  }
  out.set_time_s(steps > 0 ? session.time_s(last_ns) : session.time_s());
  out.set_interval_s(static_cast<double>(steps) / session.servoRate_Hz());
  if (steps == 0) return;
  const auto count = static_cast<double>(steps);
  toProto(sum_N / count, *out.mutable_force_n());
  for (const Pressed& one : pressed.all()) describe(one, count, *out.add_contacts());
}

}  // namespace hl

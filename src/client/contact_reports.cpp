#include "client/contact_reports.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/vec_messages.h"

namespace hl::client {

namespace {

// The application may never ask: what comes beyond goes to the nearest place of the same item.
constexpr std::size_t kMaxPoints = 1024;

std::array<double, 3> vectorOf(const proto::Vec3& v) { return {v.x(), v.y(), v.z()}; }
void set(proto::Vec3& out, const std::array<double, 3>& v) { setVec(out, v[0], v[1], v[2]); }
double lengthOf(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }
std::array<double, 3> sumOf(const std::array<double, 3>& a, const std::array<double, 3>& b, double factor = 1) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
double distance(const proto::PressedPoint& a, const proto::PressedPoint& b) {
  return lengthOf(sumOf(vectorOf(a.point()), vectorOf(b.point()), -1));
}

bool isSameItem(const proto::PressedPoint& a, const proto::PressedPoint& b) {
  return a.session() == b.session() && a.object() == b.object() && a.item() == b.item() && a.name() == b.name();
}
bool isSamePlace(const proto::PressedPoint& a, const proto::PressedPoint& b) {
  return isSameItem(a, b) &&
         std::equal(a.vertices().begin(), a.vertices().end(), b.vertices().begin(), b.vertices().end());
}

// Adds the impulse of `from`. Of the same vertices the weights become the mean.
void join(proto::PressedPoint& to, const proto::PressedPoint& from) {
  const double a = lengthOf(vectorOf(to.force_n())), b = lengthOf(vectorOf(from.force_n()));
  if (isSamePlace(to, from) && a + b > 0) {
    for (int i = 0; i < std::min(to.weights_size(), from.weights_size()); ++i)
      to.set_weights(i, (a * to.weights(i) + b * from.weights(i)) / (a + b));
    const auto point =
        sumOf(vectorOf(to.point()), sumOf(vectorOf(from.point()), vectorOf(to.point()), -1), b / (a + b));
    set(*to.mutable_point(), point);
  }
  set(*to.mutable_force_n(), sumOf(vectorOf(to.force_n()), vectorOf(from.force_n())));
}

void scaleForce(proto::PressedPoint& point, double factor) {
  set(*point.mutable_force_n(), sumOf({}, vectorOf(point.force_n()), factor));
}

}  // namespace

void ContactReports::keep(bool wanted) {
  wanted_ = wanted;
  points_.clear();
  impulse_Ns_ = {};
  interval_s_ = 0;
}

void ContactReports::add(const proto::ContactReport& report) {
  if (!wanted_) return;  // it was on its way
  time_s_ = report.time_s();
  interval_s_ += report.interval_s();
  impulse_Ns_ = sumOf(impulse_Ns_, vectorOf(report.force_n()), report.interval_s());
  for (proto::PressedPoint point : report.contacts()) {
    scaleForce(point, report.interval_s());
    const auto same = [&](const proto::PressedPoint& one) { return isSamePlace(one, point); };
    auto found = std::find_if(points_.begin(), points_.end(), same);
    if (found == points_.end() && points_.size() >= kMaxPoints) {
      found = std::min_element(points_.begin(), points_.end(), [&](const auto& a, const auto& b) {
        const bool of_a = isSameItem(a, point), of_b = isSameItem(b, point);
        return of_a != of_b ? of_a : distance(a, point) < distance(b, point);
      });
    }
    found == points_.end() ? points_.push_back(point) : join(*found, point);
  }
}

ContactReports::Taken ContactReports::take(HLuint session) {
  Taken taken;
  taken.points = std::exchange(points_, {});
  taken.report.time = time_s_;
  taken.report.interval = std::exchange(interval_s_, 0);
  const double per_s = taken.report.interval > 0 ? 1 / taken.report.interval : 0;
  const auto force_N = sumOf({}, std::exchange(impulse_Ns_, {}), per_s);
  std::copy(force_N.begin(), force_N.end(), taken.report.force);
  if (taken.report.interval > 0) last_N_.clear();
  for (proto::PressedPoint& point : taken.points) {
    scaleForce(point, per_s);
    if (point.session() != session) continue;
    auto& sum_N = last_N_[point.object()];
    sum_N = sumOf(sum_N, vectorOf(point.force_n()));
  }
  std::stable_sort(taken.points.begin(), taken.points.end(), [](const auto& a, const auto& b) {
    return lengthOf(vectorOf(a.force_n())) > lengthOf(vectorOf(b.force_n()));
  });
  return taken;
}

std::array<double, 3> ContactReports::forceOf(HLuint object) const {
  const auto found = last_N_.find(object);
  return found == last_N_.end() ? std::array<double, 3>{} : found->second;
}

}  // namespace hl::client

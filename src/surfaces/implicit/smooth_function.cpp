#include "surfaces/implicit/smooth_function.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

/// One local coordinate: row . p + offset.
template <typename Result, typename Number>
struct Coordinate {
  static Result of(const std::array<Number, 3>& p, const Vec3& row, double offset) {
    return ((row.x() * p[0] + row.y() * p[1]) + row.z() * p[2]) + offset;
  }
};

template <typename Number, int kOrder>
struct Coordinate<Jet<Number, kOrder>, Number> {
  static Jet<Number, kOrder> of(const std::array<Number, 3>& p, const Vec3& row, double offset) {
    Jet<Number, kOrder> result;
    result.value = Coordinate<Number, Number>::of(p, row, offset);
    for (std::size_t i = 0; i < 3; ++i) result.slope[i] = Number() + row[static_cast<Eigen::Index>(i)];
    return result;
  }
};

// The distance from the surface where it is outside and simple, below 0 inside.
template <typename T>
T ownValue(const SmoothBody& body, const std::array<T, 3>& p) {
  using Flat = std::array<T, 2>;
  constexpr std::array<double, 2> kNone{};
  switch (body.kind) {
    case BodyKind::kHalfSpace:
      return p[2];
    case BodyKind::kSphere:
    case BodyKind::kRoundBox:
    case BodyKind::kCapsule:
      return lengthOf(p, {body.half.x(), body.half.y(), body.half.z()}) + -body.radius;
    case BodyKind::kRod:
      return lengthOf(Flat{p[0], p[1]}, kNone) + -body.radius;
    case BodyKind::kTorus:
      return lengthOf(Flat{lengthOf(Flat{p[0], p[1]}, kNone) + -body.ring, p[2]}, kNone) + -body.radius;
    case BodyKind::kGyroid:
      break;
  }
  const Turn<T> x = turnOf(p[0]), y = turnOf(p[1]), z = turnOf(p[2]);
  return (x.sine * y.cosine + y.sine * z.cosine) + z.sine * x.cosine;
}

template <typename Result, typename Number>
Result valueOfBody(const SmoothBody& body, const std::array<Number, 3>& p) {
  using Local = Coordinate<Result, Number>;
  const std::array<Result, 3> local{Local::of(p, body.axes.row(0), body.offset.x()),
                                    Local::of(p, body.axes.row(1), body.offset.y()),
                                    Local::of(p, body.axes.row(2), body.offset.z())};
  return body.gain * ownValue(body, local) + body.shift;
}

}  // namespace

SmoothFunction::SmoothFunction(const SmoothFunction& a, const SmoothFunction& b, double reach)
    : steps_(a.steps_), waiting_(std::max(a.waiting_, b.waiting_ + 1)) {
  steps_.insert(steps_.end(), b.steps_.begin(), b.steps_.end());
  steps_.push_back({SmoothBody(), reach});
}

void SmoothFunction::negate() {
  for (Step& step : steps_) {
    step.body.gain = -step.body.gain;
    step.body.shift = -step.body.shift;
    step.blend = -step.blend;
  }
}

// A blend of two values that are both larger is larger by the same.
void SmoothFunction::shift(double by) {
  for (Step& step : steps_) step.body.shift += by;
}

template <typename Result, typename Number>
Result SmoothFunction::evaluated(const std::array<Number, 3>& p) const {
  if (steps_.size() == 1) return valueOfBody<Result>(steps_.front().body, p);
  std::array<Result, kMaxWaiting> waiting;
  std::size_t count = 0;
  for (const Step& step : steps_) {
    if (step.blend == 0) {
      waiting[count++] = valueOfBody<Result>(step.body, p);
      continue;
    }
    --count;
    Result& a = waiting[count - 1];
    const Result& b = waiting[count];
    a = step.blend > 0 ? blendOf(a, b, step.blend) : -blendOf(-a, -b, -step.blend);
  }
  return waiting[0];
}

bool SmoothFunction::isNoSteeperThanDistance() const {
  return std::none_of(steps_.begin(), steps_.end(),
                      [](const Step& step) { return step.blend == 0 && step.body.kind == BodyKind::kGyroid; });
}

std::optional<Vec3> SmoothFunction::halfPeriod() const {
  if (steps_.size() != 1 || steps_.front().body.kind != BodyKind::kGyroid) return std::nullopt;
  return M_PI * steps_.front().body.axes.inverse().cwiseAbs().rowwise().sum();
}

double SmoothFunction::at(const Vec3& p) const { return evaluated<double, double>({p.x(), p.y(), p.z()}); }

Lanes SmoothFunction::at(const std::array<Lanes, 3>& p) const { return evaluated<Lanes, Lanes>(p); }

Jet<double, 1> SmoothFunction::slopeAt(const Vec3& p) const {
  return evaluated<Jet<double, 1>, double>({p.x(), p.y(), p.z()});
}

Jet<Lanes, 1> SmoothFunction::slopeAt(const std::array<Lanes, 3>& p) const {
  return evaluated<Jet<Lanes, 1>, Lanes>(p);
}

Vec3 SmoothFunction::gradient(const Vec3& p) const {
  const Jet<double, 1> jet = slopeAt(p);
  return {jet.slope[0], jet.slope[1], jet.slope[2]};
}

Interval SmoothFunction::over(const Space& box) const { return evaluated<Interval, Interval>(box); }

Jet<Interval, 1> SmoothFunction::slopeOver(const Space& box) const {
  return evaluated<Jet<Interval, 1>, Interval>(box);
}

Jet<Interval, 2> SmoothFunction::bendOver(const Space& box) const { return evaluated<Jet<Interval, 2>, Interval>(box); }

}  // namespace hl

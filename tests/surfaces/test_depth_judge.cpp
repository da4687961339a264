// A judge of depth images under a finger that shares nothing with the proxy: it has the stored triangles as a list, and
// knows of each place whether the camera sees it before them. From image to image and from tick to tick it asks that
// the proxy keeps its radius, stays on its side of the stored surface and is not let go of by noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "cases.h"
#include "environment.h"
#include "fields.h"
#include "proxy/leave_matter.h"
#include "proxy/proxy.h"
#include "surfaces/depth_frame.h"

namespace hl::test_depth_judge {
namespace {

using test::Random;

enum class Side { kNone, kFront, kBehind };  // kNone: the camera sees no triangle there

// Ericson, Real-Time Collision Detection, 5.1.5.
Vec3 closestOf(const std::array<Vec3, 3>& t, const Vec3& p) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return t[0];
  if (d3 >= 0 && d4 <= d3) return t[1];
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double a = d3 * d6 - d5 * d4, b = d5 * d2 - d1 * d6, c = d1 * d4 - d3 * d2;
  if (c <= 0 && d1 >= 0 && d3 <= 0) return t[0] + d1 / (d1 - d3) * ab;
  if (b <= 0 && d2 >= 0 && d6 <= 0) return t[0] + d2 / (d2 - d6) * ac;
  if (a <= 0 && d4 >= d3 && d5 >= d6) return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
  return t[0] + (b * ab + c * ac) / (a + b + c);
}

/// The triangles of a stored image, in the frame of its camera: x to the right, y down, z away from it.
class StoredSurface {
 public:
  explicit StoredSurface(const DepthImage& image) : camera_(image.camera), pixels_(image.pixels) {
    for (std::uint32_t j = 0; j + 1 < pixels_.rows(); ++j) {
      for (std::uint32_t i = 0; i + 1 < pixels_.columns(); ++i) add(i, j);
    }
  }

  Side sideOf(const Vec3& p) const {
    if (!(p.z() > 0)) return Side::kNone;
    const double u = camera_.cx + camera_.fx * p.x() / p.z(), v = camera_.cy + camera_.fy * p.y() / p.z();
    if (!(u >= 0 && v >= 0 && u < pixels_.columns() - 1.0 && v < pixels_.rows() - 1.0)) return Side::kNone;
    const auto i = static_cast<std::uint32_t>(u), j = static_cast<std::uint32_t>(v);
    const std::array<std::uint32_t, 2> middle =
        u - i > v - j ? std::array{i + 1, j} : std::array{i, j + 1};  // of the triangle beside the diagonal
    if (!joined(i, j, middle)) return Side::kNone;
    const Vec3 a = at(i, j), b = at(middle[0], middle[1]), c = at(i + 1, j + 1), normal = (b - a).cross(c - a);
    const double there = normal.dot(a), here = normal.dot(p);  // on the ray of p the plane is at p there / here
    return here / there < 1 ? Side::kFront : Side::kBehind;
  }

  double clearance(const Vec3& p, double most) const {
    double least = most;
    for (const Bounded& each : triangles_) {
      if ((each.middle - p).norm() - each.radius >= least) continue;
      least = std::min(least, (closestOf(each.corners, p) - p).norm());
    }
    return least;
  }

  /// Of a place over a gap: in front, if a ball comes to it along its ray from the camera, and not through the surface.
  Side sideOverGap(const Vec3& p, double radius) const {
    constexpr double kNearCamera = 0.3, kStops = 1e-3, kAt = 0.05;
    constexpr int kMaxSteps = 1000;
    const Vec3 way = p.normalized();
    double at = kNearCamera * p.norm();
    for (int i = 0; i < kMaxSteps && at < 2 * p.norm(); ++i) {
      const double room = clearance(at * way, p.norm()) - radius;
      if (room <= kStops * radius) return at >= p.norm() - kAt * radius ? Side::kFront : Side::kNone;
      at += room;
    }
    return Side::kNone;
  }

  /// Whether something is missing, or the image ends, within the distance of p.
  bool opensNear(const Vec3& p, double distance) const {
    for (const Bounded& hole : holes_) {
      if ((hole.middle - p).norm() - hole.radius < distance) return true;
    }
    const double across = camera_.cx / camera_.fx, down = camera_.cy / camera_.fy;  // the camera looks at the middle
    const double from_side = (across * p.z() - std::abs(p.x())) / std::hypot(1, across);
    const double from_top = (down * p.z() - std::abs(p.y())) / std::hypot(1, down);
    return std::min({from_side, from_top, p.z()}) < distance;
  }

 private:
  struct Bounded {
    std::array<Vec3, 3> corners;
    Vec3 middle;
    double radius;
  };

  Vec3 at(std::uint32_t i, std::uint32_t j) const { return at(i, j, pixels_.at(i, j)); }
  Vec3 at(std::uint32_t i, std::uint32_t j, double depth) const {
    return depth * Vec3((i - camera_.cx) / camera_.fx, (j - camera_.cy) / camera_.fy, 1);
  }
  bool joined(std::uint32_t i, std::uint32_t j, const std::array<std::uint32_t, 2>& middle) const {
    return camera_.joins(pixels_.at(i, j), pixels_.at(middle[0], middle[1]), pixels_.at(i + 1, j + 1));
  }
  static Bounded bounded(const std::array<Vec3, 3>& corners) {
    Bounded result{corners, (corners[0] + corners[1] + corners[2]) / 3, 0};
    for (const Vec3& corner : corners) result.radius = std::max(result.radius, (corner - result.middle).norm());
    return result;
  }
  void add(std::uint32_t i, std::uint32_t j) {
    for (const std::array<std::uint32_t, 2>& middle : {std::array{i + 1, j}, std::array{i, j + 1}}) {
      if (joined(i, j, middle)) {
        triangles_.push_back(bounded({at(i, j), at(middle[0], middle[1]), at(i + 1, j + 1)}));
        continue;
      }
      // Whatever goes through a gap goes between the rays of its pixels, here from 1/2 to 4 times the usual depth.
      for (double depth = 0.25; depth < 2; depth *= 1.25)
        holes_.push_back(bounded({at(i, j, depth), at(middle[0], middle[1], depth), at(i + 1, j + 1, 1.25 * depth)}));
    }
  }

  const DepthCamera& camera_;
  const DepthPixels& pixels_;
  std::vector<Bounded> triangles_, holes_;
};

/// What a camera sees, about half a metre away, with noise; and where it is.
class Seen {
 public:
  static constexpr double kDepth_m = 0.5;

  explicit Seen(Random& random) : random_(random) {
    columns_ = static_cast<std::uint32_t>(16 + random.below(20));
    rows_ = static_cast<std::uint32_t>(16 + random.below(16));
    const double focal = std::pow(10.0, random.uniform(1.5, 3));
    const bool sealed = random.below(2) == 0;
    camera = {focal, focal, 0.5 * (columns_ - 1), 0.5 * (rows_ - 1),
              sealed ? 1 : std::pow(10.0, random.uniform(-2, -0.5))};
    pixel_m = kDepth_m / focal;
    radius_m = pixel_m * std::pow(10.0, random.uniform(std::log10(0.3), std::log10(5)));
    sigma_m_ = radius_m * std::pow(10.0, random.uniform(-2, 0.6));
    missing_ = sealed && random.below(2) == 0 ? 0 : std::pow(10.0, random.uniform(-3, -0.7));
    smoothing = std::array{0.0, 0.5, 0.9, 0.98}[static_cast<std::size_t>(random.below(4))];
    slope_ = random.uniform(0, 0.4) * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
    waves_m_ = random.below(2) == 0 ? 0 : radius_m * std::pow(10.0, random.uniform(-1, 1));
    speed_ = random.uniform(0, 1.5);
    const Mat3 turn = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix();
    frame = cameraFrame(1).placed(turn, random.inCube(2));
  }

  /// The next image, a thirtieth of a second later.
  void next() {
    time_ += 1;
    std::normal_distribution<double> noise(0, sigma_m_);
    std::vector<float> depths;
    for (std::uint32_t j = 0; j < rows_; ++j) {
      for (std::uint32_t i = 0; i < columns_; ++i) {
        const double depth = trueDepth(i, j) + noise(random_.engine());
        const bool lost = random_.uniform(0, 1) < missing_;
        depths.push_back(lost ? 0 : static_cast<float>(std::clamp(depth, 0.6 * kDepth_m, 1.15 * kDepth_m)));
      }
    }
    image = smoothed(*test::gridOf(columns_, rows_, depths), 1, camera, image.get(), smoothing);
    Instance instance;
    instance.shape = makeShape(std::make_shared<const DepthFrame>(image, frame));
    instance.surfaces = surfacesOf(instance.shape);
    instance.key = 1;
    instance.replaced_in = snapshot ? snapshot->number + 1 : 0;
    snapshot = makeSnapshot({instance}, "", snapshot ? snapshot->number + 1 : 1);
  }

  Vec3 inCamera(const Vec3& place) const { return frame.axes.inverse() * (place - frame.origin); }
  /// In the scene, of pixels and a depth.
  Vec3 place(double u, double v, double depth) const {
    return frame.point((u - camera.cx) / camera.fx * depth, (v - camera.cy) / camera.fy * depth, depth);
  }
  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }

  DepthCamera camera;
  double pixel_m = 0, radius_m = 0, smoothing = 0;
  GridFrame frame;
  std::shared_ptr<const DepthImage> image;
  std::shared_ptr<const Snapshot> snapshot;

 private:
  double trueDepth(std::uint32_t i, std::uint32_t j) const {
    const Vec2 at((i - camera.cx) / columns_, (j - camera.cy) / rows_);
    const double waves = std::sin(9 * at.x() + speed_ * time_) * std::cos(7 * at.y() - 0.7 * speed_ * time_);
    return kDepth_m * (1 + slope_.dot(at)) + waves_m_ * waves;
  }

  Random& random_;
  std::uint32_t columns_ = 0, rows_ = 0;
  double sigma_m_ = 0, missing_ = 0, waves_m_ = 0, speed_ = 0;
  Vec2 slope_ = Vec2::Zero();
  int time_ = 0;
};

struct Counts {
  std::size_t images = 0, ticks = 0, touched = 0, pushed = 0, open = 0;
};

/// A finger that wanders over the image, mostly behind its surface, and the judge.
class Touch {
 public:
  Touch(Random& random, Counts& counts) : random_(random), counts_(counts), seen_(random) {
    settings_.radius = seen_.radius_m;
    settings_.iteration_cap = 10'000;
    settings_.work_cap = kNoWorkCap;
    seen_.next();
    state_ =
        startProxy(*seen_.snapshot, settings_, seen_.place(seen_.camera.cx, seen_.camera.cy, 0.5 * Seen::kDepth_m));
    aim();
    finger_ = aim_;
  }

  void run(int images, int ticks) {
    for (int image = 0; image < images && !testing::Test::HasFatalFailure(); ++image) {
      const StoredSurface stored(*seen_.image);
      for (int i = 0; i < ticks && !testing::Test::HasFatalFailure(); ++i) moveIn(stored);
      if (side_ == Side::kNone) side_ = stored.sideOverGap(seen_.inCamera(state_.position), seen_.radius_m);
      const auto before = seen_.image;
      seen_.next();
      ++counts_.images;
      if (!testing::Test::HasFatalFailure()) change(StoredSurface(*seen_.image));
    }
  }

 private:
  // A new goal for the finger, anywhere in the view, at a random speed: from 0.1 to 10 radii a tick.
  void aim() {
    const double u = random_.uniform(0.2, 0.8) * seen_.columns(), v = random_.uniform(0.2, 0.8) * seen_.rows();
    const double depth = random_.below(4) == 0 ? random_.uniform(0.5, 1) : random_.uniform(1, 1.2);
    aim_ = seen_.place(u, v, depth * Seen::kDepth_m);
    speed_m_ = seen_.radius_m * std::pow(10.0, random_.uniform(-1, 1));
  }
  void moveFinger() {
    if (random_.below(40) == 0) aim();
    const Vec3 way = aim_ - finger_;
    finger_ += way * std::min(1.0, speed_m_ / std::max(1e-12, way.norm()));
  }

  // A new image: the proxy is moved if the surface has come too near or has passed it.
  void change(const StoredSurface& stored) {
    ProxyState state = state_;
    leaveMatter(state, *seen_.snapshot, settings_, finger_);
    counts_.pushed += state.position == state_.position ? 0 : 1;
    const Side side = sideOf(stored, state.position);
    if (side_ == Side::kFront) {
      ASSERT_NE(side, Side::kBehind) << "the new surface has passed the proxy" << where();
    }
    ASSERT_TRUE(isClear(stored, state.position)) << "of the new surface" << where();
    if (side != Side::kNone) side_ = side;
  }

  void moveIn(const StoredSurface& stored) {
    moveFinger();
    ProxyState left = state_;  // as the tick begins
    leaveMatter(left, *seen_.snapshot, settings_, finger_);
    const TickReport report = tick(state_, *seen_.snapshot, settings_, finger_);
    ++counts_.ticks;
    counts_.touched += state_.touching ? 1 : 0;
    ASSERT_TRUE(isClear(stored, state_.position)) << where();
    // No step goes farther from the finger.
    const double reach = (left.position - finger_).norm() + seen_.radius_m;
    const bool opens = stored.opensNear(seen_.inCamera(finger_), reach);
    counts_.open += opens ? 1 : 0;
    const Side side = sideOf(stored, state_.position);
    if (!opens && side_ != Side::kNone) {
      ASSERT_EQ(side, side_) << "through the surface in a tick" << where();
      if (side_ == Side::kFront && sideOf(stored, finger_) == Side::kBehind) {
        ASSERT_TRUE(state_.touching) << "let go of, ending " << static_cast<int>(report.ending) << where();
      }
    }
    side_ = side;
  }

  Side sideOf(const StoredSurface& stored, const Vec3& place) const { return stored.sideOf(seen_.inCamera(place)); }
  bool isClear(const StoredSurface& stored, const Vec3& place) const {
    const double radius = settings_.radius;
    return stored.clearance(seen_.inCamera(place), 2 * radius) >= (1 - kRounding) * radius - 1e-12;
  }
  std::string where() const {
    return ", image " + std::to_string(counts_.images) + ", r " + std::to_string(seen_.radius_m / seen_.pixel_m) +
           " pixels, f " + std::to_string(seen_.camera.fx) + ", join " + std::to_string(seen_.camera.join) +
           ", smoothing " + std::to_string(seen_.smoothing);
  }

  static constexpr double kRounding = 1e-6;  // of the radius

  Random& random_;
  Counts& counts_;
  Seen seen_;
  ProxySettings settings_;
  ProxyState state_;
  Side side_ = Side::kFront;
  Vec3 finger_ = Vec3::Zero(), aim_ = Vec3::Zero();
  double speed_m_ = 0;
};

// HL_PICTURES: how many images; 33 ticks on each.
TEST(DepthJudge, TheProxyKeepsItsSideOfTheStoredSurface) {
  constexpr int kUsual = 600, kImagesOfEach = 30, kTicks = 33;
  const int scenes = test::numberIn("HL_PICTURES", test::cases(kUsual)) / kImagesOfEach;
  const int first = test::numberIn("HL_FIRST_SCENE", 0);
  Counts counts;
  for (int scene = first; scene < first + scenes; ++scene) {
    SCOPED_TRACE(scene);
    Random random(static_cast<std::uint64_t>(scene));
    Touch(random, counts).run(kImagesOfEach, kTicks);
    if (HasFatalFailure()) break;
  }
  std::printf("%zu images, %zu ticks, of these %zu touched, %zu near a gap; pushed by %zu images\n", counts.images,
              counts.ticks, counts.touched, counts.open, counts.pushed);
  EXPECT_GT(counts.touched, counts.ticks / 4);
  EXPECT_GT(counts.pushed, counts.images / 10);
}

}  // namespace
}  // namespace hl::test_depth_judge

#include "camera_bench.h"

#include <fmt/core.h>
#include <hl.pb.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "depth_table.h"
#include "io/decode_samples.h"
#include "io/output_file.h"
#include "proxy/proxy.h"
#include "tick/timing.h"

namespace hl {

namespace {

using bench::Timing;

constexpr std::size_t kTicksPerPicture = 33, kFirstPictures = 10;
constexpr double kSmoothing = 0.9;

struct DepthRow {
  std::uint32_t columns = 0, rows = 0;
  double radius_mm = 0, megabytes = 0;
  Timing unpack, filter, tiles, surface, whole;
  Timing ticks, keeping;   // those of the first tick after a picture are `keeping`
  std::size_t passed = 0;  // ticks after which the proxy was behind the surface, having been before it
};

void printDepths(const DepthRow& row) {
  fmt::print("{:>5}x{:<5}{:>5.0f}{:>9.2f}{:>8.2f}{:>8.2f}{:>9.2f}{:>9.2f}{:>9.2f}{:>7.2f}{:>9.2f}{:>10.2f}{:>10.1f}",
             row.columns, row.rows, row.radius_mm, 1e-3 * row.unpack.median_us(), 1e-3 * row.filter.median_us(),
             1e-3 * row.tiles.median_us(), 1e-3 * row.surface.median_us(), 1e-3 * row.whole.median_us(),
             1e-3 * row.whole.max_us(), row.megabytes, row.ticks.median_us(), row.ticks.percentile_us(0.999),
             row.ticks.max_us());
  fmt::print("{:>9.2f}{:>10.1f}{:>8}\n", row.keeping.median_us(), row.keeping.max_us(), row.passed);
  std::fflush(stdout);
}

void writeDepths(OutputFile& csv, const DepthRow& row) {
  csv.print("{},{},{:.3f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{}\n",
            row.columns, row.rows, row.radius_mm, 1e-3 * row.unpack.median_us(), 1e-3 * row.filter.median_us(),
            1e-3 * row.tiles.median_us(), 1e-3 * row.surface.median_us(), 1e-3 * row.whole.median_us(),
            1e-3 * row.whole.max_us(), row.megabytes, row.ticks.median_us(), row.ticks.percentile_us(0.999),
            row.ticks.max_us(), row.keeping.median_us(), row.keeping.max_us(), row.passed);
  csv.flush();
}

/// Pictures of the table by a camera with noise: 0.6 mm at half a metre, as z^2, and a pixel in fifty is missing.
class NoisyCamera {
 public:
  explicit NoisyCamera(const DepthPicture& still) : still_(still), now_(still) {
    std::normal_distribution<double> noise(0, kSigma_1_m);
    std::uniform_int_distribution<int> luck(0, 49);
    for (float& part : noise_) part = luck(random_) == 0 ? NAN : static_cast<float>(still.unit_m * noise(random_));
  }

  /// Valid until the next call.
  const DepthPicture& next() {
    const std::size_t first = random_();
    for (std::size_t i = 0; i < now_.depths.size(); ++i) {
      const auto depth = static_cast<float>(still_.depths[i]);
      const float noisy = depth + depth * depth * noise_[(first + i) % noise_.size()];
      now_.depths[i] = noisy > 0 ? static_cast<std::uint16_t>(std::min(noisy + 0.5F, 65535.0F)) : 0;
    }
    return now_;
  }

 private:
  static constexpr double kSigma_1_m = 2.4e-3;  // times depth^2: sigma

  const DepthPicture& still_;
  DepthPicture now_;
  std::mt19937 random_{1};
  std::vector<float> noise_ = std::vector<float>(std::size_t{1} << 20);  // sigma / depth^2, in units of the depths
};

/// A finger that wanders over the table at 0.15 m/s, 1 to 7 mm beneath the proxy.
class WanderingFinger {
 public:
  const Vec3& next(const Vec3& proxy) {
    constexpr double kReach_m = 0.18, kTurn = 0.05;
    std::normal_distribution<double> turn(0, kTurn);
    heading_ += turn(random_);
    const Vec2 way(std::cos(heading_), std::sin(heading_));
    if (place_.norm() > kReach_m && place_.dot(way) > 0) heading_ += 0.1;
    place_ += bench::kSpeed_m_s * bench::kPeriod_s * way;
    const double depth_m = 0.004 + 0.003 * std::sin(3e-3 * static_cast<double>(++ticks_));
    // Where the proxy is held back, by the wall of a thing, the finger waits for it.
    const Vec2 there(proxy.x(), proxy.z());
    place_ = there + (place_ - there) * std::min(1.0, kLead_m / std::max(kLead_m, (place_ - there).norm()));
    finger_ = {place_.x(), std::max(proxy.y() - depth_m, -0.02), place_.y()};
    return finger_;
  }
  const Vec3& place() const { return finger_; }

 private:
  static constexpr double kLead_m = 0.01;

  std::mt19937 random_{2};
  Vec2 place_{0, 0.1};
  double heading_ = 0;
  std::size_t ticks_ = 0;
  Vec3 finger_{0, 0.02, 0.1};
};

// Of one step; it is what the step returns.
template <typename Step>
auto timed(std::int64_t& time_ns, const Step& step) {
  const std::int64_t begin_ns = monotonicNow_ns();
  auto result = step();
  time_ns = monotonicNow_ns() - begin_ns;
  return result;
}

std::string messageOf(const DepthPicture& picture) {
  proto::Heights message;
  message.add_samples(picture.depths.data(), sizeof(std::uint16_t) * picture.depths.size());
  return message.SerializeAsString();
}

/// Shows each picture to three proxies, which all do the same.
class DepthBench {
 public:
  DepthBench(const DepthPicture& still, double radius_m)
      : camera_(still),
        seen_(std::make_unique<const DepthFrame>(smoothed(still.grid(), still.unit_m, still.camera, nullptr, 0),
                                                 frameOfTable())) {
    settings_.radius = radius_m;
    row_.columns = still.columns;
    row_.rows = still.rows;
    row_.radius_mm = 1e3 * radius_m;
  }

  DepthRow run(std::size_t pictures) {
    for (std::size_t i = 0; i < pictures + kFirstPictures; ++i) {
      counts_ = i >= kFirstPictures;
      show(camera_.next());
      if (i == 0 || fell()) begin();
      for (std::size_t tick = 0; tick < kTicksPerPicture; ++tick) move(tick == 0);
    }
    row_.ticks = ticks_.middle();
    row_.keeping = keeping_.middle();
    return row_;
  }

 private:
  struct Times {
    std::int64_t unpack = 0, filter = 0, tiles = 0, surface = 0;
  };

  std::shared_ptr<const Snapshot> sceneOf(const HeightGrid& grid, const DepthImage* before, const DepthPicture& picture,
                                          Times* times) {
    Times own;
    Times& of = times != nullptr ? *times : own;
    const auto image = timed(
        of.filter, [&] { return smoothed(grid, picture.unit_m, picture.camera, before, before ? kSmoothing : 0); });
    const auto tiles = timed(of.tiles, [&] { return DepthTiles(image->pixels, image->camera); });
    of.filter -= of.tiles;
    auto scene = timed(of.surface, [&] {
      shown_ = std::make_shared<const DepthFrame>(image, frameOfTable());
      Instance instance;
      instance.shape = makeShape(shown_);
      instance.surfaces = surfacesOf(instance.shape);
      instance.key = 1;
      instance.replaced_in = number_;
      return makeSnapshot({instance}, "", ++number_);
    });
    image_ = image;
    row_.megabytes = 1e-6 * static_cast<double>(image->bytes());
    return scene;
  }

  void show(const DepthPicture& picture) {
    const std::string message = messageOf(picture);
    Times times;
    const auto samples = timed(times.unpack, [&] {
      proto::Heights heights;
      heights.ParseFromString(message);
      return samplesOf(heights, sizeof(std::uint16_t) * picture.depths.size());
    });
    const HeightGrid grid({picture.columns, picture.rows, SampleKind::kUint16}, samples);
    scene_ = sceneOf(grid, image_.get(), picture, &times);
    if (!counts_) return;
    row_.unpack.add(times.unpack);
    row_.filter.add(times.filter);
    row_.tiles.add(times.tiles);
    row_.surface.add(times.surface);
    row_.whole.add(times.unpack + times.filter + times.tiles + times.surface);
  }

  void begin() {
    constexpr double kAbove_m = 0.15;
    const Vec3 place = finger_.place();
    states_.fill(startProxy(*scene_, settings_, {place.x(), kAbove_m, place.z()}));
    behind_ = false;
  }
  // Through the shadow of a thing, in which there is no surface.
  bool fell() const { return seen_->siteOf(states_[0].position) == Site::kMatter || states_[0].position.y() < 0; }

  // Whether the surface without noise has no rim near the ray of a place.
  bool isWhole(const Vec3& place) const {
    const DepthCells& cells = seen_->cells();
    const Vec3 q = frameOfTable().axes.inverse() * (place - frameOfTable().origin);
    const DepthCamera& camera = seen_->image().camera;
    const double u = camera.cx + camera.fx * q.x() / q.z(), v = camera.cy + camera.fy * q.y() / q.z();
    const double around = camera.fx * (settings_.radius + kRim_m) / q.z();
    const auto cell = [](double at, std::uint32_t pixels) {
      return static_cast<std::uint32_t>(std::clamp(at, 0.0, pixels - 2.0));
    };
    for (std::uint32_t j = cell(v - around, row_.rows); j <= cell(v + around, row_.rows); ++j) {
      for (std::uint32_t i = cell(u - around, row_.columns); i <= cell(u + around, row_.columns); ++i) {
        if (!cells.exists({i, j, 0}) || !cells.exists({i, j, 1})) return false;
      }
    }
    return true;
  }
  // Behind the picture that is shown. The way of one tick shows nothing: around an edge its ends lie on both sides of a
  // corner that the proxy has gone around.
  bool isBehind() const { return shown_->siteOf(states_[0].position) == Site::kMatter; }

  void move(bool first) {
    const Vec3 before = states_[0].position, finger = finger_.next(before);
    for (std::size_t pass = 0; pass < states_.size(); ++pass) {
      std::int64_t time_ns = 0;
      timed(time_ns, [&] { return tick(states_[pass], {*scene_, 0, recent_[pass]}, settings_, finger); });
      if (counts_) (first ? keeping_ : ticks_).add(static_cast<int>(pass), time_ns);
    }
    const bool behind = isBehind();
    if (counts_ && behind && !behind_ && isWhole(before) && isWhole(states_[0].position)) ++row_.passed;
    behind_ = behind;
  }

  static constexpr double kRim_m = 0.005;  // noise moves the rims

  NoisyCamera camera_;
  std::unique_ptr<const DepthFrame> seen_;  // without noise
  std::uint64_t number_ = 0;
  std::shared_ptr<const DepthImage> image_;
  std::shared_ptr<const DepthFrame> shown_;
  std::shared_ptr<const Snapshot> scene_;
  ProxySettings settings_;
  WanderingFinger finger_;
  std::array<ProxyState, bench::kPasses> states_;
  std::array<ManyRecentPrimitives, bench::kPasses> recent_;
  bench::PassTimes ticks_, keeping_;
  bool counts_ = false, behind_ = false;
  DepthRow row_;
};

constexpr const char* kDepthFooter =
    "\nThe table of depth:table, by a camera with noise of 0.6 mm at half a metre, and smoothing of 0.9; a finger "
    "that\n"
    "wanders over it, 33 ticks a picture. Milliseconds on one thread, in the median: unpack: from the message of a\n"
    "client; filter: with the picture before; tiles: to bound the triangles; surface: the rest, until it can be\n"
    "touched; whole: of all four, and at most. MB: of what is kept. Ticks: the middle one of three times counts. "
    "keep:\n"
    "the first tick after a picture, in the median and at most. passed: ticks after which the proxy was behind the\n"
    "surface that is shown, having been before the one of the tick before, a radius and 5 mm from its rims or more:\n"
    "beyond them are holes, and a proxy that fell through one is lifted again.\n";

}  // namespace

void runCameraBench(const CameraBenchOptions& options) {
  std::optional<OutputFile> csv;
  if (!options.csv.empty()) {
    csv.emplace(options.csv);
    csv->print(
        "columns,rows,radius_mm,unpack_ms,filter_ms,tiles_ms,surface_ms,whole_ms,worst_ms,megabytes,p50_us,p999_us,"
        "worst_us,keep_us,worst_keep_us,passed\n");
  }
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  fmt::print("{:>11}{:>5}{:>9}{:>8}{:>8}{:>9}{:>9}{:>9}{:>7}{:>9}{:>10}{:>10}{:>9}{:>10}{:>8}\n", "pixels", "r mm",
             "unpack", "filter", "tiles", "surface", "whole", "worst", "MB", "p50 us", "p99.9 us", "worst us",
             "keep us", "worst us", "passed");
  constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 2> kSizes{{{640, 480}, {1280, 720}}};
  for (const auto& [columns, rows] : kSizes) {
    const DepthPicture still = pictureOfTable(columns, rows);
    for (const double radius_m : {1e-3, 2e-3, 5e-3}) {
      const DepthRow row = DepthBench(still, radius_m).run(options.pictures);
      printDepths(row);
      if (csv) writeDepths(*csv, row);
    }
  }
  if (csv) csv->close();
  fmt::print(kDepthFooter);
}

}  // namespace hl

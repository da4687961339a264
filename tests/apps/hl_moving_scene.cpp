// hl_moving_scene PAGE_FOLDER: a server whose scene changes, for the tests of the page. It prints the page's address
// and obeys the lines on its standard input until that ends:
//
//   show KIND COUNT   that many objects: a built-in scene's name, or `mixed` for surfaces, lines and points
//   move | still      they circle, or come to rest
#include <atomic>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "builtin.h"
#include "http/http_server.h"
#include "page/viewer_feed.h"
#include "scene/by_key.h"
#include "scene/editable_scene.h"
#include "scene/follow_on.h"
#include "touch/touch_session.h"

namespace hl {
namespace {

constexpr std::int64_t kFrame_ns = 50'000'000;
constexpr double kSide_m = 0.05;     // of one object
constexpr double kTurn_rad_s = 0.4;  // of the circle
constexpr std::size_t kCircle = 6;   // more than that stand in a cube
const Vec3 kUp(0, 1, 0);

struct Wanted {
  std::string kind = "mixed";
  std::size_t count = 0;
  bool moving = true;
};

Model cubeOf(bool lines) {
  Model model;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) model.positions.push_back(kSide_m * Vec3(x, y, z));
  for (std::uint32_t a = 0; a < 8; ++a) {
    if (!lines) model.points.push_back(a);
    for (std::uint32_t bit = 1; bit < 8 && lines; bit *= 2)
      if ((a & bit) == 0) model.segments.push_back({a, a | bit});
  }
  return model;
}

Model modelOf(const std::string& kind) {
  if (kind == "lines" || kind == "points") return cubeOf(kind == "lines");
  Model model = makeBuiltinScene(kind);
  fitModel(model, kSide_m);
  return model;
}

class Shapes {
 public:
  std::shared_ptr<const Shape> get(const std::string& kind, std::size_t i) {
    static const std::vector<std::string> mixed{"teapot", "sphere:2000", "lines", "points", "pipe:2000"};
    auto& shape = shapes_[kind == "mixed" ? mixed[i % mixed.size()] : kind];
    if (!shape) shape = makeShape(modelOf(kind == "mixed" ? mixed[i % mixed.size()] : kind), HierarchyKind::kSpheres);
    return shape;
  }

 private:
  std::map<std::string, std::shared_ptr<const Shape>> shapes_;
};

// On a circle that turns, or in a cube whose objects turn each about itself.
Pose poseOf(std::size_t i, std::size_t count, double angle) {
  const Mat3 turn = Eigen::AngleAxisd(angle + 0.7 * static_cast<double>(i), kUp).toRotationMatrix();
  if (count == 1) return {turn, Vec3::Zero()};
  if (count <= kCircle) {
    const double around = angle + 2 * M_PI * static_cast<double>(i) / static_cast<double>(count);
    return {turn, 1.4 * kSide_m * Vec3(std::cos(around), 0.15 * std::sin(3 * around), std::sin(around))};
  }
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  const Vec3 cell(static_cast<double>(i % side), static_cast<double>(i / side % side),
                  static_cast<double>(i / side / side));
  return {turn, 1.6 * kSide_m * (cell - Vec3::Constant(0.5 * static_cast<double>(side - 1)))};
}

std::vector<PlacedShape> place(const Wanted& wanted, Shapes& shapes, double angle) {
  std::vector<PlacedShape> placed;
  for (std::size_t i = 0; i < wanted.count; ++i) {
    const auto shape = shapes.get(wanted.kind, i);
    const auto id = static_cast<std::uint32_t>(i + 1);
    placed.push_back({shape, surfacesOf(shape), poseOf(i, wanted.count, angle), id, 1, id, 0});
  }
  return placed;
}

class Publisher {
 public:
  explicit Publisher(TouchSession& session) : session_(session) {}

  // One frame of a client, as a server shows it.
  void step(const Wanted& wanted) {
    if (!session_.ready(published_ns_)) return;
    const std::int64_t now_ns = monotonicNow_ns();
    if (wanted.moving) angle_ += kTurn_rad_s * 1e-9 * static_cast<double>(kFrame_ns);
    const auto placed = place(wanted, shapes_, angle_);
    const auto last = session_.snapshot();
    Followed next = followOn(placed, pointersByKey(last->instances), now_ns, now_ns + kFrame_ns);
    session_.publish(makeSnapshot(std::move(next.instances), "moving scene", last->number + 1, next.blend_ns));
    published_ns_ = now_ns;
  }

 private:
  TouchSession& session_;
  Shapes shapes_;
  double angle_ = 0;
  std::int64_t published_ns_ = 0;
};

void obey(const std::string& line, Wanted& wanted) {
  std::istringstream words(line);
  std::string word;
  words >> word;
  if (word == "show") words >> wanted.kind >> wanted.count;
  if (word == "move" || word == "still") wanted.moving = word == "move";
}

void run(const std::string& page_folder) {
  TouchSession session(makeSnapshot(std::vector<Instance>{}, "moving scene"), {});
  HttpServer server({0, page_folder, 60}, makeViewerFeed(session, "test"));
  session.start();
  server.start();
  std::cout << "page: http://127.0.0.1:" << server.port() << "/" << std::endl;
  std::mutex mutex;
  Wanted wanted;
  std::atomic<bool> running{true};
  std::thread publishing([&] {
    Publisher publisher(session);
    while (running) {
      std::unique_lock lock(mutex);
      const Wanted now = wanted;
      lock.unlock();
      publisher.step(now);
      std::this_thread::sleep_for(std::chrono::nanoseconds(kFrame_ns));
    }
  });
  for (std::string line; std::getline(std::cin, line);) {
    const std::lock_guard lock(mutex);
    obey(line, wanted);
  }
  running = false;
  publishing.join();
  server.stop();
  session.stop();
}

}  // namespace
}  // namespace hl

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "usage: hl_moving_scene PAGE_FOLDER\n";
    return 2;
  }
  hl::run(words[1]);
}

// Servers of a shared world for tests, each with its threads, its simulated device and its own replica of what the
// others have.
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bodies_client.h"
#include "share/share_bridge.h"

namespace hl::test {

inline constexpr std::uint64_t kFloor = 1, kBlock = 2;

inline Instance boxInstance(std::uint64_t key, const Vec3& half, const Vec3& centre) {
  Model model;
  model.name = "box";
  proto::Primitives box;
  addBox(box, half);
  for (int i = 0; i < box.vertices_size(); i += 3)
    model.positions.emplace_back(box.vertices(i), box.vertices(i + 1), box.vertices(i + 2));
  for (int i = 0; i < box.triangles_size(); i += 3)
    model.triangles.push_back({box.triangles(i), box.triangles(i + 1), box.triangles(i + 2)});
  model.materials.resize(1);
  Instance instance;
  instance.shape = makeShape(std::move(model));
  instance.surfaces = surfacesOf(instance.shape);
  instance.motion = Motion(Pose{Mat3::Identity(), centre});
  instance.key = key;
  return instance;
}

// A floor whose top is at y = 0, and a block of 100 g that falls on it: out of reach of the hands, or near them.
inline const Vec3 kFar(0.5, 0.15, 0), kNear(0, 0.021, 0);
inline std::shared_ptr<const Snapshot> floorAndBlock(const Vec3& place = kFar) {
  std::vector<Instance> instances;
  instances.push_back(boxInstance(kFloor, Vec3(1, 0.05, 1), Vec3(0, -0.05, 0)));
  instances.push_back(boxInstance(kBlock, Vec3::Constant(kHalf_m), place));
  BodySpec spec;
  spec.mass_kg = 0.1;
  spec.shape = BodyShape::kBox;
  const Pose start{Mat3::Identity(), place};
  const Box scene{Vec3::Constant(-1), Vec3::Constant(1)};
  setBody(instances.back(), makeRigidBody("block", spec, start, instances.back().shape->bounds, roomAround(scene)));
  return makeSnapshot(std::move(instances), "table");
}
inline std::shared_ptr<const Snapshot> nothing() { return makeSnapshot(std::vector<Instance>{}, "nothing"); }

class SharedServer {
 public:
  SharedServer(std::unique_ptr<ShareLink> link, ServerId id, const std::string& name,
               std::shared_ptr<const Snapshot> scene, const TouchServerSettings& settings = settingsOf())
      : touch(std::move(scene), settings),
        bridge(std::move(link), "lab", {id, name, true, "test"}, touch, [this](const std::string& line) {
          const std::lock_guard lock(mutex_);
          reported_.push_back(line);
        }) {
    touch.start();
    bridge.start();
  }
  ~SharedServer() {
    bridge.stop();
    touch.stop();
  }
  /// A busy machine holds the servo up, which is a fault: then a person arms again.
  void keepOn() {
    ServoView servo;
    ProxyView proxy;
    touch.device().views(servo, proxy);
    if (servo.safety == SafetyState::kFault) touch.device().live().rearm();
  }
  std::shared_ptr<const Snapshot> scene() { return touch.device().snapshot(); }
  /// Of those that are not of this server's own scene: the widest first.
  std::optional<Instance> other(std::size_t number = 0) {
    std::vector<Instance> others;
    for (const Instance& instance : scene()->instances) {
      if (instance.session != 0) others.push_back(instance);
    }
    std::sort(others.begin(), others.end(),
              [](const Instance& a, const Instance& b) { return a.shape->bounds.max.x() > b.shape->bounds.max.x(); });
    return number < others.size() ? std::optional(others[number]) : std::nullopt;
  }
  Instance own(std::uint64_t key) {
    const auto now = scene();
    std::uint32_t number = 0;
    EXPECT_TRUE(now->find(key, number));
    return now->instances[number];
  }
  bool hasReported(const std::string& text) {
    const std::lock_guard lock(mutex_);
    return std::any_of(reported_.begin(), reported_.end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> reported_;

 public:
  TouchServer touch;
  ShareBridge bridge;
};

}  // namespace hl::test

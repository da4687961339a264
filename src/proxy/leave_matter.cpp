#include "proxy/leave_matter.h"

#include <algorithm>
#include <array>
#include <span>

#include "proxy/clear_place.h"
#include "proxy/tolerances.h"

namespace hl {

namespace {

Site siteOf(const SceneAt& scene, const Instance& instance, const Vec3& place) {
  return instance.shape->source->siteOf(instance.poses().at(scene.time_ns()).toObject(place));
}

/// The nearest places are tried first, on all the ways at once.
class WayOut {
 public:
  WayOut(const SceneAt& scene, const MatterObjects& within, double reach)
      : scene_(scene),
        within_(within),
        reach_(reach),
        step_(std::max(convergence::kSitePerReach * reach, 2 * scene.extent() / convergence::kMaxSites)) {}

  bool clear(const Vec3& place) {
    if (!open(place)) return false;
    ++queries_;
    return clearanceAt(scene_, place, reach_) >= reach_;
  }

  /// From now on places count that are not within what the proxy was within, too.
  void leave() { stays_within_ = false; }

  /// Unit vectors; `position` changes only if there is a way.
  bool find(std::span<const Vec3> ways, Vec3& position) {
    queries_ = 0;
    for (int i = 1; i <= convergence::kMaxSites; ++i) {
      for (const Vec3& way : ways) {
        const Vec3 place = position + i * step_ * way;
        if (queries_ == convergence::kMaxClearances) return false;
        if (stays_within_ && !staysWithin(place)) continue;
        if (!clear(place)) continue;
        position = place;
        return true;
      }
    }
    return false;
  }

 private:
  bool wasWithin(const Instance& instance) const {
    return std::find(within_.begin(), within_.end(), instance.key) != within_.end();
  }
  Site siteAt(const Instance& instance, const Vec3& place) const {
    scene_.countTest();
    return siteOf(scene_, instance, place);
  }
  bool open(const Vec3& place) const {
    const Snapshot& snapshot = scene_.snapshot();
    return std::none_of(snapshot.all_matter.begin(), snapshot.all_matter.end(), [&](std::uint32_t number) {
      const Instance& instance = snapshot.instances[number];
      if (wasWithin(instance)) return false;
      const Site site = siteAt(instance, place);
      return site == Site::kMatter || site == Site::kBoundary;
    });
  }
  bool staysWithin(const Vec3& place) const {
    const Snapshot& snapshot = scene_.snapshot();
    return std::all_of(snapshot.all_matter.begin(), snapshot.all_matter.end(), [&](std::uint32_t number) {
      const Instance& instance = snapshot.instances[number];
      return !wasWithin(instance) || siteAt(instance, place) == Site::kMatter;
    });
  }

  const SceneAt& scene_;
  const MatterObjects& within_;
  const double reach_, step_;
  int queries_ = 0;
  bool stays_within_ = true;
};

// To the neighbours of a cube among its 27.
std::array<Vec3, 26> allAround() {
  std::array<Vec3, 26> ways;
  std::size_t count = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) ways[count++] = Vec3(x, y, z).normalized();
      }
    }
  }
  return ways;
}

}  // namespace

void leaveMatter(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger) {
  const Snapshot& snapshot = scene.snapshot();
  if (state.snapshot == snapshot.number) return;
  const auto replaced = [&](const Instance& instance) { return instance.replaced_in > state.snapshot; };
  if (std::none_of(snapshot.instances.begin(), snapshot.instances.end(), replaced)) return;
  const Tolerances tolerance = Tolerances::of(settings.radius, scene.extent());
  WayOut out(scene, state.within, tolerance.reach);
  if (out.clear(state.position)) return;
  const Vec3 spring = state.position - finger;
  const double length = spring.norm();
  const std::array<Vec3, 1> along{length > tolerance.rest ? Vec3(spring / length) : Vec3::Zero()};
  const auto find = [&] {
    return (length > tolerance.rest && out.find(along, state.position)) || out.find(allAround(), state.position);
  };
  if (find() || state.within.empty()) return;
  out.leave();
  find();
}

void rememberMatter(ProxyState& state, const SceneAt& scene) {
  state.within.clear();
  for (const std::uint32_t number : scene.snapshot().matter) {
    const Instance& instance = scene.snapshot().instances[number];
    if (siteOf(scene, instance, state.position) == Site::kMatter) state.within.push(instance.key);
  }
}

}  // namespace hl

#include "tick/own_queries.h"

#include <algorithm>
#include <limits>

#include "scene/scene_at.h"

namespace hl::bench {

namespace {

class OwnNear final : public Peer {
 public:
  explicit OwnNear(const Snapshot& snapshot) : scene_(snapshot) {}
  Question question() const override { return Question::kNear; }
  double ask(const Probe& probe) override {
    double nearest = std::numeric_limits<double>::infinity();
    scene_.primitivesWithin(probe.centre, probe.near_m, [&](PrimitiveId, const ClosestPoint& found) {
      nearest = std::min(nearest, found.distance);
    });
    return nearest;
  }

 private:
  SceneAt scene_;
};

class OwnImpact final : public Peer {
 public:
  explicit OwnImpact(const Snapshot& snapshot) : scene_(snapshot) {}
  Question question() const override { return Question::kImpact; }
  double ask(const Probe& probe) override {
    SceneImpact hit;
    if (!scene_.firstImpact(probe.from, probe.motion, probe.radius_m, 0, hit)) {
      return std::numeric_limits<double>::infinity();
    }
    return hit.impact.t * probe.motion.norm();
  }

 private:
  SceneAt scene_;
};

}  // namespace

std::unique_ptr<Peer> makeOwnQuery(const Snapshot& snapshot, Question question) {
  if (question == Question::kNear) return std::make_unique<OwnNear>(snapshot);
  return std::make_unique<OwnImpact>(snapshot);
}

}  // namespace hl::bench

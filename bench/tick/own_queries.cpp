#include "tick/own_queries.h"

#include <algorithm>
#include <limits>

#include "scene/scene_at.h"

namespace hl::bench {

namespace {

class OwnQueries final : public Peer {
 public:
  explicit OwnQueries(const Snapshot& snapshot) : scene_(snapshot) {}
  std::span<const Question> questions() const override { return kOwnQuestions; }
  double ask(Question question, const Probe& probe) override {
    return question == Question::kImpact ? impact(probe) : near(probe);
  }

 private:
  double near(const Probe& probe) const {
    double nearest = std::numeric_limits<double>::infinity();
    scene_.primitivesWithin(probe.centre, probe.near_m, [&](PrimitiveId, const ClosestPoint& found) {
      nearest = std::min(nearest, found.distance);
    });
    return nearest;
  }

  double impact(const Probe& probe) const {
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

std::unique_ptr<Peer> makeOwnQueries(const Snapshot& snapshot) { return std::make_unique<OwnQueries>(snapshot); }

}  // namespace hl::bench

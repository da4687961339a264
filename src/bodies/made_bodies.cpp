#include "bodies/made_bodies.h"

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

#include "bodies/mesh_body.h"

namespace hl {

namespace {

struct Made {
  BodySpec spec;
  std::shared_ptr<const Body> body;
};

class MadeBodies {
 public:
  std::shared_ptr<const Body> find(const std::shared_ptr<const Shape>& shape, const BodySpec& spec) {
    const std::lock_guard lock(mutex_);
    const auto of_shape = made_.find(shape);
    if (of_shape == made_.end()) return nullptr;
    const auto& all = of_shape->second;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Made& one) { return one.spec == spec; });
    return found == all.end() ? nullptr : found->body;
  }

  void keep(const std::shared_ptr<const Shape>& shape, Made made) {
    const std::lock_guard lock(mutex_);
    std::erase_if(made_, [](const auto& one) { return one.first.expired(); });
    std::deque<Made>& all = made_[shape];
    all.push_back(std::move(made));
    if (all.size() > kMaxOfAShape) all.pop_front();
  }

 private:
  std::mutex mutex_;
  std::map<std::weak_ptr<const Shape>, std::deque<Made>, std::owner_less<>> made_;
};

// What bodies of the same shape and mass may have each for itself.
BodySpec atRest(BodySpec spec) {
  spec.fixed = false;
  spec.velocity_m_s = spec.spin_rad_s = Vec3::Zero();
  return spec;
}

}  // namespace

std::shared_ptr<const Body> madeBody(const std::shared_ptr<const Shape>& shape, const BodySpec& spec) {
  static MadeBodies bodies;
  const BodySpec of_rest = atRest(spec);
  if (auto known = bodies.find(shape, of_rest)) return known;
  auto body = std::make_shared<const Body>(bodyOf(shape->model, of_rest));
  bodies.keep(shape, {of_rest, body});
  return body;
}

}  // namespace hl

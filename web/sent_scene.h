// SentScene: what does not change of a scene, as numbers for the page, and where its objects are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hl_web.h"
#include "scene/snapshot.h"

namespace hl {

class SentScene {
 public:
  explicit SentScene(std::shared_ptr<const Snapshot> snapshot);

  const HlWebObject& object(int number) const { return objects_.at(static_cast<std::size_t>(number)); }
  const HlWebJoint& joint(int number) const { return joints_.at(static_cast<std::size_t>(number)); }
  const HlWebPlace& place(int number) const { return places_.at(static_cast<std::size_t>(number)); }
  const Model& model(int object) const;
  /// Three numbers for each point.
  const double* points(int place) const { return points_.at(static_cast<std::size_t>(place))->data()->data(); }
  const double* starts() const { return starts_.data(); }
  /// Until the next call.
  const double* posesAt(std::int64_t now_ns);
  std::size_t objects() const { return objects_.size(); }
  std::size_t joints() const { return joints_.size(); }

 private:
  void addObject(const Instance& instance);
  void addJoint(const JointSpec& joint);
  void addPlaces();

  std::shared_ptr<const Snapshot> snapshot_;
  std::vector<HlWebObject> objects_;
  std::vector<HlWebJoint> joints_;
  std::vector<HlWebPlace> places_;
  std::vector<const std::vector<Vec3>*> points_;
  std::vector<double> starts_, poses_;
};

}  // namespace hl

// SentScene: what does not change of a scene, as numbers for the page, and where its objects are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/rgb.h"
#include "hl_web.h"
#include "scene/snapshot.h"

namespace hl {

class SentScene {
 public:
  explicit SentScene(std::shared_ptr<const Snapshot> snapshot);

  /// The same objects, of which this one has another surface: nothing is drawn of it until draw().
  void replace(std::shared_ptr<const Snapshot> snapshot, std::size_t object);
  /// Of an object that is no mesh: makes about so many triangles of it, or fewer, for object(), model() and colours().
  void draw(int object, std::size_t triangles);
  const HlWebObject& object(int number) const { return objects_.at(static_cast<std::size_t>(number)); }
  const HlWebJoint& joint(int number) const { return joints_.at(static_cast<std::size_t>(number)); }
  const HlWebPlace& place(int number) const { return places_.at(static_cast<std::size_t>(number)); }
  const HlWebVolume& volume(int number) const { return volumes_.at(static_cast<std::size_t>(number)); }
  /// Empty: the scene calls it nothing.
  const char* name(int object) const;
  const Model& model(int object) const { return *drawn_.at(static_cast<std::size_t>(object)).model; }
  const std::vector<Rgb>& colours(int object) const { return drawn_.at(static_cast<std::size_t>(object)).colours; }
  /// Three numbers for each point.
  const double* points(int place) const { return points_.at(static_cast<std::size_t>(place))->data()->data(); }
  const double* starts() const { return starts_.data(); }
  /// Until the next call.
  const double* posesAt(std::int64_t now_ns);
  std::size_t objects() const { return objects_.size(); }
  std::size_t joints() const { return joints_.size(); }
  std::size_t volumes() const { return volumes_.size(); }

 private:
  struct Drawn {
    std::shared_ptr<const Model> model;
    std::vector<Rgb> colours;  // one a vertex, or none
  };
  void addObject(const Instance& instance);
  void describe(std::size_t object);
  void addJoint(const JointSpec& joint);
  void addPlaces();
  void addVolumes();

  std::shared_ptr<const Snapshot> snapshot_;
  std::vector<HlWebObject> objects_;
  std::vector<Drawn> drawn_;
  std::vector<HlWebVolume> volumes_;
  std::vector<HlWebJoint> joints_;
  std::vector<HlWebPlace> places_;
  std::vector<const std::vector<Vec3>*> points_;
  std::vector<double> starts_, poses_;
};

}  // namespace hl

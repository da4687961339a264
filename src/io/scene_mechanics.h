// Scene mechanics: what a scene file says of bodies and joints, and what makes no sense in it.
#pragma once

#include <hl.pb.h>

#include <functional>
#include <string>

#include "io/decode_scene.h"
#include "scene/scene_model.h"

namespace hl {

class SceneMechanics {
 public:
  /// Takes a line about the value at a path that has no effect, or hardly the one that is meant.
  using Warn = std::function<void(const std::string& where, const std::string& message)>;
  /// `decoder` says what is wrong, by throwing hl::Error; it must outlive this.
  SceneMechanics(const SceneDecoder& decoder, Warn warn) : decoder_(decoder), warn_(std::move(warn)) {}

  /// Of an object that has a body.
  BodySpec body(const proto::SceneObject& object, const std::string& where) const;
  /// In the units of the file. The bodies are those of the scene.
  void addJoints(const proto::Scene& in, SceneModel& scene) const;
  /// The last thing, as shapes and masses are those of the final size: all that a step asks of bodies and joints.
  void check(const proto::Scene& in, const SceneModel& scene) const;

 private:
  void checkBodies(const proto::Scene& in, const SceneModel& scene) const;
  void checkJoints(const proto::Scene& in, const SceneModel& scene) const;
  void warnOfNames(const proto::Scene& in) const;
  std::uint64_t bodyNamed(const std::string& name, const SceneModel& scene, const std::string& where) const;
  void requireOfKind(const proto::Joint& in, const JointSpec& joint, const std::string& where) const;
  void fail(const std::string& where, const std::string& message) const { decoder_.fail(where, message); }

  const SceneDecoder& decoder_;
  const Warn warn_;
};

}  // namespace hl

// Scenes between snapshots and the messages of a recording. Shapes, surfaces and bodies that several scenes share are
// written once. What comes back is touched bit for bit as it was.
#pragma once

#include <recording.pb.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "io/model_messages.h"
#include "io/surface_messages.h"
#include "scene/snapshot.h"

namespace hl {

/// One thread.
class SceneWriter {
 public:
  using Write = std::function<void(const proto::RecordingBlock& block)>;

  /// The blocks of `scene`: what of it has not been written before, then the scene itself.
  void write(const Snapshot& scene, const Write& write);
  /// Its blocks are elsewhere: scenes refer to it by the next number, as if it had been written now.
  void know(const std::shared_ptr<const Shape>& shape);
  void know(const std::shared_ptr<const Surfaces>& surfaces);
  /// Where the bodies of the scenes so far are, `now_ns`, of those that have moved since the last call: for showing
  /// them.
  void writePoses(std::int64_t now_ns, const Write& write);

 private:
  using PoseNumbers = std::array<float, 12>;
  struct SeenBody {
    std::int64_t time_ns = 0;  // when it was written
    PoseNumbers pose{};
  };
  template <typename Part>
  struct Written {
    std::weak_ptr<const Part> part;
    std::uint64_t id = 0;
  };
  template <typename Part, typename Encode>
  std::uint64_t idOf(std::map<const Part*, Written<Part>>& written, const std::shared_ptr<const Part>& part,
                     const Encode& encode);
  std::uint64_t shapeId(const std::shared_ptr<const Shape>& shape, const Write& write);
  std::uint64_t bodyId(const std::shared_ptr<const RigidBody>& body, const Write& write);

  std::map<const Shape*, Written<Shape>> shapes_;
  SurfaceWriter sources_;  // of shapes that are no meshes
  std::map<const Surfaces*, Written<Surfaces>> surfaces_;
  std::map<const RigidBody*, Written<RigidBody>> bodies_;
  std::uint64_t last_id_ = 0;
  std::map<std::uint64_t, SeenBody> seen_;  // by id
  std::int64_t last_look_ns_ = 0;
};

/// One thread. Everything throws hl::Error when the message makes no sense.
class SceneReader {
 public:
  void add(const proto::RecordedShape& in);
  void add(const proto::RecordedHeights& in);
  void add(const proto::RecordedVolume& in) { add(in.id(), sources_.add(in)); }
  void add(const proto::RecordedCloud& in) { add(in.id(), sources_.add(in)); }
  void add(const proto::RecordedImplicit& in) { add(in.id(), sources_.add(in)); }
  void add(const proto::RecordedSurfaces& in);
  void add(const proto::RecordedBody& in);
  /// Those that are here already.
  void add(std::uint64_t id, std::shared_ptr<const Shape> shape) { shapes_[id] = std::move(shape); }
  void add(std::uint64_t id, std::shared_ptr<const Surfaces> surfaces) { surfaces_[id] = std::move(surfaces); }
  std::shared_ptr<const Snapshot> scene(const proto::RecordedScene& in) const;

 private:
  MeshTransition wayOf(const proto::RecordedMeshTransition& in, const Surfaces& surfaces) const;
  std::shared_ptr<const MeshMotion> meshMotionOf(const proto::RecordedInstance& in, const Surfaces& surfaces) const;

  void setBody(std::uint64_t id, Instance& instance) const;

  /// Null: more of the surface follows.
  void add(std::uint64_t id, const SurfaceReader::Source& source, const Vec2& repeat = Vec2::Ones());

  MeshReader mesh_;
  SurfaceReader sources_;               // of shapes that are no meshes
  Vec2 repeat_ = Vec2::Ones();          // of the heights of which more parts follow
  std::optional<std::uint64_t> begun_;  // the mesh of which more parts follow
  std::map<std::uint64_t, std::shared_ptr<const Shape>> shapes_;
  std::map<std::uint64_t, std::shared_ptr<const Surfaces>> surfaces_;
  std::map<std::uint64_t, std::shared_ptr<const RigidBody>> bodies_;
};

}  // namespace hl

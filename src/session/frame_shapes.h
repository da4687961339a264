// FrameShapes: the shapes of a frame, of what is within it and of uploads that came before. What it takes to make one
// is counted before it is made.
#pragma once

#include <hl.pb.h>

#include <list>
#include <map>
#include <memory>
#include <string>

#include "io/decode_scene.h"
#include "session/frame_volumes.h"
#include "session/message_size.h"

namespace hl {

/// What a client has sent ahead of a frame, by the ids it chose, in the parts that it came in.
using Uploads = std::map<std::uint64_t, std::list<proto::Primitives>>;

/// Errors are hl::Error, and begin with `where`.
class FrameShapes {
 public:
  /// All must outlive it.
  FrameShapes(Uploads& uploads, const SceneDecoder& decoder, const SceneLimits& limits, const MemoryBudget& memory);

  /// Of an item. `before`: what it replaces; null: nothing.
  std::shared_ptr<const Shape> of(const proto::Primitives& in, const proto::Item& item, const Shape* before,
                                  const std::string& where);
  /// The parts of an upload that is used are one part afterwards.
  const proto::Primitives& upload(std::uint64_t id, const std::string& where);
  /// Vertices and normals for an item that is there.
  Model vertices(const proto::VertexUpdate& in, const std::string& where);
  std::shared_ptr<const Shape> surfaceAt(const Shape* before, const proto::IsoUpdate& in, const std::string& where) {
    return volumes_.surfaceAt(before, in, where);
  }

 private:
  template <typename Decode>
  std::shared_ptr<const Shape> ownSurface(std::uint64_t bytes, const std::string& where, const Decode& decode,
                                          const Vec2& repeat = Vec2::Ones());
  std::shared_ptr<const Shape> heightsOf(const proto::Primitives& in, const proto::Item& item, const Shape* before,
                                         const std::string& where);
  std::shared_ptr<const Shape> cloudOf(const proto::Primitives& in, const std::string& where);
  std::shared_ptr<const Shape> implicitSurfaceOf(const proto::Primitives& in, const std::string& where);

  Uploads& uploads_;
  const SceneDecoder& decoder_;
  const MemoryBudget& memory_;
  MemoryShare joined_;  // of uploads that came in parts
  ModelSizes size_;     // each item makes a shape of its own, even if all refer to one upload
  FrameVolumes volumes_;
};

}  // namespace hl

// A model in messages, for recordings and for the process that reads foreign files: a mesh in parts, so that none
// comes near protobuf's limit of 2 GB, and its appearance, textures and materials. What comes back is the same to
// the bit, or is refused.
#pragma once

#include <recording.pb.h>

#include <cstddef>
#include <functional>
#include <limits>

#include "scene/model.h"

namespace hl {

/// Calls `take` with each part of the mesh, at least one; all but the last say that more follow. Texture, material and
/// warnings apart.
void writeMesh(const Model& model, const std::function<void(proto::RecordedShape& part)>& take);

/// Puts a mesh together from its parts.
class MeshReader {
 public:
  /// `most_bytes`: memory that the mesh may take.
  explicit MeshReader(std::size_t most_bytes = std::numeric_limits<std::size_t>::max()) : left_(most_bytes) {}
  /// Throws hl::Error for a part that makes no sense, and before it takes memory for one too many.
  void add(const proto::RecordedShape& part);
  /// The whole mesh, with as many default materials as it had. Throws hl::Error unless lists agree, indices are in
  /// range, and normals and texture coordinates are numbers. Positions may be anything: what is not finite is skipped
  /// where primitives are made, with a count.
  Model take();

 private:
  Model model_;
  std::size_t left_;  // bytes
};

void toProto(const Texture& texture, proto::RecordedTexture& out);
/// Throws hl::Error, as what follows.
Texture textureOf(const proto::RecordedTexture& in);
void toProto(const Material& material, proto::Values& out);
/// `textures`: how many there are for it to use.
Material materialOf(const proto::Values& in, std::size_t textures);

}  // namespace hl

#include "session/frame_shapes.h"

#include <algorithm>

#include "base/error.h"
#include "io/decode_clouds.h"
#include "io/decode_heights.h"
#include "io/decode_implicit.h"
#include "io/decode_volumes.h"
#include "scene/append_part.h"
#include "session/upload_parts.h"

namespace hl {

namespace {

// What decoding it and building its shape takes.
std::uint64_t bytesToBuild(const proto::Primitives& in) {
  if (in.has_heights()) return bytesToMakeHeights(in.heights());
  if (in.has_volume()) return bytesToMakeVolume(in.volume());
  if (in.has_cloud()) return bytesToMakeCloud(in.cloud());
  if (in.has_implicit()) return bytesToMakeImplicit(in.implicit());
  return bytesToMake(countsOf(in));
}

void requireAlone(const proto::Primitives& in, const std::string& where) {
  if (in.vertices_size() + in.triangles_size() + in.polygons_size() + in.segments_size() + in.points_size() +
          in.patches_size() >
      0)
    throw Error(where + ": heights, volumes, clouds and implicit surfaces come without vertices and elements");
  if (in.has_heights() + in.has_volume() + in.has_cloud() + in.has_implicit() > 1)
    throw Error(where + ": it has heights, a volume, a cloud or an implicit surface, not several of them");
}

}  // namespace

FrameShapes::FrameShapes(Uploads& uploads, const SceneDecoder& decoder, const SceneLimits& limits,
                         const MemoryBudget& memory)
    : uploads_(uploads), decoder_(decoder), memory_(memory), joined_(memory), size_(limits), volumes_(memory, size_) {}

const proto::Primitives& FrameShapes::upload(std::uint64_t id, const std::string& where) {
  const auto found = uploads_.find(id);
  if (found == uploads_.end()) throw Error(where + ": there is no upload " + std::to_string(id));
  joinParts(found->second, joined_);
  return found->second.front();
}

Model FrameShapes::vertices(const proto::VertexUpdate& in, const std::string& where) {
  if (in.what_case() == proto::VertexUpdate::WHAT_NOT_SET) throw Error(where + " needs primitives or an upload");
  const proto::Primitives& primitives = in.has_upload() ? upload(in.upload(), where) : in.primitives();
  MemoryShare memory(memory_);
  memory.take(bytesToBuild(primitives));
  Model part = decoder_.model(primitives, where);
  const auto finite = [](const Vec3& v) { return v.allFinite(); };
  if (part.elements() != 0 || !part.texcoords.empty() || !part.appearance.empty())
    throw Error(where + " must hold vertices and normals alone");
  if (!std::all_of(part.positions.begin(), part.positions.end(), finite) ||
      !std::all_of(part.normals.begin(), part.normals.end(), finite))
    throw Error(where + " must hold finite numbers");
  return part;
}

std::shared_ptr<const Shape> FrameShapes::of(const proto::Primitives& in, const proto::Item& item, const Shape* before,
                                             const std::string& where) {
  if (in.has_heights() || in.has_volume() || in.has_cloud() || in.has_implicit()) requireAlone(in, where);
  if (in.has_volume()) return volumes_.surface(in.volume(), item, where + ".volume");
  if (item.has_iso() || item.has_below()) throw Error(where + ": iso and below are of volumes, and this is none");
  if (in.has_heights()) return heightsOf(in, item, before, where);
  if (in.has_cloud()) return cloudOf(in, where);
  if (in.has_implicit()) return implicitSurfaceOf(in, where);
  return makeCounted(memory_, bytesToBuild(in), [&] {
    Model model = decoder_.model(in, where);
    size_.add(model, where + ": ");
    repeatTexcoords(model, repeatOf(item.material()));
    return before != nullptr ? makeShape(std::move(model), *before) : makeShape(std::move(model));
  });
}

// Counted by its samples or points, as a mesh is by its elements. `bytes`: to make it.
template <typename Decode>
std::shared_ptr<const Shape> FrameShapes::ownSurface(std::uint64_t bytes, const std::string& where,
                                                     const Decode& decode, const Vec2& repeat) {
  size_.add(bytes, where + ": ");
  MemoryShare memory(memory_);
  memory.take(bytes);
  try {
    auto shape = makeShape(decode(), {}, {}, repeat);
    memory.set(shape->bytes() + shape->shared().bytes);
    return withShare(std::move(shape), std::move(memory));
  } catch (const Error& error) {
    throw Error(where + ": " + error.what());
  }
}

std::shared_ptr<const Shape> FrameShapes::heightsOf(const proto::Primitives& in, const proto::Item& item,
                                                    const Shape* before, const std::string& where) {
  const auto decode = [&] { return decodeHeights(in.heights(), before != nullptr ? before->source.get() : nullptr); };
  return ownSurface(bytesToMakeHeights(in.heights()), where + ".heights", decode, repeatOf(item.material()));
}

std::shared_ptr<const Shape> FrameShapes::cloudOf(const proto::Primitives& in, const std::string& where) {
  return ownSurface(bytesToMakeCloud(in.cloud()), where + ".cloud", [&] { return decodeCloud(in.cloud()); });
}

std::shared_ptr<const Shape> FrameShapes::implicitSurfaceOf(const proto::Primitives& in, const std::string& where) {
  return ownSurface(bytesToMakeImplicit(in.implicit()), where + ".implicit",
                    [&] { return decodeImplicit(in.implicit()); });
}

}  // namespace hl

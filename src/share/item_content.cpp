#include "share/item_content.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "bodies/made_bodies.h"
#include "share/share_messages.h"

namespace hl {

namespace {

using Block = proto::RecordingBlock;

// As the writer numbers them: a shape comes before its surfaces.
constexpr std::uint64_t kShapeId = 1, kSurfacesId = 2, kItemKey = 1;
// Bytes of a shape with its hierarchy, and of what is there while it is made, for one of its content: a mesh of packed
// numbers has about 25 a triangle there and 150 here.
constexpr std::uint64_t kMaxGrowth = 8;
constexpr const char* kBroken = "an object of a shared world makes no sense";

// Without what is of its place in this server's scene.
Instance bare(const Instance& in) {
  Instance out;
  out.shape = in.shape;
  out.surfaces = in.surfaces;
  out.key = kItemKey;
  out.name = in.name;
  out.snaps = in.snaps;
  out.fields = in.fields;
  out.label = in.label;
  if (!in.body) return out;
  BodySpec spec = in.body->spec;
  spec.velocity_m_s = spec.spin_rad_s = Vec3::Zero();
  setBody(out, makeRigidBody(in.body->name, spec, Pose{}, in.shape->bounds, roomAround(in.shape->bounds)));
  return out;
}

enum class Part : std::uint8_t { kShape, kSurfaces, kLook };

Part partOf(const Block& block) {
  switch (block.body_case()) {
    case Block::kShape:
    case Block::kHeights:
    case Block::kVolume:
    case Block::kImplicit:
    case Block::kCloud:
      return Part::kShape;
    case Block::kSurfaces:
      return Part::kSurfaces;
    default:
      return Part::kLook;
  }
}

std::string encodePart(SceneWriter& writer, const Instance& instance, Part part) {
  proto::ShareBlocks out;
  writer.write(*makeSnapshot({instance}, {}, 1, 0), [&](const Block& block) {
    if (partOf(block) != part) return;
    *out.add_blocks() = block;
    if (block.has_scene()) out.mutable_blocks()->rbegin()->mutable_scene()->clear_identity();
  });
  return out.SerializeAsString();
}

std::string encodeShape(const Instance& instance) {
  SceneWriter writer;
  Instance plain = bare(instance);
  plain.surfaces = surfacesOf(instance.shape);
  return encodePart(writer, plain, Part::kShape);
}

std::string encodeSurfaces(const Instance& instance) {
  SceneWriter writer;
  writer.know(instance.shape);
  Instance plain = bare(instance);
  plain.body = nullptr;
  plain.driver = nullptr;
  return encodePart(writer, plain, Part::kSurfaces);
}

std::string encodeLook(const Instance& instance) {
  SceneWriter writer;
  writer.know(instance.shape);
  writer.know(instance.surfaces);
  return encodePart(writer, bare(instance), Part::kLook);
}

void requireRoom(const char* what, std::size_t bytes, std::size_t most_bytes) {
  if (bytes > most_bytes)
    throw Error(std::string(what) + " of an object take " + std::to_string(bytes) + " bytes, and " +
                std::to_string(most_bytes) + " can be shared");
}

proto::ShareBlocks blocksOf(const std::string& bytes, Part part) {
  proto::ShareBlocks blocks;
  if (!blocks.ParseFromString(bytes)) throw Error(kBroken);
  for (const Block& block : blocks.blocks()) {
    if (partOf(block) != part) throw Error(kBroken);
  }
  return blocks;
}

void add(const Block& block, SceneReader& reader) {
  if (block.has_shape()) return reader.add(block.shape());
  if (block.has_heights()) return reader.add(block.heights());
  if (block.has_volume()) return reader.add(block.volume());
  if (block.has_implicit()) return reader.add(block.implicit());
  if (block.has_cloud()) return reader.add(block.cloud());
  if (block.has_surfaces()) return reader.add(block.surfaces());
  if (block.has_rigid_body()) return reader.add(block.rigid_body());
  throw Error(kBroken);
}

// What somebody has already, or else its blocks.
template <typename Made>
void give(std::uint64_t id, std::map<std::string, std::weak_ptr<const Made>>& made, const std::string& sha256,
          const std::string& bytes, Part part, SceneReader& reader) {
  std::erase_if(made, [](const auto& entry) { return entry.second.expired(); });
  const auto found = made.find(sha256);
  if (auto there = found == made.end() ? nullptr : found->second.lock()) return reader.add(id, std::move(there));
  const proto::ShareBlocks blocks = blocksOf(bytes, part);
  for (const Block& block : blocks.blocks()) add(block, reader);
}

}  // namespace

template <typename Part, typename Encode>
NamedContent ItemWriter::contentOf(KeptMap<Part>& kept, const std::shared_ptr<const Part>& part, const Encode& encode) {
  std::erase_if(kept, [](const auto& entry) { return entry.second.part.expired(); });
  const auto found = kept.find(part.get());
  if (found != kept.end()) return found->second.content;
  const auto bytes = std::make_shared<const std::string>(encode());
  const NamedContent content{nameOf(*bytes), bytes};
  kept[part.get()] = {part, content};
  return content;
}

WrittenItem ItemWriter::write(const Instance& instance, bool jointed) {
  const NamedContent shape = contentOf(shapes_, instance.shape, [&] { return encodeShape(instance); });
  const NamedContent surfaces = contentOf(surfaces_, instance.surfaces, [&] { return encodeSurfaces(instance); });
  requireRoom("the shape and surfaces", shape.name.bytes + surfaces.name.bytes, Contents::kMax_bytes);
  auto content = std::make_shared<proto::ShareContent>();
  toProto(shape.name, *content->mutable_shape());
  toProto(surfaces.name, *content->mutable_surfaces());
  content->set_look(encodeLook(instance));
  content->set_body(instance.movesAsBody());
  content->set_jointed(jointed);
  requireRoom("the snaps and fields", content->look().size(), kMaxLook_bytes);
  return {std::move(content), shape, surfaces};
}

Instance ItemReader::make(const proto::ShareContent& content, const std::string& shape, const std::string& surfaces) {
  SceneReader reader;
  give(kShapeId, shapes_, content.shape().sha256(), shape, Part::kShape, reader);
  give(kSurfacesId, surfaces_, content.surfaces().sha256(), surfaces, Part::kSurfaces, reader);
  const proto::ShareBlocks look = blocksOf(content.look(), Part::kLook);
  if (look.blocks_size() == 0 || !look.blocks().rbegin()->has_scene()) throw Error(kBroken);
  for (int i = 0; i + 1 < look.blocks_size(); ++i) add(look.blocks(i), reader);
  const auto scene = reader.scene(look.blocks().rbegin()->scene());
  if (scene->instances.size() != 1) throw Error(kBroken);
  Instance item = scene->instances.front();
  if (content.body() != item.movesAsBody() || item.mesh_motion) throw Error(kBroken);
  return item;
}

bool ItemReader::isHere(const proto::ShareContent& content) const {
  const auto is_in = [](const auto& made, const std::string& sha256) {
    const auto found = made.find(sha256);
    return found != made.end() && !found->second.expired();
  };
  return is_in(shapes_, content.shape().sha256()) && is_in(surfaces_, content.surfaces().sha256());
}

Instance ItemReader::read(const proto::ShareContent& content, const std::string& shape, const std::string& surfaces) {
  const bool is_new = !isHere(content);
  MemoryShare share(memory_);
  if (is_new) share.take(kMaxGrowth * (shape.size() + surfaces.size()));
  Instance item = make(content, shape, surfaces);
  if (is_new) {
    share.set(memoryOf(*makeSnapshot({item})));
    item.shape = withShare(item.shape, std::move(share));
    shapes_[content.shape().sha256()] = item.shape;
    surfaces_[content.surfaces().sha256()] = item.surfaces;
  }
  if (item.movesAsBody()) madeBody(item.shape, item.body->spec);
  return item;
}

}  // namespace hl

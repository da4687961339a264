#include "client/frame_messages.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "client/fault.h"
#include "client/vec_messages.h"

namespace hl::client {

namespace {

// A mesh from here on goes in parts: smaller ones are not worth their own message.
constexpr std::size_t kInlineBytes = std::size_t{256} << 10;
// One part, or so many of small meshes in one message, decode in about a millisecond.
constexpr std::size_t kPartBytes = std::size_t{1} << 20;
constexpr std::size_t kSamplesHeadBytes = 64;  // of a height field or volume, at most, beside its samples
constexpr std::size_t kPartHeadBytes = 32;     // of a part, at most, beside its numbers

constexpr std::uint64_t unlessZero(std::uint64_t limit) {
  return limit == 0 ? std::numeric_limits<std::uint64_t>::max() : limit;
}

template <typename Number, typename List>
void assign(google::protobuf::RepeatedField<Number>* out, const List& in) {
  *out = google::protobuf::RepeatedField<Number>(in.begin(), in.end());
}

void fillPrimitives(const Geometry& geometry, proto::Primitives& out) {
  if (geometry.heights) *out.mutable_heights() = *geometry.heights;
  if (geometry.cloud) *out.mutable_cloud() = *geometry.cloud;
  assign(out.mutable_vertices(), geometry.vertices.positions);
  assign(out.mutable_normals(), geometry.vertices.normals);
  assign(out.mutable_texcoords(), geometry.vertices.texcoords);
  assign(out.mutable_triangles(), geometry.triangles);
  assign(out.mutable_segments(), geometry.segments);
  assign(out.mutable_points(), geometry.points);
  out.mutable_patches()->Add(geometry.patches.begin(), geometry.patches.end());
  out.set_patch_error(geometry.patch_error);
}

proto::Quantity quantityOf(HLenum quantity) {
  proto::Quantity named = proto::HEIGHT;
  if (const auto number = numberOf(quantity)) proto::Quantity_Parse(kQuantityInfo[*number].name, &named);
  return named;
}

void fillMaterial(const Look& look, proto::Material& out) {
  for (std::size_t i = 0; i < kNumbers; ++i) {
    if (const auto& value = look.surface.quantities[i])
      out.GetReflection()->SetDouble(&out, out.GetDescriptor()->FindFieldByName(kQuantityInfo[i].field), *value);
  }
  if (look.surface.shade) out.set_shade(*look.surface.shade == HL_FLAT ? proto::FLAT : proto::SMOOTH);
  for (const TextureUse& use : look.textures) {
    proto::MaterialTexture& texture = *out.add_textures();
    texture.set_texture(std::to_string(use.texture));
    texture.set_quantity(quantityOf(use.quantity));
    texture.set_low(use.low);
    texture.set_high(use.high);
  }
}

void fillTexture(HLuint number, Texture&& texture, proto::TextureImage& out) {
  out.set_name(std::to_string(number));
  out.set_wrap(texture.wrap == HL_CLAMP ? proto::CLAMP : proto::REPEAT);
  out.set_filter(texture.filter == HL_NEAREST ? proto::NEAREST : proto::BILINEAR);
  proto::Texels& texels = *out.mutable_texels();
  texels.set_width(static_cast<std::uint32_t>(texture.width));
  texels.set_height(static_cast<std::uint32_t>(texture.height));
  texels.set_values(std::move(texture.texels));
}

void fillCompliance(HLuint object, const ObjectCompliance& compliance, proto::Compliance& out) {
  out.set_object(object);
  out.set_normal_m_n(compliance.normal_m_N);
  out.set_tangential_m_n(compliance.tangential_m_N);
  const auto& [x, y, z] = compliance.computed_for_N;
  setVec(*out.mutable_computed_for_n(), x, y, z);
}

// Turns one draft into messages, counting what goes into the frame itself and what goes ahead.
class Builder {
 public:
  explicit Builder(const FrameTerms& terms) : terms_(terms) {
    const std::uint64_t message = unlessZero(terms.limits.message_bytes());
    most_inline_ = message / 2;
    part_bytes_ = std::min<std::uint64_t>(kPartBytes, message / 2);
  }

  FrameMessages build(Draft&& draft) {
    proto::Frame& frame = *messages_.frame.mutable_frame();
    frame.set_number(terms_.number);
    if (draft.gravity_m_s2) {
      const auto& [x, y, z] = *draft.gravity_m_s2;
      setVec(*frame.mutable_gravity_m_s2(), x, y, z);
    }
    if (terms_.interval_s) frame.set_interval_s(*terms_.interval_s);
    for (auto& [number, texture] : draft.textures) fillTexture(number, std::move(texture), *frame.add_textures());
    for (const HLuint texture : draft.deleted_textures) frame.add_deleted_textures(std::to_string(texture));
    for (auto& [object, items] : draft.objects) {
      proto::ObjectDefinition& definition = *frame.add_objects();
      definition.set_id(object);
      if (items.body()) *definition.mutable_body() = *items.body();
      definition.mutable_snaps()->Add(items.snaps().begin(), items.snaps().end());
      definition.mutable_fields()->Add(items.fields().begin(), items.fields().end());
      for (Item& item : items.items()) fillItem(std::move(item), *definition.add_items());
    }
    for (VertexUpdate& update : draft.moved) fillUpdate(std::move(update), *frame.add_moved());
    for (const auto& [item, value] : draft.isos) {
      proto::IsoUpdate& iso = *frame.add_isos();
      iso.set_object(item.first);
      iso.set_item(item.second);
      iso.set_value(value);
    }
    for (const auto& [object, compliance] : draft.compliances)
      fillCompliance(object, compliance, *frame.add_compliances());
    for (const HLuint object : draft.deleted_objects) frame.add_deleted_objects(object);
    if (draft.world) {
      proto::World& world = *frame.mutable_world();
      for (Item& item : draft.world->items()) fillItem(std::move(item), *world.add_items());
      for (proto::WorldJoint& joint : draft.world->joints()) *world.add_joints() = std::move(joint);
    }
    requireWithinLimits();
    return std::move(messages_);
  }

 private:
  void fillItem(Item item, proto::Item& out) {
    if (item.matrix != Matrix4::Identity()) out.mutable_matrix()->Add(item.matrix.data(), item.matrix.data() + 16);
    proto::Material material;
    fillMaterial(item.look, material);
    if (item.geometry.repeat[0] != 1) material.set_repeat_u(item.geometry.repeat[0]);
    if (item.geometry.repeat[1] != 1) material.set_repeat_v(item.geometry.repeat[1]);
    if (material.ByteSizeLong() != 0) *out.mutable_material() = std::move(material);
    if (item.look.name != 0) out.set_name(item.look.name);
    out.set_untextured(item.look.untextured && item.look.textures.empty());
    if (item.call != 0) {
      out.set_call(item.call);
      return;
    }
    if (item.geometry.volume) {
      out.set_upload(uploadOf(item.geometry.volume));
      out.set_iso(item.geometry.iso);
      out.set_below(item.geometry.below);
      return;
    }
    if (item.geometry.implicit) {
      inline_bytes_ += item.geometry.implicit->ByteSizeLong();
      *out.mutable_primitives()->mutable_implicit() = *item.geometry.implicit;
      return;
    }
    fillGeometry(item.geometry, out);
  }

  void fillUpdate(VertexUpdate update, proto::VertexUpdate& out) {
    out.set_object(update.object);
    out.set_item(update.item);
    out.set_first(update.first);
    Geometry geometry;
    geometry.vertices = std::move(update.vertices);
    fillGeometry(geometry, out);
  }

  // In the frame, or ahead of it.
  template <typename Message>
  void fillGeometry(const Geometry& geometry, Message& out) {
    const std::size_t bytes = geometry.bytes();
    if (bytes > kInlineBytes || inline_bytes_ + bytes > most_inline_) {
      out.set_upload(upload(geometry));
      return;
    }
    inline_bytes_ += bytes;
    fillPrimitives(geometry, *out.mutable_primitives());
  }

  std::uint64_t upload(const Geometry& geometry) {
    upload_ = terms_.next_upload++;
    if (geometry.heights) addSamples(*geometry.heights, &proto::Primitives::mutable_heights);
    if (geometry.cloud) addPoints(*geometry.cloud);
    addParts(geometry.vertices.positions, &proto::Primitives::mutable_vertices);
    addParts(geometry.vertices.normals, &proto::Primitives::mutable_normals);
    addParts(geometry.vertices.texcoords, &proto::Primitives::mutable_texcoords);
    addParts(geometry.triangles, &proto::Primitives::mutable_triangles);
    addParts(geometry.segments, &proto::Primitives::mutable_segments);
    addParts(geometry.points, &proto::Primitives::mutable_points);
    for (const proto::Patch& patch : geometry.patches) addPatch(patch, geometry.patch_error);
    return upload_;
  }

  // Cut where a vertex or a primitive ends, whether it has one, two or three numbers.
  template <typename List, typename Mutable>
  void addParts(const List& numbers, Mutable mutable_list) {
    const std::size_t step = std::max<std::size_t>(part_bytes_ / sizeof(double) / 6, 1) * 6;
    for (std::size_t first = 0; first < numbers.size(); first += step) {
      const auto* begin = numbers.data() + first;
      const auto* end = begin + std::min(step, numbers.size() - first);
      proto::Upload& part = addPart((end - begin) * sizeof(*begin));
      part.set_id(upload_);
      (part.mutable_part()->*mutable_list)()->Add(begin, end);
      upload_bytes_ += part.ByteSizeLong();
    }
  }

  // A patch is never cut.
  void addPatch(const proto::Patch& patch, double error_m) {
    const std::size_t bytes = patch.ByteSizeLong();
    if (bytes + kPartHeadBytes > unlessZero(terms_.limits.message_bytes()))
      throw Fault(HL_OUT_OF_MEMORY, "a patch has more control points than the server takes in a message");
    proto::Upload& part = addPart(bytes);
    part.set_id(upload_);
    part.mutable_part()->set_patch_error(error_m);
    *part.mutable_part()->add_patches() = patch;
    upload_bytes_ += part.ByteSizeLong();
  }

  // Once for all surfaces of a volume.
  std::uint64_t uploadOf(const std::shared_ptr<const proto::Volume>& volume) {
    const auto [place, fresh] = volumes_.try_emplace(volume);
    if (fresh) {
      place->second = upload_ = terms_.next_upload++;
      addSamples(*volume, &proto::Primitives::mutable_volume);
    }
    return place->second;
  }

  // The first part has all but the samples; their pieces are put together by the server.
  template <typename Grid>
  void addSamples(const Grid& grid, Grid* (proto::Primitives::*mutable_grid)()) {
    Grid head;
    head.CopyFrom(grid);
    head.clear_samples();
    const std::string_view samples = grid.samples(0);
    for (std::size_t first = 0; first < samples.size(); first += part_bytes_) {
      const std::string_view piece = samples.substr(first, part_bytes_);
      proto::Upload& part = addPart(piece.size() + kSamplesHeadBytes);
      part.set_id(upload_);
      Grid& out = *(part.mutable_part()->*mutable_grid)();
      if (first == 0) out = head;
      out.add_samples(piece.data(), piece.size());
      upload_bytes_ += part.ByteSizeLong();
    }
  }

  // As addSamples().
  void addPoints(const proto::Cloud& cloud) {
    constexpr int kNumbersOfPoint = 3;
    constexpr std::size_t kBytesOfColour = 2;
    const std::size_t point_bytes = kNumbersOfPoint * (sizeof(double) + sizeof(float) + kBytesOfColour);
    const int step = kNumbersOfPoint * static_cast<int>(std::max<std::size_t>(part_bytes_ / point_bytes, 1));
    for (int first = 0; first < cloud.positions_size(); first += step) {
      const int end = std::min(first + step, cloud.positions_size());
      proto::Upload& part =
          addPart(static_cast<std::size_t>(end - first) * point_bytes / kNumbersOfPoint + kSamplesHeadBytes);
      part.set_id(upload_);
      proto::Cloud& out = *part.mutable_part()->mutable_cloud();
      out.set_surfels(cloud.surfels());
      out.set_reach(cloud.reach());
      out.mutable_positions()->Add(cloud.positions().begin() + first, cloud.positions().begin() + end);
      if (cloud.normals_size() > 0)
        out.mutable_normals()->Add(cloud.normals().begin() + first, cloud.normals().begin() + end);
      if (cloud.colours_size() > 0)
        out.mutable_colours()->Add(cloud.colours().begin() + first, cloud.colours().begin() + end);
      upload_bytes_ += part.ByteSizeLong();
    }
  }

  // Thousands of small meshes are not worth thousands of messages.
  proto::Upload& addPart(std::size_t bytes) {
    bytes += kPartHeadBytes;
    if (messages_.uploads.empty() || message_bytes_ + bytes > part_bytes_) {
      messages_.uploads.emplace_back();
      message_bytes_ = 0;
    }
    message_bytes_ += bytes;
    return *messages_.uploads.back().mutable_uploads()->add_parts();
  }

  void requireWithinLimits() const {
    const std::uint64_t bytes = messages_.frame.ByteSizeLong();
    if (bytes > unlessZero(terms_.limits.message_bytes()))
      throw Fault(HL_OUT_OF_MEMORY, "the frame has " + std::to_string(bytes) + " bytes, the server takes at most " +
                                        std::to_string(terms_.limits.message_bytes()) + "; it is dropped");
    if (upload_bytes_ > unlessZero(terms_.limits.upload_bytes()))
      throw Fault(HL_OUT_OF_MEMORY, "the frame's meshes have " + std::to_string(upload_bytes_) +
                                        " bytes, the server takes at most " +
                                        std::to_string(terms_.limits.upload_bytes()) + "; the frame is dropped");
  }

  const FrameTerms& terms_;
  FrameMessages messages_;
  std::map<std::shared_ptr<const proto::Volume>, std::uint64_t> volumes_;  // and the numbers of their uploads
  std::uint64_t most_inline_, part_bytes_;
  std::uint64_t inline_bytes_ = 0, upload_bytes_ = 0, upload_ = 0;
  std::uint64_t message_bytes_ = 0;  // of the last of the uploads, at most
};

}  // namespace

FrameMessages buildMessages(Draft draft, const FrameTerms& terms) { return Builder(terms).build(std::move(draft)); }

}  // namespace hl::client

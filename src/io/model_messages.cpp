#include "io/model_messages.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/utf8.h"
#include "io/value_messages.h"

namespace hl {

namespace {

constexpr const char* kBrokenMesh = "a mesh makes no sense: its lists do not agree";
// Of each list: a part of a shaded and textured mesh is 20 MB.
constexpr std::size_t kItemsInPart = std::size_t{1} << 18;
constexpr std::size_t kMaxNumberedMaterials = 0xffff;

// Lists of vectors and of indices lie in memory as they lie in the message. Adds the items of `part`, counted in parts.
template <typename Number, typename Item>
void addPart(const std::vector<Item>& items, std::size_t part, google::protobuf::RepeatedField<Number>& out) {
  const std::size_t begin = std::min(part * kItemsInPart, items.size());
  const std::size_t end = std::min(begin + kItemsInPart, items.size());
  if constexpr (std::is_arithmetic_v<Item>) {
    out.Add(items.begin() + static_cast<std::ptrdiff_t>(begin), items.begin() + static_cast<std::ptrdiff_t>(end));
  } else {
    constexpr std::size_t kEach = sizeof(Item) / sizeof(Number);
    const auto* const first = reinterpret_cast<const Number*>(items.data());
    out.Add(first + kEach * begin, first + kEach * end);
  }
}

template <typename Item, typename Number>
void append(const google::protobuf::RepeatedField<Number>& in, std::vector<Item>& items) {
  // NOLINTNEXTLINE(bugprone-sizeof-expression): an item may be one number
  constexpr std::size_t kEach = sizeof(Item) / sizeof(Number);
  const auto count = static_cast<std::size_t>(in.size());
  if (count % kEach != 0) throw Error(kBrokenMesh);
  const std::size_t before = items.size();
  items.resize(before + count / kEach);
  if (count > 0) std::copy_n(in.data(), count, reinterpret_cast<Number*>(items.data() + before));
}

void appendNumbers(const google::protobuf::RepeatedField<std::uint32_t>& in, std::vector<std::uint16_t>& numbers) {
  for (const std::uint32_t number : in) {
    if (number > kMaxNumberedMaterials) throw Error(kBrokenMesh);
    numbers.push_back(static_cast<std::uint16_t>(number));
  }
}

template <typename Vector>
bool finite(const std::vector<Vector>& list) {
  return std::all_of(list.begin(), list.end(), [](const Vector& v) { return v.allFinite(); });
}

bool inRange(const Model& model) {
  const auto good = [&](std::uint32_t index) { return index < model.positions.size(); };
  const auto all_good = [&](const auto& element) { return std::all_of(element.begin(), element.end(), good); };
  return std::all_of(model.triangles.begin(), model.triangles.end(), all_good) &&
         std::all_of(model.segments.begin(), model.segments.end(), all_good) &&
         std::all_of(model.points.begin(), model.points.end(), good);
}

bool listsAgree(const Model& model) {
  const std::size_t n = model.positions.size();
  return n <= std::numeric_limits<std::uint32_t>::max() && (model.normals.empty() || model.normals.size() == n) &&
         (model.texcoords.empty() || model.texcoords.size() == n) &&
         model.triangle_materials.size() <= model.triangles.size() &&
         model.segment_materials.size() <= model.segments.size() && model.point_materials.size() <= model.points.size();
}

// An appearance is small but for its lists; pictures go one with each part.
void addAppearance(const Appearance& appearance, std::size_t part, proto::RecordedShape& out) {
  const auto& colours = appearance.vertex_colours;
  const std::size_t begin = std::min(part * kItemsInPart, colours.size());
  const std::size_t count = std::min(kItemsInPart, colours.size() - begin);
  if (count > 0) out.set_vertex_colours(colours[begin].data(), count * sizeof(Rgb));
  addPart(appearance.triangle_paints, part, *out.mutable_triangle_paints());
  if (part < appearance.pictures.size()) {
    proto::RecordedPicture& picture = *out.add_pictures();
    picture.set_file(*appearance.pictures[part].file);
    picture.set_clamp(appearance.pictures[part].wrap == Wrap::kClamp);
  }
  if (part > 0) return;
  for (const Paint& paint : appearance.paints) {
    proto::RecordedPaint& each = *out.add_paints();
    each.set_colour(packRgb(paint.colour));
    if (paint.picture) each.set_picture(*paint.picture);
  }
}

void appendAppearance(const proto::RecordedShape& part, Appearance& appearance) {
  const std::string& colours = part.vertex_colours();
  if (colours.size() % sizeof(Rgb) != 0) throw Error(kBrokenMesh);
  for (std::size_t i = 0; i < colours.size(); i += sizeof(Rgb)) {
    const auto channel = [&](std::size_t n) { return static_cast<std::uint8_t>(colours[i + n]); };
    appearance.vertex_colours.push_back({channel(0), channel(1), channel(2)});
  }
  appendNumbers(part.triangle_paints(), appearance.triangle_paints);
  for (const proto::RecordedPicture& picture : part.pictures())
    appearance.pictures.push_back(
        {std::make_shared<const std::string>(picture.file()), picture.clamp() ? Wrap::kClamp : Wrap::kRepeat});
  for (const proto::RecordedPaint& paint : part.paints())
    appearance.paints.push_back(
        {unpackRgb(paint.colour()), paint.has_picture() ? std::optional(paint.picture()) : std::nullopt});
}

std::size_t bytesOfAppearance(const proto::RecordedShape& part) {
  std::size_t bytes = part.vertex_colours().size() +
                      static_cast<std::size_t>(part.triangle_paints_size()) * sizeof(std::uint16_t) +
                      static_cast<std::size_t>(part.paints_size()) * sizeof(Paint);
  for (const proto::RecordedPicture& picture : part.pictures()) bytes += sizeof(Picture) + picture.file().size();
  return bytes;
}

template <typename Number>
std::size_t bytesOf(const google::protobuf::RepeatedField<Number>& list) {
  return static_cast<std::size_t>(list.size()) * sizeof(Number);
}

std::size_t bytesOf(const proto::RecordedShape& part) {
  return bytesOf(part.positions()) + bytesOf(part.normals()) + bytesOf(part.texcoords()) + bytesOf(part.triangles()) +
         bytesOf(part.segments()) + bytesOf(part.points()) + bytesOf(part.triangle_materials()) +
         bytesOf(part.segment_materials()) + bytesOf(part.point_materials()) + bytesOfAppearance(part);
}

std::size_t longestList(const Model& model) {
  return std::max({model.positions.size(), model.normals.size(), model.texcoords.size(), model.triangles.size(),
                   model.segments.size(), model.points.size(), model.triangle_materials.size(),
                   model.segment_materials.size(), model.point_materials.size(),
                   model.appearance.triangle_paints.size(), model.appearance.vertex_colours.size()});
}

}  // namespace

void writeMesh(const Model& model, const std::function<void(proto::RecordedShape& part)>& take) {
  const std::size_t parts = std::max(
      {std::size_t{1}, (longestList(model) + kItemsInPart - 1) / kItemsInPart, model.appearance.pictures.size()});
  proto::RecordedShape out;
  for (std::size_t i = 0; i < parts; ++i) {
    out.Clear();
    out.set_name(validUtf8(model.name));
    out.set_materials(static_cast<std::uint32_t>(model.materials.size()));
    out.set_continues(i + 1 < parts);
    addPart(model.positions, i, *out.mutable_positions());
    addPart(model.normals, i, *out.mutable_normals());
    addPart(model.texcoords, i, *out.mutable_texcoords());
    addPart(model.triangles, i, *out.mutable_triangles());
    addPart(model.segments, i, *out.mutable_segments());
    addPart(model.points, i, *out.mutable_points());
    addPart(model.triangle_materials, i, *out.mutable_triangle_materials());
    addPart(model.segment_materials, i, *out.mutable_segment_materials());
    addPart(model.point_materials, i, *out.mutable_point_materials());
    addAppearance(model.appearance, i, out);
    take(out);
  }
}

void MeshReader::add(const proto::RecordedShape& part) {
  if (part.materials() < 1 || part.materials() > kMaxNumberedMaterials) throw Error(kBrokenMesh);
  const std::size_t bytes = bytesOf(part);
  if (bytes > left_) throw Error("a mesh is too large");
  left_ -= bytes;
  model_.name = part.name();
  model_.materials.resize(part.materials());
  append(part.positions(), model_.positions);
  append(part.normals(), model_.normals);
  append(part.texcoords(), model_.texcoords);
  append(part.triangles(), model_.triangles);
  append(part.segments(), model_.segments);
  append(part.points(), model_.points);
  appendNumbers(part.triangle_materials(), model_.triangle_materials);
  appendNumbers(part.segment_materials(), model_.segment_materials);
  appendNumbers(part.point_materials(), model_.point_materials);
  appendAppearance(part, model_.appearance);
}

Model MeshReader::take() {
  if (!listsAgree(model_)) throw Error(kBrokenMesh);
  if (!model_.appearance.fits(model_.triangles.size(), model_.positions.size())) throw Error(kBrokenMesh);
  if (!inRange(model_)) throw Error("a mesh makes no sense: it has elements with vertices that do not exist");
  if (!finite(model_.normals) || !finite(model_.texcoords))
    throw Error("a mesh makes no sense: a normal or texture coordinate is no number");
  return std::exchange(model_, {});
}

void toProto(const Texture& texture, proto::RecordedTexture& out) {
  out.set_name(validUtf8(texture.name));
  out.set_width(static_cast<std::uint32_t>(texture.width));
  out.set_height(static_cast<std::uint32_t>(texture.height));
  out.mutable_texels()->Add(texture.texels.begin(), texture.texels.end());
  out.set_wrap(static_cast<std::uint32_t>(texture.wrap));
  out.set_filter(static_cast<std::uint32_t>(texture.filter));
}

Texture textureOf(const proto::RecordedTexture& in) {
  Texture texture;
  texture.name = in.name();
  texture.width = in.width();
  texture.height = in.height();
  texture.texels = {in.texels().begin(), in.texels().end()};
  texture.wrap = static_cast<Wrap>(in.wrap() & 1);
  texture.filter = static_cast<Filter>(in.filter() & 1);
  checkTexture(texture);
  return texture;
}

void toProto(const Material& material, proto::Values& out) { toProto(valuesOf(material), out); }

Material materialOf(const proto::Values& in, std::size_t textures) {
  Material material;
  readValues(in, "a material", material, laterOfMaterial());
  checkRecorded(material);
  for (const TextureUse& use : material.textures) {
    if (use.used() && use.texture >= textures) throw Error("a material makes no sense: it has no such texture");
  }
  return material;
}

}  // namespace hl

#include "io/model_messages.h"

#include <algorithm>
#include <limits>
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

void appendMaterials(const google::protobuf::RepeatedField<std::uint32_t>& in, std::vector<std::uint16_t>& numbers) {
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

template <typename Number>
std::size_t bytesOf(const google::protobuf::RepeatedField<Number>& list) {
  return static_cast<std::size_t>(list.size()) * sizeof(Number);
}

std::size_t bytesOf(const proto::RecordedShape& part) {
  return bytesOf(part.positions()) + bytesOf(part.normals()) + bytesOf(part.texcoords()) + bytesOf(part.triangles()) +
         bytesOf(part.segments()) + bytesOf(part.points()) + bytesOf(part.triangle_materials()) +
         bytesOf(part.segment_materials()) + bytesOf(part.point_materials());
}

std::size_t longestList(const Model& model) {
  return std::max({model.positions.size(), model.normals.size(), model.texcoords.size(), model.triangles.size(),
                   model.segments.size(), model.points.size(), model.triangle_materials.size(),
                   model.segment_materials.size(), model.point_materials.size()});
}

}  // namespace

void writeMesh(const Model& model, const std::function<void(proto::RecordedShape& part)>& take) {
  const std::size_t parts = std::max<std::size_t>(1, (longestList(model) + kItemsInPart - 1) / kItemsInPart);
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
  appendMaterials(part.triangle_materials(), model_.triangle_materials);
  appendMaterials(part.segment_materials(), model_.segment_materials);
  appendMaterials(part.point_materials(), model_.point_materials);
}

Model MeshReader::take() {
  if (!listsAgree(model_)) throw Error(kBrokenMesh);
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

#include "io/check_gltf.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "io/gltf_item.h"
#include "io/text_words.h"

namespace hl {

namespace {

namespace json = boost::json;

// What these change is not felt, or is read.
constexpr std::array<std::string_view, 12> kKnown{
    "KHR_technique", "KHR_materials_",        "KHR_texture_",
    "KHR_lights_",   "EXT_lights_",           "EXT_texture_",
    "KHR_xmp",       "KHR_node_visibility",   "KHR_draco_mesh_compression",
    "MPEG_",         "KHR_mesh_quantization", "KHR_physics_rigid_bodies"};

bool isKnown(std::string_view extension) {
  return extension == "KHR_implicit_shapes" || std::any_of(kKnown.begin(), kKnown.end(), [&](std::string_view begin) {
           return extension.starts_with(begin);
         });
}

bool isIn(const json::value& file, std::string_view list, std::string_view name) {
  const json::value* const names = file.is_object() ? file.as_object().if_contains(list) : nullptr;
  const json::array* const array = names == nullptr ? nullptr : names->if_array();
  return array != nullptr && std::find(array->begin(), array->end(), json::value(name)) != array->end();
}

// Children of each node.
using Children = std::vector<std::vector<std::size_t>>;

// Walks without recursion, as a chain of nodes may be as long as the file.
void checkTree(const Children& children) {
  constexpr std::size_t kDeepest = 1000, kMostShown = 1'000'000;
  std::vector<std::size_t> height(children.size(), 0);  // nodes below and itself; 0: not known
  std::vector<std::size_t> shown(children.size(), 1);   // with those below, as often as they are there
  std::vector<bool> open(children.size(), false);
  const auto refuse = [](std::size_t node, const char* why) { throw Error(fmt::format("nodes/{}: {}", node, why)); };
  for (std::size_t root = 0; root < children.size(); ++root) {
    std::vector<std::pair<std::size_t, std::size_t>> path;  // node, and which of its children is next
    if (height[root] == 0) path.emplace_back(root, 0);
    while (!path.empty()) {
      auto& [node, next] = path.back();
      open[node] = true;
      if (next < children[node].size()) {
        const std::size_t child = children[node][next++];
        if (open[child]) refuse(child, "is below itself");
        if (height[child] == 0) path.emplace_back(child, 0);
        continue;
      }
      std::size_t most = 0;
      for (const std::size_t child : children[node]) {
        most = std::max(most, height[child]);
        shown[node] += shown[child];
        if (shown[node] > kMostShown) refuse(node, "the nodes below it are there more than a million times");
      }
      if (most >= kDeepest) refuse(node, "the nodes below it are nested too deep");
      height[node] = most + 1;
      open[node] = false;
      path.pop_back();
    }
  }
}

class MeshCheck {
 public:
  MeshCheck(const json::value& file, const GltfAccessors& accessors, std::vector<std::string>& warnings)
      : accessors_(accessors),
        warnings_(warnings),
        quantised_(isIn(file, "extensionsUsed", "KHR_mesh_quantization") ||
                   isIn(file, "extensionsRequired", "KHR_mesh_quantization")) {}

  void check(const GltfItem& primitive, std::size_t materials) {
    primitive.reference("material", "materials", materials);
    const std::uint64_t mode = primitive.whole("mode").value_or(kTriangles);
    if (mode > kLastMode) primitive.refuse(fmt::format("its mode is {}, and there are 0 to {}", mode, kLastMode));
    const std::optional<GltfItem> attributes = primitive.child("attributes");
    if (!attributes) primitive.refuse("has no attributes");
    for (const auto& member : attributes->object()) attributes->reference(member.key(), "accessors", accessors_.size());
    const std::optional<GltfItem> extensions = primitive.child("extensions");
    const bool packed = extensions && isPackedGltf(primitive.object());
    const auto position = attributes->reference("POSITION", "accessors", accessors_.size());
    const auto indices = primitive.reference("indices", "accessors", accessors_.size());
    if (!position) {
      warnings_.push_back(primitive.place() + ": has no POSITION and is left out");
      return;
    }
    const GltfAccessor& positions = accessors_[*position];
    checkPositions(*attributes, positions, packed);
    if (indices && !packed) checkIndices(primitive, *indices, positions.count);
    checkCount(primitive, mode, indices ? accessors_[*indices].count : positions.count);
    for (const char* name : {"NORMAL", "TEXCOORD_0", "COLOR_0"}) compareCount(*attributes, name, positions.count);
  }

 private:
  static constexpr std::uint64_t kTriangles = 4, kLastMode = 6;

  void checkPositions(const GltfItem& attributes, const GltfAccessor& positions, bool packed) const {
    if (positions.type != "VEC3") attributes.refuse("the accessor of its POSITION is no VEC3");
    const bool whole = positions.kind != ScalarKind::kFloat && positions.kind != ScalarKind::kUint32;
    if (positions.kind != ScalarKind::kFloat && !(quantised_ && whole))
      attributes.refuse("the accessor of its POSITION has no numbers of the type float (5126)");
    if (!packed && !positions.run && !positions.sparse)
      attributes.refuse("the accessor of its POSITION has no bufferView");
  }

  void checkIndices(const GltfItem& primitive, std::size_t number, std::size_t vertices) const {
    const GltfAccessor& indices = accessors_[number];
    const bool whole = indices.kind == ScalarKind::kUint8 || indices.kind == ScalarKind::kUint16 ||
                       indices.kind == ScalarKind::kUint32;
    if (indices.type != "SCALAR" || !whole)
      primitive.refuse("the accessor of its indices has no whole numbers from 0 on");
    if (!indices.run && !indices.sparse) primitive.refuse("the accessor of its indices has no bufferView");
    if (const auto place = accessors_.firstFrom(number, vertices))
      primitive.refuse(fmt::format("its index {} is {}, and there are {} vertices, from 0", *place,
                                   accessors_.wholeAt(number, *place), vertices));
  }

  // The reader counts below 0 where there are too few.
  void checkCount(const GltfItem& primitive, std::uint64_t mode, std::size_t count) {
    constexpr std::array<std::size_t, kLastMode + 1> kLeast{1, 2, 2, 2, 3, 3, 3};
    if (count < kLeast[mode])
      primitive.refuse(fmt::format("has {} vertices, and its mode {} needs {}", count, mode, kLeast[mode]));
    const std::size_t each = mode == kTriangles ? 3 : mode == 1 ? 2 : 1;
    if (count % each != 0)
      warnings_.push_back(fmt::format("{}: the last {} of its {} vertices are left out, as its elements have {}",
                                      primitive.place(), count % each, count, each));
  }

  void compareCount(const GltfItem& attributes, const char* name, std::size_t vertices) {
    const auto number = attributes.reference(name, "accessors", accessors_.size());
    if (number && accessors_[*number].count != vertices)
      warnings_.push_back(fmt::format("{}: its {} has {} elements for {} vertices and is left out", attributes.place(),
                                      name, accessors_[*number].count, vertices));
  }

  const GltfAccessors& accessors_;
  std::vector<std::string>& warnings_;
  const bool quantised_;
};

}  // namespace

bool isPackedGltf(const json::object& primitive) {
  const json::value* const extensions = primitive.if_contains("extensions");
  return extensions != nullptr && extensions->is_object() &&
         extensions->as_object().contains("KHR_draco_mesh_compression");
}

void checkGltfExtensions(const json::value& file) {
  const json::value* const required = file.is_object() ? file.as_object().if_contains("extensionsRequired") : nullptr;
  const json::array* const names = required == nullptr ? nullptr : required->if_array();
  if (names == nullptr) return;
  for (const json::value& name : *names) {
    if (name.is_string() && !isKnown(std::string_view(name.as_string())))
      throw Error(fmt::format("needs the extension {}, which is not read: save it without",
                              shown(std::string(name.as_string()))));
  }
}

void checkGltfNodes(const json::value& file) {
  const GltfItem root(file, "");
  const std::vector<GltfItem> nodes = root.list("nodes"), scenes = root.list("scenes");
  const std::size_t meshes = root.list("meshes").size(), skins = root.list("skins").size();
  Children children;
  for (const GltfItem& node : nodes) {
    node.reference("mesh", "meshes", meshes);
    node.reference("skin", "skins", skins);
    children.push_back(node.references("children", "nodes", nodes.size()));
    node.numbers("matrix", 16);
    node.numbers("translation", 3);
    node.numbers("scale", 3);
    const std::vector<double> rotation = node.numbers("rotation", 4);
    if (!rotation.empty() && std::all_of(rotation.begin(), rotation.end(), [](double x) { return x == 0; }))
      node.refuse("its rotation is 0 0 0 0, which is none");
    const double squares = std::inner_product(rotation.begin(), rotation.end(), rotation.begin(), 0.0);
    if (!rotation.empty() && !std::isnormal(squares)) node.refuse("its rotation is too small or too large to be one");
  }
  checkTree(children);
  root.reference("scene", "scenes", scenes.size());
  for (const GltfItem& scene : scenes) scene.references("nodes", "nodes", nodes.size());
}

void checkGltfMeshes(const json::value& file, const GltfAccessors& accessors, std::vector<std::string>& warnings) {
  const GltfItem root(file, "");
  const std::size_t materials = root.list("materials").size();
  MeshCheck meshes(file, accessors, warnings);
  for (const GltfItem& mesh : root.list("meshes")) {
    for (const GltfItem& primitive : mesh.list("primitives")) meshes.check(primitive, materials);
  }
}

}  // namespace hl

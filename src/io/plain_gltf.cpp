#include "io/plain_gltf.h"

#include <fmt/core.h>

#include <algorithm>
#include <boost/json.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>

#include "base/error.h"
#include "io/base64.h"
#include "io/check_gltf.h"
#include "io/gltf_accessors.h"
#include "io/gltf_file.h"
#include "io/gltf_item.h"

namespace hl {

namespace json = boost::json;

namespace {

constexpr std::int64_t kFloat = 5126;

// What HL reads of a primitive in numbers that may be integers.
bool isInFloats(std::string_view attribute) {
  return attribute == "POSITION" || attribute == "NORMAL" || attribute.starts_with("TEXCOORD_");
}

bool isPacked(const json::object& primitive) {
  const json::value* const extensions = primitive.if_contains("extensions");
  return extensions != nullptr && extensions->is_object() &&
         extensions->as_object().contains("KHR_draco_mesh_compression");
}

// Changes a document that has been checked.
class GltfSimplifier {
 public:
  GltfSimplifier(json::value& file, const GltfAccessors& accessors, std::vector<std::string>& warnings)
      : accessors_(accessors), warnings_(warnings), root_(file.as_object()) {}

  /// Whether anything changed.
  bool simplify() {
    leaveOutSkins();
    makeUnitTurns();
    for (json::value& mesh : listOf("meshes")) {
      json::value* const primitives = mesh.as_object().if_contains("primitives");
      if (primitives == nullptr) continue;
      for (json::value& primitive : primitives->as_array()) simplify(primitive.as_object());
    }
    addBytes();
    if (changed_) root_.erase("animations");  // which may name what is gone
    return changed_;
  }

 private:
  json::array& listOf(std::string_view name) {
    static json::array none;
    json::value* const list = root_.if_contains(name);
    return list == nullptr ? none : list->as_array();
  }

  void leaveOutSkins() {
    if (listOf("skins").empty()) return;
    bool used = false;
    for (json::value& node : listOf("nodes")) used = node.as_object().erase("skin") > 0 || used;
    root_.erase("skins");
    skins_gone_ = changed_ = true;
    if (used) warnings_.emplace_back("its skins are left out: what they move stands as it was modelled");
  }

  // The reader makes a shear of a turn of another length.
  void makeUnitTurns() {
    constexpr double kRounding = 1e-6, kTolerance = 1e-3;
    std::size_t number = 0;
    for (json::value& node : listOf("nodes")) {
      json::value* const rotation = node.as_object().if_contains("rotation");
      const std::size_t of_node = number++;
      if (rotation == nullptr) continue;
      double squares = 0;
      for (const json::value& part : rotation->as_array())
        squares += part.to_number<double>() * part.to_number<double>();
      const double length = std::sqrt(squares);
      if (std::abs(length - 1) <= kRounding) continue;
      for (json::value& part : rotation->as_array()) part = part.to_number<double>() / length;
      changed_ = true;
      if (std::abs(length - 1) > kTolerance)
        warnings_.push_back(
            fmt::format("nodes/{}: its rotation has the length {:.4g} and is read as one of 1", of_node, length));
    }
  }

  void simplify(json::object& primitive) {
    if (isPacked(primitive)) return;
    json::object& attributes = primitive["attributes"].as_object();
    bool integers = false;
    for (auto& [name, value] : attributes) {
      if (!isInFloats(name)) continue;
      const auto number = value.to_number<std::size_t>();
      const GltfAccessor& accessor = accessors_[number];
      if (accessor.kind == ScalarKind::kFloat || (!accessor.run && !accessor.sparse)) continue;
      if (const auto floats = inFloats(number)) {
        value = *floats;
        integers = true;
      }
    }
    // These may be integers too, and are not read.
    if (integers) attributes.erase("TANGENT");
    if (integers) primitive.erase("targets");
    if (!integers && !skins_gone_) return;
    for (auto at = attributes.begin(); at != attributes.end();) {
      const std::string_view name = at->key();
      at = name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") ? attributes.erase(at) : at + 1;
    }
  }

  // The number of a new accessor; nothing where the bytes are not there.
  std::optional<std::size_t> inFloats(std::size_t number) {
    if (const auto known = in_floats_.find(number); known != in_floats_.end()) return known->second;
    const std::optional<std::vector<float>> floats = accessors_.floatsOf(number);
    if (!floats) return {};
    json::array& list = root_["accessors"].as_array();
    json::array& views = root_["bufferViews"].as_array();
    const std::size_t bytes = floats->size() * sizeof(float);
    views.push_back(json::object{
        {"buffer", root_["buffers"].as_array().size()}, {"byteOffset", bytes_.size()}, {"byteLength", bytes}});
    bytes_.append(reinterpret_cast<const char*>(floats->data()), bytes);
    list.push_back(json::object{{"bufferView", views.size() - 1},
                                {"componentType", kFloat},
                                {"count", accessors_[number].count},
                                {"type", accessors_[number].type}});
    changed_ = true;
    return in_floats_[number] = list.size() - 1;
  }

  void addBytes() {
    if (bytes_.empty()) return;
    root_["buffers"].as_array().push_back(json::object{
        {"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + toBase64(bytes_)}});
  }

  const GltfAccessors& accessors_;
  std::vector<std::string>& warnings_;
  json::object& root_;
  std::map<std::size_t, std::size_t> in_floats_;  // accessors by those that they were made of
  std::string bytes_;                             // of the new accessors
  bool changed_ = false, skins_gone_ = false;
};

}  // namespace

// A .glb starts with "glTF", version, length; then the length and type of the JSON chunk, and the chunk.
std::string gltfJson(const std::string& path) {
  constexpr std::size_t kHeader = 20;
  try {
    const MappedFile file(path);
    const std::string_view bytes = file.bytes();
    if (!bytes.starts_with("glTF") || bytes.size() < kHeader) return std::string(bytes);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return std::string(bytes.substr(kHeader, length));
  } catch (const Error&) {
    return "";
  }
}

std::optional<std::string> plainGltf(const ModelFile& model, std::vector<std::string>& warnings) {
  GltfFile file(model);
  checkGltfExtensions(file.json());
  if (file.isVersion1()) return std::nullopt;
  const GltfAccessors accessors(file);
  checkGltfNodes(file.json());
  checkGltfMeshes(file.json(), accessors, warnings);
  if (!GltfSimplifier(file.json(), accessors, warnings).simplify()) return std::nullopt;
  return file.text();
}

}  // namespace hl

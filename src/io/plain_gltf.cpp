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
#include "io/check_gltf.h"
#include "io/gltf_accessors.h"
#include "io/gltf_additions.h"
#include "io/gltf_file.h"
#include "io/gltf_item.h"
#include "io/gltf_lists.h"
#include "io/gltf_pose.h"
#include "io/gltf_texcoords.h"

namespace hl {

namespace json = boost::json;

namespace {

// What HL reads of a primitive in numbers that may be integers.
bool isInFloats(std::string_view attribute) {
  return attribute == "POSITION" || attribute == "NORMAL" || attribute.starts_with("TEXCOORD_");
}

// Changes a document that has been checked.
class GltfSimplifier {
 public:
  GltfSimplifier(json::value& file, const GltfAccessors& accessors, GltfAdditions& additions,
                 std::vector<std::string>& warnings)
      : accessors_(accessors), additions_(additions), warnings_(warnings), root_(file.as_object()) {}

  /// Whether anything changed.
  bool simplify() {
    makeUnitTurns();
    forEachGltfPrimitive(root_, [this](json::object& primitive) { simplify(primitive); });
    return changed_;
  }

 private:
  // The reader makes a shear of a turn of another length.
  void makeUnitTurns() {
    constexpr double kRounding = 1e-6, kTolerance = 1e-3;
    std::size_t number = 0;
    for (json::value& node : gltfList(root_, "nodes")) {
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
    if (isPackedGltf(primitive)) return;
    json::object& attributes = primitive["attributes"].as_object();
    bool integers = false;
    for (auto& [name, value] : attributes) {
      if (!isInFloats(name)) continue;
      const auto number = value.to_number<std::size_t>();
      if (number >= accessors_.size()) continue;  // an addition: it is in floats
      const GltfAccessor& accessor = accessors_[number];
      if (accessor.kind == ScalarKind::kFloat || (!accessor.run && !accessor.sparse)) continue;
      if (const auto floats = inFloats(number)) {
        value = *floats;
        integers = true;
      }
    }
    if (integers) attributes.erase("TANGENT");  // which may be integers too, and are not read
  }

  // The number of a new accessor; nothing where the bytes are not there.
  std::optional<std::size_t> inFloats(std::size_t number) {
    if (const auto known = in_floats_.find(number); known != in_floats_.end()) return known->second;
    const std::optional<std::vector<float>> floats = accessors_.floatsOf(number);
    if (!floats) return {};
    changed_ = true;
    return in_floats_[number] = additions_.add(*floats, accessors_[number].type, accessors_[number].parts);
  }

  const GltfAccessors& accessors_;
  GltfAdditions& additions_;
  std::vector<std::string>& warnings_;
  json::object& root_;
  std::map<std::size_t, std::size_t> in_floats_;  // accessors by those that they were made of
  bool changed_ = false;
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
  GltfAdditions additions(file.json().as_object());
  const bool posed = poseGltf(file.json(), accessors, additions, warnings);
  const bool placed = placePictures(file.json(), accessors, additions, warnings);
  const bool simplified = GltfSimplifier(file.json(), accessors, additions, warnings).simplify();
  if (!posed && !placed && !simplified) return std::nullopt;
  additions.finish();
  return file.text();
}

}  // namespace hl

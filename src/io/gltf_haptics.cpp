#include "io/gltf_haptics.h"

#include <algorithm>
#include <boost/json.hpp>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "io/companion_file.h"
#include "io/load_image.h"

namespace hl {

namespace {

namespace json = boost::json;

// The value at a path of member names, or nullptr.
const json::value* find(const json::value& value, std::initializer_list<const char*> path) {
  const json::value* at = &value;
  for (const char* name : path) {
    const json::object* object = at->if_object();
    at = object == nullptr ? nullptr : object->if_contains(name);
    if (at == nullptr) return nullptr;
  }
  return at;
}

const json::array& listOf(const json::value& value, std::initializer_list<const char*> path) {
  static const json::array kEmpty;
  const json::value* found = find(value, path);
  const json::array* list = found == nullptr ? nullptr : found->if_array();
  return list == nullptr ? kEmpty : *list;
}

double numberOf(const json::value& value, std::initializer_list<const char*> path, double otherwise) {
  const json::value* found = find(value, path);
  if (found == nullptr || !found->is_number()) return otherwise;
  const double number = found->to_number<double>();
  return std::isfinite(number) ? number : otherwise;
}

// The element of a list that an index member points at, or nullptr.
const json::value* elementOf(const json::array& list, const json::value& value,
                             std::initializer_list<const char*> path) {
  const double index = numberOf(value, path, -1);
  if (!(index >= 0 && index < static_cast<double>(list.size()))) return nullptr;
  return &list[static_cast<std::size_t>(index)];
}

class Reader {
 public:
  Reader(const std::string& path, const json::value& file, bool alone) : path_(path), file_(file), alone_(alone) {}

  GltfHaptics read();

 private:
  void readPhysics(const json::value& node, Material& material, bool& given) const;
  void readMpeg(const json::value& node, Material& material, bool& given);
  void addTexture(const json::value& items, std::initializer_list<Quantity> quantities, double most,
                  Material& material);
  bool isOnlyName(const std::string& name) const;

  const std::string path_;
  const json::value& file_;
  const bool alone_;
  GltfHaptics result_;
};

void Reader::readPhysics(const json::value& node, Material& material, bool& given) const {
  const json::array& materials = listOf(file_, {"extensions", "KHR_physics_rigid_bodies", "physicsMaterials"});
  const json::value* physics =
      elementOf(materials, node, {"extensions", "KHR_physics_rigid_bodies", "collider", "physicsMaterial"});
  if (physics == nullptr) return;
  constexpr double kDefault = 0.6;  // of the extension
  material.static_friction = std::max(0.0, numberOf(*physics, {"staticFriction"}, kDefault));
  material.dynamic_friction = std::max(0.0, numberOf(*physics, {"dynamicFriction"}, kDefault));
  given = true;
}

void Reader::addTexture(const json::value& items, std::initializer_list<Quantity> quantities, double most,
                        Material& material) {
  const json::array* list = items.if_array();
  if (list == nullptr || list->empty()) return;
  const json::value& item = list->front();
  const json::value* texture = elementOf(listOf(file_, {"textures"}), item, {"texture", "index"});
  const json::value* image = texture == nullptr ? nullptr : elementOf(listOf(file_, {"images"}), *texture, {"source"});
  const json::value* uri = image == nullptr ? nullptr : find(*image, {"uri"});
  if (uri == nullptr || !uri->is_string() || uri->as_string().starts_with("data:")) {
    result_.warnings.push_back("a haptic texture whose image is not a file was left out");
    return;
  }
  if (alone_) {
    result_.warnings.push_back("a haptic texture was left out: its image is another file, and this one comes alone");
    return;
  }
  try {
    result_.textures.push_back(readImage(companionPath(path_, std::string(uri->as_string()))));
  } catch (const Error& error) {
    result_.warnings.push_back(std::string("a haptic texture was left out: ") + error.what());
    return;
  }
  const double low = std::clamp(numberOf(item, {"extras", "low"}, 0), 0.0, most);
  const double high = std::clamp(numberOf(item, {"extras", "high"}, 1), 0.0, most);
  for (const Quantity quantity : quantities)
    material.textureOf(quantity) = {static_cast<std::uint32_t>(result_.textures.size() - 1), low, high};
}

void Reader::readMpeg(const json::value& node, Material& material, bool& given) {
  const json::value* mesh = elementOf(listOf(file_, {"meshes"}), node, {"mesh"});
  if (mesh == nullptr) return;
  const json::array& materials = listOf(file_, {"extensions", "MPEG_haptic_material", "materials"});
  const json::value* haptic =
      elementOf(materials, *mesh, {"extensions", "MPEG_haptic_material", "hapticMaterialIndex"});
  if (haptic == nullptr) return;
  constexpr double kMaxFriction = 100;
  if (const json::value* stiffness = find(*haptic, {"stiffness"}))
    addTexture(*stiffness, {Quantity::kStiffness}, 1, material);
  if (const json::value* friction = find(*haptic, {"friction"}))
    addTexture(*friction, {Quantity::kStaticFriction, Quantity::kDynamicFriction}, kMaxFriction, material);
  for (const char* other : {"vibrotactileTexture", "temperature", "vibration", "custom"}) {
    if (find(*haptic, {other}) != nullptr)
      result_.warnings.push_back(std::string("MPEG_haptic_material: ") + other + " is not felt by HL");
  }
  given = true;
}

bool Reader::isOnlyName(const std::string& name) const {
  const json::array& nodes = listOf(file_, {"nodes"});
  return !name.empty() && std::count_if(nodes.begin(), nodes.end(), [&](const json::value& node) {
                            const json::value* other = find(node, {"name"});
                            return other != nullptr && other->is_string() && other->as_string() == name;
                          }) == 1;
}

GltfHaptics Reader::read() {
  for (const json::value& node : listOf(file_, {"nodes"})) {
    Material material;
    bool given = false;
    readPhysics(node, material, given);
    readMpeg(node, material, given);
    if (!given) continue;
    const json::value* name_value = find(node, {"name"});
    const std::string name =
        name_value != nullptr && name_value->is_string() ? std::string(name_value->as_string()) : "";
    if (!isOnlyName(name)) {
      result_.warnings.push_back("the touch of node '" + name + "' was left out: its name does not tell it apart");
      continue;
    }
    result_.material_of_node[name] = result_.materials.size();
    result_.materials.push_back(material);
  }
  return std::move(result_);
}

}  // namespace

GltfHaptics readGltfHaptics(const std::string& text, const std::string& path, bool alone) {
  const bool speaks_of_touch = text.find("KHR_physics_rigid_bodies") != std::string::npos ||
                               text.find("MPEG_haptic_material") != std::string::npos;
  if (!speaks_of_touch) return {};
  json::error_code error;
  const json::value file = json::parse(text, error);
  if (error) return {};
  return Reader(path, file, alone).read();
}

}  // namespace hl

#include "io/gltf_texcoords.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <optional>
#include <set>
#include <utility>

#include "io/check_gltf.h"
#include "io/gltf_item.h"

namespace hl {

namespace json = boost::json;

namespace {

constexpr const char* kTransform = "KHR_texture_transform";

// Where the picture of a material lies.
struct PicturePlace {
  std::size_t set = 0;  // of texture coordinates
  Eigen::Affine2d transform = Eigen::Affine2d::Identity();
  bool given = false;

  bool isFirstAsItIs() const { return set == 0 && !given; }
};

// KHR_texture_transform: scaled, then turned, then moved; v goes down, so that a turn is the other way around.
PicturePlace placeOf(const GltfItem& texture) {
  PicturePlace place;
  place.set = texture.whole("texCoord").value_or(0);
  const std::optional<GltfItem> extensions = texture.child("extensions");
  const std::optional<GltfItem> transform = extensions ? extensions->child(kTransform) : std::nullopt;
  if (!transform) return place;
  place.given = true;
  place.set = transform->whole("texCoord").value_or(place.set);
  const std::vector<double> offset = transform->numbers("offset", 2), scale = transform->numbers("scale", 2);
  if (!offset.empty()) place.transform.translate(Eigen::Vector2d(offset.data()));
  place.transform.rotate(Eigen::Rotation2Dd(-transform->number("rotation").value_or(0)));
  if (!scale.empty()) place.transform.scale(Eigen::Vector2d(scale.data()));
  return place;
}

std::vector<PicturePlace> placesOfMaterials(const json::value& file) {
  std::vector<PicturePlace> places;
  for (const GltfItem& material : GltfItem(file, "").list("materials")) {
    const std::optional<GltfItem> surface = material.child("pbrMetallicRoughness");
    const std::optional<GltfItem> texture = surface ? surface->child("baseColorTexture") : std::nullopt;
    places.push_back(texture ? placeOf(*texture) : PicturePlace());
  }
  return places;
}

// Haptic textures lie over the first texture coordinates as they are.
bool hasHapticTextures(const json::value& file) {
  const json::value* const extensions = file.as_object().if_contains("extensions");
  return extensions != nullptr && extensions->is_object() && extensions->as_object().contains("MPEG_haptic_material");
}

// What has been applied; a picture that could not be placed goes.
void forget(json::value& material, bool placed) {
  json::object& surface = material.as_object()["pbrMetallicRoughness"].as_object();
  if (!placed) surface.erase("baseColorTexture");
  if (!placed) return;
  json::object& texture = surface["baseColorTexture"].as_object();
  texture.erase("texCoord");
  if (json::value* const extensions = texture.if_contains("extensions")) extensions->as_object().erase(kTransform);
}

std::vector<float> moved(const std::vector<float>& coordinates, const Eigen::Affine2d& transform) {
  std::vector<float> result(coordinates.size());
  for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2) {
    const Eigen::Vector2d place = transform * Eigen::Vector2f(&coordinates[i]).cast<double>();
    result[i] = static_cast<float>(place.x());
    result[i + 1] = static_cast<float>(place.y());
  }
  return result;
}

class PicturePlacer {
 public:
  PicturePlacer(json::value& file, const GltfAccessors& accessors, GltfAdditions& additions,
                std::vector<std::string>& warnings)
      : file_(file), accessors_(accessors), additions_(additions), warnings_(warnings) {}

  bool place() {
    const std::vector<PicturePlace> places = placesOfMaterials(file_);
    const std::vector<GltfItem> meshes = GltfItem(file_, "").list("meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const std::vector<GltfItem> primitives = meshes[i].list("primitives");
      for (std::size_t k = 0; k < primitives.size(); ++k) {
        const auto material = primitives[k].reference("material", "materials", places.size());
        if (!material || places[*material].isFirstAsItIs()) continue;
        json::object& mesh = file_.as_object()["meshes"].as_array()[i].as_object();
        if (!place(primitives[k], places[*material], mesh["primitives"].as_array()[k].as_object()))
          unplaced_.insert(*material);
      }
    }
    return forgetPlaces(places);
  }

 private:
  bool place(const GltfItem& primitive, const PicturePlace& of_picture, json::object& changed) {
    const std::string set = fmt::format("TEXCOORD_{}", of_picture.set);
    const GltfItem attributes = *primitive.child("attributes");
    const auto number = attributes.reference(set, "accessors", accessors_.size());
    std::optional<std::vector<float>> coordinates;
    if (number && !isPackedGltf(primitive.object())) coordinates = accessors_.floatsOf(*number);
    if (!coordinates || accessors_[*number].type != "VEC2") {
      warnings_.push_back(
          fmt::format("{}: has no {} that can be read, over which its picture lies", primitive.place(), set));
      return false;
    }
    changed["attributes"].as_object()["TEXCOORD_0"] =
        additions_.add(moved(*coordinates, of_picture.transform), "VEC2", 2);
    return true;
  }

  bool forgetPlaces(const std::vector<PicturePlace>& places) {
    bool any = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].isFirstAsItIs()) continue;
      forget(file_.as_object()["materials"].as_array()[i], !unplaced_.contains(i));
      any = true;
    }
    return any;
  }

  json::value& file_;
  const GltfAccessors& accessors_;
  GltfAdditions& additions_;
  std::vector<std::string>& warnings_;
  std::set<std::size_t> unplaced_;  // materials
};

}  // namespace

bool placePictures(json::value& file, const GltfAccessors& accessors, GltfAdditions& additions,
                   std::vector<std::string>& warnings) {
  return !hasHapticTextures(file) && PicturePlacer(file, accessors, additions, warnings).place();
}

}  // namespace hl

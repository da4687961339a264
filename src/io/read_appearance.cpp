#include "io/read_appearance.h"

#include <assimp/material.h>
#include <assimp/texture.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/plain_file.h"
#include "io/companion_file.h"
#include "io/load_image.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr std::size_t kMaxPictureBytes = std::size_t{256} << 20;  // of all pictures together, as files

// What exporters write into a name.
std::string withSlashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

// IEC 61966-2-1.
float toScreen(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

}  // namespace

AppearanceReader::AppearanceReader(const aiScene& scene, const ModelFile& file)
    : scene_(scene), file_(file), linear_(file.ending == ".gltf" || file.ending == ".glb" || file.ending == ".vrm") {}

void AppearanceReader::add(const aiMesh& mesh, std::size_t triangles) {
  addVertexColours(mesh);
  const std::uint16_t paint = paintOf(mesh.mMaterialIndex);
  appearance_.triangle_paints.resize(appearance_.triangle_paints.size() + triangles, paint);
}

void AppearanceReader::addVertexColours(const aiMesh& mesh) {
  auto& colours = appearance_.vertex_colours;
  vertices_ += mesh.mNumVertices;
  if (!mesh.HasVertexColors(0)) {
    if (!colours.empty()) colours.resize(vertices_, kWhite);
    return;
  }
  colours.resize(vertices_ - mesh.mNumVertices, kWhite);
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) colours.push_back(rgbOf(mesh.mColors[0][i]));
}

Rgb AppearanceReader::rgbOf(const aiColor4D& colour) const {
  const auto byte = [&](float part) { return colourByte(linear_ ? toScreen(part) : part); };
  return {byte(colour.r), byte(colour.g), byte(colour.b)};
}

// assimp adds a grey material where a file has none.
std::uint16_t AppearanceReader::paintOf(unsigned material) {
  const auto [known, fresh] = paints_.try_emplace(material);
  if (!fresh) return known->second;
  Paint paint;
  if (material < scene_.mNumMaterials) paint = paintOf(*scene_.mMaterials[material]);
  if (appearance_.paints.size() < Appearance::kMaxPaints) appearance_.paints.push_back(paint);
  return known->second = static_cast<std::uint16_t>(appearance_.paints.size() - 1);
}

Paint AppearanceReader::paintOf(const aiMaterial& material) {
  Paint paint;
  aiString name;
  material.Get(AI_MATKEY_NAME, name);
  paint.picture = pictureOf(material);
  if (!paint.picture && std::string_view(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME) return paint;
  aiColor4D colour(1, 1, 1, 1);
  if (material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS)
    paint.colour = rgbOf(colour);
  // Many exporters leave the colour black where there is a picture, which readers take as it is.
  if (paint.picture && paint.colour == Rgb{0, 0, 0}) paint.colour = kWhite;
  return paint;
}

// Only pictures over the first texture coordinates, which are those of the model.
std::optional<std::uint32_t> AppearanceReader::pictureOf(const aiMaterial& material) {
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    aiString found;
    unsigned coordinates = 0;
    aiTextureMapMode mode[2]{aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (material.GetTexture(type, 0, &found, nullptr, &coordinates, nullptr, nullptr, mode) != aiReturn_SUCCESS ||
        found.length == 0)
      continue;
    const std::string name = found.C_Str();
    if (coordinates != 0) {
      refused_.try_emplace(shown(name), "lies over texture coordinates other than the first");
      continue;
    }
    const Wrap wrap = mode[0] == aiTextureMapMode_Clamp ? Wrap::kClamp : Wrap::kRepeat;
    const auto [known, fresh] = pictures_.try_emplace({name, wrap});
    if (!fresh) return known->second;
    try {
      std::shared_ptr<const std::string> file = fileOf(name);
      if (file->size() > kMaxPictureBytes - bytes_) throw Error("comes after 256 MB of others");
      bytes_ += file->size();
      appearance_.pictures.push_back({std::move(file), wrap});
      known->second = static_cast<std::uint32_t>(appearance_.pictures.size() - 1);
    } catch (const Error& error) {
      refused_.try_emplace(shown(name), error.what());
    }
    return known->second;
  }
  return {};
}

std::shared_ptr<const std::string> AppearanceReader::fileOf(const std::string& name) const {
  if (const aiTexture* const within = scene_.GetEmbeddedTexture(name.c_str())) {
    if (within->mHeight != 0) throw Error("is not packed as PNG or JPEG");
    return checkedPicture({reinterpret_cast<const char*>(within->pcData), within->mWidth});
  }
  if (file_.alone) throw Error("is a file of its own, and the model comes alone");
  const std::string path = companionPath(file_.path, withSlashes(name));
  const std::optional<std::string> bytes = contentOf(path);
  if (!bytes) throw Error("cannot be opened");
  return checkedPicture(*bytes);
}

Appearance AppearanceReader::take(std::vector<std::string>& warnings) {
  constexpr std::size_t kMostNamed = 3;
  std::size_t named = 0;
  for (const auto& [name, why] : refused_) {
    if (++named <= kMostNamed) warnings.push_back(fmt::format("its picture '{}' is not shown: it {}", name, why));
  }
  if (named > kMostNamed) warnings.push_back(fmt::format("{} pictures more are not shown", named - kMostNamed));
  if (!appearance_.vertex_colours.empty()) appearance_.vertex_colours.resize(vertices_, kWhite);
  return std::exchange(appearance_, {});
}

}  // namespace hl

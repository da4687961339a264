// What assimp has read of how a model looks: base colours, the colours of vertices, and pictures.
#pragma once

#include <assimp/scene.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/model_file.h"
#include "scene/appearance.h"

namespace hl {

/// Gathers the appearance of a model, mesh by mesh, in the order of the model's vertices and triangles.
class AppearanceReader {
 public:
  AppearanceReader(const aiScene& scene, const ModelFile& file);

  /// Of a mesh of which the model has got so many triangles.
  void add(const aiMesh& mesh, std::size_t triangles);
  /// Once, after the last mesh. What could not be taken is said in `warnings`.
  Appearance take(std::vector<std::string>& warnings);

 private:
  void addVertexColours(const aiMesh& mesh);
  std::uint16_t paintOf(unsigned material);
  Paint paintOf(const aiMaterial& material);
  std::optional<std::uint32_t> pictureOf(const aiMaterial& material);
  std::shared_ptr<const std::string> fileOf(const std::string& name) const;
  Rgb rgbOf(const aiColor4D& colour) const;

  const aiScene& scene_;
  const ModelFile& file_;
  const bool linear_;  // its colours are in proportion to light, and not as screens show them
  Appearance appearance_;
  std::map<unsigned, std::uint16_t> paints_;  // by material of the file
  std::map<std::pair<std::string, Wrap>, std::optional<std::uint32_t>>
      pictures_;                                // by name; nothing: it cannot be taken
  std::size_t vertices_ = 0, bytes_ = 0;        // bytes of all pictures
  std::map<std::string, std::string> refused_;  // why, by name
};

}  // namespace hl

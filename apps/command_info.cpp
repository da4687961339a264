// hl info: what is in a scene.
#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "commands.h"
#include "scene/bump_gain.h"

namespace hl {

namespace {

void printTexture(const Model& model, const TextureUse& use, const std::string& name, const std::string& unit) {
  if (!use.used()) return;
  const Texture& texture = model.textures[use.texture];
  fmt::print("  {} from texture {} ({} x {}): {:.4g} to {:.4g}{}\n", name, texture.name, texture.width, texture.height,
             use.low, use.high, unit);
}

// Of the numbers those that are not what they are where nobody says any.
void printMaterial(const Snapshot& snapshot, std::size_t number) {
  const Model& model = snapshot.shape().model;
  const Material& m = model.materials[number];
  fmt::print("material {}: {}", number, m.smooth ? "smooth" : "flat");
  const auto unitOf = [](const QuantityInfo& info) { return *info.unit == 0 ? "" : std::string(" ") + info.unit; };
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const double value = m.*kMaterialNumbers[i];
    const QuantityInfo& info = kQuantityInfo[i];
    if (value != info.otherwise || info.quantity == Quantity::kStiffness)
      fmt::print(", {} {:.4g}{}", plainName(info), value, unitOf(info));
  }
  fmt::print("\n");
  for (std::size_t i = 0; i < kNumbers; ++i)
    printTexture(model, m.textures[i], plainName(kQuantityInfo[i]), unitOf(kQuantityInfo[i]));
  printTexture(model, m.textureOf(Quantity::kHeight), "height", " m");
  // The default device: 0.5 N s/m at 1 kHz.
  const double curvature = bumpCurvature_per_m(snapshot, number);
  if (curvature > 0)
    fmt::print(
        "  the bump map adds {:.3g} N/m for each newton of pressure: passive up to {:.3g} N (0.5 N s/m, 1 kHz)\n",
        curvature, passiveForce_N(curvature, 0.5, 1e-3));
}

void print(const Snapshot& snapshot) {
  const Model& model = snapshot.shape().model;
  const Vec3 size = snapshot.bounds.size();
  const IndexStats stats = snapshot.shape().index->stats();
  const std::size_t primitives = snapshot.primitives;
  fmt::print("name:       {}\n", model.name);
  fmt::print("primitives: {} ({} triangles, {} segments, {} points given; {} vertices)\n", primitives,
             model.triangles.size(), model.segments.size(), model.points.size(), model.positions.size());
  if (model.reading.joined_vertices > 0)
    fmt::print("joined:     {} vertices that were the same as others to the bit\n", model.reading.joined_vertices);
  if (model.reading.single_precision)
    fmt::print("precision:  model files are read in single precision: coordinates to 6e-8 of their size\n");
  fmt::print("normals:    {}\n", model.normals.empty() ? "none" : "per vertex");
  fmt::print("texcoords:  {}\n", model.texcoords.empty() ? "none" : "per vertex");
  fmt::print("size:       {:.6g} x {:.6g} x {:.6g} m\n", size.x(), size.y(), size.z());
  fmt::print("from:       {:.6g} {:.6g} {:.6g} m\n", snapshot.bounds.min.x(), snapshot.bounds.min.y(),
             snapshot.bounds.min.z());
  fmt::print("to:         {:.6g} {:.6g} {:.6g} m\n", snapshot.bounds.max.x(), snapshot.bounds.max.y(),
             snapshot.bounds.max.z());
  fmt::print("hierarchy:  {} nodes, {} leaves, depth {}\n", stats.nodes, stats.leaves, stats.depth);
  fmt::print("memory:     {:.1f} MB; vertices, indices and hierarchy: {} bytes a primitive\n",
             1e-6 * static_cast<double>(memoryOf(snapshot)), snapshot.shape().geometryBytes() / primitives);
  constexpr std::size_t kMaxPrinted = 20;
  const std::size_t materials = model.materials.size();
  for (std::size_t i = 0; i < std::min(materials, kMaxPrinted); ++i) printMaterial(snapshot, i);
  if (materials > kMaxPrinted) fmt::print("and {} materials more\n", materials - kMaxPrinted);
  fmt::print("warnings:   {}\n", snapshot.warnings.empty() ? "none" : "");
  for (const std::string& warning : snapshot.warnings) fmt::print("  {}\n", warning);
}

}  // namespace

void addInfoCommand(CLI::App& app) {
  auto* command = app.add_subcommand("info", "what is in a scene: primitives, size, hierarchy, memory, warnings");
  auto options = std::make_shared<SceneOptions>();
  addSceneArgument(*command, *options, true);
  addSizeOptions(*command, *options);
  addHierarchyOption(*command, *options);
  command->callback([options] { print(*loadSnapshot(*options)); });
}

}  // namespace hl

// hl info: what is in a scene.
#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "commands.h"
#include "scene/bump_gain.h"

namespace hl {

namespace {

constexpr std::array<const char*, kQuantities> kQuantityNames{"stiffness", "static friction", "dynamic friction",
                                                              "viscosity", "height"};
constexpr std::array<const char*, kQuantities> kQuantityUnits{"", "", "", " N s/m", " m"};

void printMaterial(const Snapshot& snapshot, std::size_t number) {
  const Material& m = snapshot.shape().model.materials[number];
  fmt::print("material {}: stiffness {:.4g}, friction {:.4g} static {:.4g} dynamic, viscosity {:.4g} N s/m, {}\n",
             number, m.stiffness, m.static_friction, m.dynamic_friction, m.viscosity_Ns_m,
             m.smooth ? "smooth" : "flat");
  for (std::size_t q = 0; q < kQuantities; ++q) {
    const TextureUse& use = m.textures[q];
    if (!use.used()) continue;
    const Texture& texture = snapshot.shape().model.textures[use.texture];
    fmt::print("  {} from texture {} ({} x {}): {:.4g} to {:.4g}{}\n", kQuantityNames[q], texture.name, texture.width,
               texture.height, use.low, use.high, kQuantityUnits[q]);
  }
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
  constexpr std::size_t kMostPrinted = 20;
  const std::size_t materials = model.materials.size();
  for (std::size_t i = 0; i < std::min(materials, kMostPrinted); ++i) printMaterial(snapshot, i);
  if (materials > kMostPrinted) fmt::print("and {} materials more\n", materials - kMostPrinted);
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

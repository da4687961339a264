// hl info: what is in a scene.
#include <fmt/core.h>

#include "commands.h"

namespace hl {

namespace {

void print(const Snapshot& snapshot) {
  const Model& model = snapshot.model;
  const Vec3 size = snapshot.bounds.size();
  const IndexStats stats = snapshot.index->stats();
  const std::size_t primitives = snapshot.primitives.size();
  fmt::print("name:       {}\n", model.name);
  fmt::print("primitives: {} ({} triangles, {} segments, {} points given; {} vertices)\n", primitives,
             model.triangles.size(), model.segments.size(), model.points.size(), model.positions.size());
  fmt::print("normals:    {}\n", model.normals.empty() ? "none" : "per vertex");
  fmt::print("texcoords:  {}\n", model.texcoords.empty() ? "none" : "per vertex");
  fmt::print("size:       {:.6g} x {:.6g} x {:.6g} m\n", size.x(), size.y(), size.z());
  fmt::print("from:       {:.6g} {:.6g} {:.6g} m\n", snapshot.bounds.min.x(), snapshot.bounds.min.y(),
             snapshot.bounds.min.z());
  fmt::print("to:         {:.6g} {:.6g} {:.6g} m\n", snapshot.bounds.max.x(), snapshot.bounds.max.y(),
             snapshot.bounds.max.z());
  fmt::print("hierarchy:  {} nodes, {} leaves, depth {}\n", stats.nodes, stats.leaves, stats.depth);
  const std::size_t bytes = stats.bytes + primitives * sizeof(Primitive);
  fmt::print("memory:     {:.1f} MB ({} bytes a primitive)\n", 1e-6 * static_cast<double>(bytes), bytes / primitives);
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

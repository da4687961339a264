// hl info: what is in a scene.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/utf8.h"
#include "bodies/made_bodies.h"
#include "commands.h"
#include "load_snapshot.h"
#include "scene/bump_gain.h"
#include "scene/tight_bounds.h"
#include "scene_options.h"
#include "scene_report.h"
#include "surfaces/height_field.h"
#include "surfaces/implicit/implicit_surface.h"
#include "surfaces/iso_surface.h"
#include "surfaces/point_cloud.h"

namespace hl {

namespace {

constexpr std::size_t kMaxPrinted = 50;  // bodies, and joints

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
  const auto unit_of = [](const QuantityInfo& info) { return *info.unit == 0 ? "" : std::string(" ") + info.unit; };
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const double value = m.*kMaterialNumbers[i];
    const QuantityInfo& info = kQuantityInfo[i];
    if (value != info.otherwise || info.quantity == Quantity::kStiffness)
      fmt::print(", {} {:.4g}{}", plainName(info), value, unit_of(info));
  }
  fmt::print("\n");
  for (std::size_t i = 0; i < kNumbers; ++i)
    printTexture(model, m.textures[i], plainName(kQuantityInfo[i]), unit_of(kQuantityInfo[i]));
  printTexture(model, m.textureOf(Quantity::kHeight), "height", " m");
  // The default device: 0.5 N s/m at 1 kHz.
  const double curvature = bumpCurvature_per_m(snapshot, number);
  if (curvature > 0)
    fmt::print(
        "  the bump map adds {:.3g} N/m for each newton of pressure: passive up to {:.3g} N (0.5 N s/m, 1 kHz)\n",
        curvature, passiveForce_N(curvature, 0.5, 1e-3));
}

// Of all instances.
struct Totals {
  std::size_t triangles = 0, segments = 0, points = 0, vertices = 0;
  Reading reading;
  std::size_t nodes = 0, leaves = 0, geometry_bytes = 0;
  int depth = 0;
  bool normals = false, texcoords = false, vertex_colours = false;
  std::set<Rgb> colours;
  std::map<const std::string*, std::size_t> pictures;  // bytes of each file

  void add(const Shape& shape) {
    const Model& model = shape.model;
    const IndexStats stats = shape.index->stats();
    triangles += trianglesOf(shape);
    segments += model.segments.size();
    points += shape.source && shape.source->kind() == PrimitiveKind::kPoint ? shape.elements() : model.points.size();
    vertices += model.positions.size();
    reading.add(model.reading);
    nodes += stats.nodes;
    leaves += stats.leaves;
    depth = std::max(depth, stats.depth);
    geometry_bytes += shape.geometryBytes();
    normals = normals || shape.hasNormals();
    texcoords = texcoords || shape.hasTexcoords();
    addAppearance(model.appearance);
  }
  void addAppearance(const Appearance& appearance) {
    vertex_colours = vertex_colours || !appearance.vertex_colours.empty();
    for (const std::uint16_t number : appearance.triangle_paints) colours.insert(appearance.paints[number].colour);
    for (const Picture& picture : appearance.pictures) pictures[picture.file.get()] = picture.file->size();
  }
};

// Pages show it.
void printAppearance(const Totals& all) {
  if (all.vertex_colours) fmt::print("colours:    per vertex\n");
  if (!all.vertex_colours && !all.colours.empty()) fmt::print("colours:    {} of surfaces\n", all.colours.size());
  std::size_t bytes = 0;
  for (const auto& [file, size] : all.pictures) bytes += size;
  if (bytes > 0) fmt::print("pictures:   {}, {:.2g} MB\n", all.pictures.size(), 1e-6 * static_cast<double>(bytes));
}

void printReading(const Reading& reading) {
  if (reading.patch_error_m > 0)
    fmt::print("patches:    within {:.3g} m of the surfaces that they stand for\n", reading.patch_error_m);
  if (!reading.cad) return;
  const CadReading& cad = *reading.cad;
  fmt::print("cad:        {} faces, {} solids; deflection {:.3g} m, angle {:.3g} rad\n", cad.faces, cad.solids,
             cad.deflection_m, cad.angle_rad);
  fmt::print("            within {:.3g} m of its surfaces; the file's own largest tolerance is {:.3g} m\n", cad.error_m,
             cad.tolerance_m);
}

void printBounds(const Box& bounds) {
  const Vec3 &from = bounds.min, &to = bounds.max, size = bounds.size();
  if (bounds.empty()) {
    fmt::print("size:       none: nothing of it can be touched\n");
    return;
  }
  fmt::print("size:       {:.6g} x {:.6g} x {:.6g} m\n", size.x(), size.y(), size.z());
  fmt::print("from:       {:.6g} {:.6g} {:.6g} m\n", from.x(), from.y(), from.z());
  fmt::print("to:         {:.6g} {:.6g} {:.6g} m\n", to.x(), to.y(), to.z());
}

void printTotals(const Totals& all, const Snapshot& snapshot) {
  fmt::print("primitives: {} ({} triangles, {} segments, {} points given; {} vertices)\n", snapshot.primitives,
             all.triangles, all.segments, all.points, all.vertices);
  if (all.reading.joined_vertices > 0)
    fmt::print("joined:     {} vertices that were the same as others to the bit\n", all.reading.joined_vertices);
  if (all.reading.single_precision)
    fmt::print("precision:  model files are read in single precision: coordinates to 6e-8 of their size\n");
  fmt::print("normals:    {}\n", all.normals ? "per vertex" : "none");
  fmt::print("texcoords:  {}\n", all.texcoords ? "per vertex" : "none");
  printAppearance(all);
  printBounds(tightBounds(snapshot));
  fmt::print("hierarchy:  {} nodes, {} leaves, depth {}\n", all.nodes, all.leaves, all.depth);
  fmt::print("memory:     {:.1f} MB; vertices, indices and hierarchy: {} bytes a primitive\n",
             1e-6 * static_cast<double>(memoryOf(snapshot)), all.geometry_bytes / snapshot.primitives);
}

// Of CAD files: each solid.
void printParts(const Snapshot& snapshot) {
  std::size_t parts = 0;
  for (const Instance& instance : snapshot.instances) {
    if (!instance.label || instance.shape->source || ++parts > kMaxPrinted) continue;
    fmt::print("part {}: {} triangles", printable(instance.label->name), instance.shape->model.triangles.size());
    if (instance.label->colour) fmt::print(", colour #{:06x}", packRgb(*instance.label->colour));
    fmt::print("\n");
  }
  if (parts > kMaxPrinted) fmt::print("and {} parts more\n", parts - kMaxPrinted);
}

void printMaterials(const Snapshot& snapshot) {
  constexpr std::size_t kMaxMaterials = 20;
  const std::size_t materials = snapshot.shape().model.materials.size();
  for (std::size_t i = 0; i < std::min(materials, kMaxMaterials); ++i) printMaterial(snapshot, i);
  if (materials > kMaxMaterials) fmt::print("and {} materials more\n", materials - kMaxMaterials);
}

std::string howOpenCounts(const Body& made) {
  return made.shell_m > 0 ? fmt::format("a shell of {:.3g} mm", 1e3 * made.shell_m) : "a solid with its holes closed";
}

void printBody(const RigidBody& body, const std::shared_ptr<const Shape>& shape) {
  const BodySurface& surface = body.spec.surface;
  fmt::print("body {}: ", printable(body.name));
  if (body.poses) {
    const std::shared_ptr<const Body> kept = madeBody(shape, body.spec);
    const Body& made = *kept;
    fmt::print("{}, {:.4g} kg", kBodyShapeNames[static_cast<std::size_t>(body.spec.shape)], made.mass.mass_kg);
    if (made.shape.parts.size() > 1) fmt::print(", {} parts", made.shape.parts.size());
    if (made.open_edges > 0) fmt::print(", open at {} edges: {}", made.open_edges, howOpenCounts(made));
    constexpr double kRounding_m = 1e-9;
    if (made.hull_error_m > kRounding_m) fmt::print(", the mesh is up to {:.3g} mm outside", 1e3 * made.hull_error_m);
    if (made.excess_m > kRounding_m) fmt::print(", parts reach up to {:.3g} mm beyond it", 1e3 * made.excess_m);
  } else {
    fmt::print("fixed");
  }
  fmt::print(", friction {:.4g} static and {:.4g} dynamic, restitution {:.4g}\n", surface.static_friction,
             surface.dynamic_friction, surface.restitution);
}

std::string bodyNamed(const Snapshot& snapshot, std::uint64_t key) {
  std::uint32_t number = 0;
  if (!snapshot.find(key, number) || !snapshot.instances[number].body) return "the world";
  return printable(snapshot.instances[number].body->name);
}

void printJoint(const JointSpec& joint, const Snapshot& snapshot) {
  const JointForces& along = joint.along;
  fmt::print("joint {}: {}, {} to {}", printable(joint.name), kJointKindNames[static_cast<std::size_t>(joint.kind)],
             bodyNamed(snapshot, joint.body_a), bodyNamed(snapshot, joint.body_b));
  const bool turns = joint.kind == JointKind::kHinge;
  if (std::isfinite(along.low) || std::isfinite(along.high))
    fmt::print(", {:.4g} .. {:.4g} {}", along.low, along.high, turns ? "rad" : "m");
  if (along.spring > 0) fmt::print(", spring {:.4g} {}", along.spring, turns ? "N m/rad" : "N/m");
  if (along.damping > 0) fmt::print(", damping {:.4g} {}", along.damping, turns ? "N m s/rad" : "N s/m");
  if (along.friction > 0) fmt::print(", friction {:.4g} {}", along.friction, turns ? "N m" : "N");
  if (!along.table.empty()) fmt::print(", a force table of {} rows", along.table.position.size());
  fmt::print("\n");
}

void printJoints(const Snapshot& snapshot) {
  const std::vector<JointSpec>& joints = snapshot.mechanics.joints;
  for (std::size_t i = 0; i < std::min(joints.size(), kMaxPrinted); ++i) printJoint(joints[i], snapshot);
  if (joints.size() > kMaxPrinted) fmt::print("and {} joints more\n", joints.size() - kMaxPrinted);
}

void printBodies(const Snapshot& snapshot) {
  std::size_t bodies = 0;
  for (const Instance& instance : snapshot.instances) {
    if (instance.body && ++bodies <= kMaxPrinted) printBody(*instance.body, instance.shape);
  }
  if (bodies > kMaxPrinted) fmt::print("and {} bodies more\n", bodies - kMaxPrinted);
  if (bodies == 0) return;
  const Vec3& gravity = snapshot.mechanics.gravity_m_s2;
  fmt::print("gravity:    {:.6g} {:.6g} {:.6g} m/s^2\n", gravity.x(), gravity.y(), gravity.z());
}

void printHeights(const HeightField& field) {
  const HeightGrid& grid = field.grid();
  const Mat3& axes = field.frame().axes;
  const auto bytes = static_cast<double>(field.shared().bytes);
  fmt::print("heights:    {} x {} samples of {}, {:.6g} x {:.6g} m apart, {:.6g} m a unit, from {:.6g} to {:.6g}\n",
             grid.columns(), grid.rows(), nameOf(grid.size().kind), axes.col(0).norm(), axes.col(1).norm(),
             axes.col(2).norm(), field.pyramid().lowest(), field.pyramid().highest());
  fmt::print("            {} triangles, {} lack; {:.2f} bytes a triangle; within {:.3g} m of the bilinear surface\n",
             field.triangles(), field.count() - field.triangles(), bytes / static_cast<double>(field.triangles()),
             field.error_m());
}

// triangles() estimates them.
std::uint64_t countTriangles(const IsoSurface& surface) {
  std::uint64_t count = 0;
  surface.cells().forEach([&](const IsoCell& cell) {
    for (unsigned n = 0; n < cell.triangles->count; ++n) count += exists(cell, n) ? 1 : 0;
  });
  return count;
}

// An edge of a cell has the surface where linear interpolation has it; a face of a triangle is off by about as much
// again.
void printVolume(const IsoSurface& surface) {
  const VoxelGrid& grid = surface.volume()->grid;
  const Mat3& axes = surface.frame().axes;
  const ValueRange& range = surface.volume()->pyramid.range();
  fmt::print("volume:     {} x {} x {} samples of {}, {:.6g} x {:.6g} x {:.6g} m apart, values from {:.6g} to {:.6g}\n",
             grid.side(0), grid.side(1), grid.side(2), nameOf(grid.samples().kind()), axes.col(0).norm(),
             axes.col(1).norm(), axes.col(2).norm(), range.low, range.high);
  fmt::print("            surface at {:.6g}, matter {}; {} triangles, within {:.3g} m of the trilinear surface\n",
             surface.iso().value, surface.iso().solid == SolidSide::kAbove ? "above" : "below", countTriangles(surface),
             surface.error_m());
  fmt::print("            {:.1f} MB, {:.2f} bytes a sample\n", 1e-6 * static_cast<double>(surface.volume()->bytes()),
             static_cast<double>(surface.volume()->bytes()) / static_cast<double>(grid.count()));
}

void printCloud(const PointCloud& cloud) {
  const CloudPoints& points = *cloud.points();
  const double spacing_m = cloud.spacing();
  const auto bytes = static_cast<double>(points.bytes());
  fmt::print(
      "cloud:      {} points, about {:.4g} m apart, within {:.3g} m of those of the source; {:.1f} bytes a point\n",
      points.size(), spacing_m, cloud.error_m(), bytes / static_cast<double>(points.size()));
  if (points.hasColours()) fmt::print("            a colour for each, which the page shows\n");
  if (cloud.surfels()) {
    fmt::print("            surfels that reach {:.4g} m\n", cloud.look().reach * spacing_m);
  } else {
    fmt::print(
        "            a ball of radius r sinks by about {:.3g} m^2 / r between them; one below some {:.2g} m passes,\n"
        "            and any one where they are farther apart than 1.4 r\n",
        spacing_m * spacing_m / 4, spacing_m / std::sqrt(2));
  }
}

void printImplicit(const ImplicitSurface& surface) {
  const auto [least, most] = surface.steps();
  fmt::print("implicit:   {} smooth {} on grids of {:.3g} to {:.3g} m; about {} triangles, within {:.3g} m of it\n",
             surface.sheets(), surface.sheets() == 1 ? "surface" : "surfaces", least, most, surface.triangles(),
             surface.error_m());
}

void printSurfaces(const Snapshot& snapshot) {
  for (const Instance& instance : snapshot.instances) {
    const PrimitiveSource* source = instance.shape->source.get();
    if (const auto* field = dynamic_cast<const HeightField*>(source)) printHeights(*field);
    if (const auto* surface = dynamic_cast<const IsoSurface*>(source)) printVolume(*surface);
    if (const auto* cloud = dynamic_cast<const PointCloud*>(source)) printCloud(*cloud);
    if (const auto* implicit = dynamic_cast<const ImplicitSurface*>(source)) printImplicit(*implicit);
  }
}

// What is of a place: "point", "plane", "curve of 3 points".
std::string placeOf(const std::vector<Vec3>& points, bool plane) {
  if (plane) return "plane";
  return points.size() == 1 ? "point" : fmt::format("curve of {} points", points.size());
}

void printSnaps(const Snapshot& snapshot) {
  for (const PlacedSnap& placed : snapshot.snaps) {
    const Instance& instance = snapshot.instances[placed.instance];
    const SnapSpec& snap = (*instance.snaps)[placed.number];
    fmt::print("snap {}: {}, from {:.4g} mm to {:.4g} N{}{}\n", printable(snap.name),
               placeOf(snap.points, snap.normal.has_value()), 1e3 * snap.capture_m, snap.release_N,
               instance.body ? ", of body " : "", instance.body ? printable(instance.body->name) : "");
  }
}

void printFields(const Snapshot& snapshot) {
  for (const PlacedField& placed : snapshot.fields) {
    const Instance& instance = snapshot.instances[placed.instance];
    const FieldSpec& field = (*instance.fields)[placed.number];
    fmt::print("field {}: {} of a {}, within {:.4g} mm", printable(field.name),
               kFieldKindNames[static_cast<std::size_t>(field.kind)], placeOf(field.points, field.normal.has_value()),
               1e3 * field.reach_m);
    if (field.force_N > 0) fmt::print(", {:.4g} N", field.force_N);
    if (field.stiffness_N_m > 0) fmt::print(", {:.4g} N/m", field.stiffness_N_m);
    if (field.damping_Ns_m > 0) fmt::print(", {:.4g} N s/m", field.damping_Ns_m);
    fmt::print("{}{}\n", instance.body ? ", of body " : "", instance.body ? printable(instance.body->name) : "");
  }
}

void print(const Snapshot& snapshot) {
  Totals all;
  for (const Instance& instance : snapshot.instances) all.add(*instance.shape);
  fmt::print("name:       {}\n", printable(snapshot.name));
  printTotals(all, snapshot);
  printReading(all.reading);
  printParts(snapshot);
  printSurfaces(snapshot);
  printMaterials(snapshot);
  printBodies(snapshot);
  printSnaps(snapshot);
  printFields(snapshot);
  printJoints(snapshot);
  const std::vector<std::string> warnings = warningsOf(snapshot);
  fmt::print("warnings:   {}\n", warnings.empty() ? "none" : "");
  for (const std::string& warning : warnings) fmt::print("  {}\n", warning);
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

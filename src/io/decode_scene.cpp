#include "io/decode_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/direction.h"
#include "base/error.h"
#include "bodies/joint_check.h"
#include "io/colour_messages.h"
#include "io/decode_patches.h"
#include "scene/append_part.h"

namespace hl {

namespace {

// Of what acts along a joint's coordinate: m, rad, N, N m and what is made of them.
constexpr double kMaxAlong = 1e9;

constexpr std::uint32_t kDefaultSize = 64;

constexpr double kAnyLength = std::numeric_limits<double>::max();  // of directions
constexpr double kMaxPlace_m = 1e6;                                // of joints, snaps and fields, each coordinate
constexpr double kMinOfPlace = 1e-9, kMaxOfPlace = 1e9;            // of snaps and fields: m and N
// Far above any device: its limit of force cuts it. Stiffer springs and stronger drags would shake a hand.
constexpr double kMaxFieldForce_N = 1000, kMaxFieldStiffness_N_m = 1e6, kMaxFieldDamping_Ns_m = 100;

const google::protobuf::FieldDescriptor& fieldOf(const google::protobuf::Message& message, const char* name) {
  return *message.GetDescriptor()->FindFieldByName(name);
}

}  // namespace

Quantity quantityOf(proto::Quantity quantity) {
  if (quantity == proto::HEIGHT) return Quantity::kHeight;
  const std::string& name = proto::Quantity_Name(quantity);
  const auto named = [&](const QuantityInfo& info) { return info.name == name; };
  return std::find_if(kQuantityInfo.begin(), kQuantityInfo.end(), named)->quantity;
}

Vec2 repeatOf(const proto::Material& in) {
  const auto factor = [](bool has, double value) { return has && std::isfinite(value) ? value : 1; };
  return {factor(in.has_repeat_u(), in.repeat_u()), factor(in.has_repeat_v(), in.repeat_v())};
}

std::string pathOf(const std::string& list, int index) { return list + "[" + std::to_string(index) + "]"; }

void SceneDecoder::fail(const std::string& where, const std::string& message) const {
  fail_(where, message);
  throw Error(message);
}

double SceneDecoder::checked(double value, double least, double most, const std::string& where) const {
  if (value >= least && value <= most) return value;
  fail(where, fmt::format("{} must be between {:g} and {:g}", where, least, most));
}

std::uint32_t SceneDecoder::vertex(const Model& model, std::uint32_t index, const std::string& where) const {
  if (index < model.positions.size()) return index;
  fail(where, fmt::format("{}: there is no vertex {}: there are {}, from 0", where, index, model.positions.size()));
}

void SceneDecoder::addVertices(Model& model, const proto::Primitives& in, const std::string& where) const {
  const int count = in.vertices_size() / 3;
  if (in.vertices_size() % 3 != 0) fail(where + ".vertices", where + ".vertices must hold 3 numbers each");
  if (in.normals_size() != 0 && in.normals_size() != 3 * count)
    fail(where + ".normals", where + ".normals must hold 3 numbers for each vertex");
  if (in.texcoords_size() != 0 && in.texcoords_size() != 2 * count)
    fail(where + ".texcoords", where + ".texcoords must hold 2 numbers for each vertex");
  if (in.colours_size() != 0 && in.colours_size() != 3 * count)
    fail(where + ".colours", where + ".colours must hold 3 numbers for each vertex");
  const auto finite = [](double number) { return std::isfinite(number); };
  if (!std::all_of(in.normals().begin(), in.normals().end(), finite))
    fail(where + ".normals", where + ".normals must hold finite numbers");
  if (!std::all_of(in.texcoords().begin(), in.texcoords().end(), finite))
    fail(where + ".texcoords", where + ".texcoords must hold finite numbers");
  model.positions.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < in.vertices_size(); i += 3)
    model.positions.emplace_back(in.vertices(i), in.vertices(i + 1), in.vertices(i + 2));
  model.normals.reserve(static_cast<std::size_t>(in.normals_size() / 3));
  for (int i = 0; i < in.normals_size(); i += 3)
    model.normals.push_back(Vec3(in.normals(i), in.normals(i + 1), in.normals(i + 2)).stableNormalized());
  model.texcoords.reserve(static_cast<std::size_t>(in.texcoords_size() / 2));
  for (int i = 0; i < in.texcoords_size(); i += 2) model.texcoords.emplace_back(in.texcoords(i), in.texcoords(i + 1));
  model.appearance.vertex_colours = colours(in.colours(), where + ".colours");
}

std::vector<Rgb> SceneDecoder::colours(const google::protobuf::RepeatedField<std::uint32_t>& in,
                                       const std::string& where) const {
  try {
    return coloursIn(in);
  } catch (const Error& error) {
    fail(where, where + ": " + error.what());
  }
}

void SceneDecoder::addElements(Model& model, const proto::Primitives& in, const std::string& where) const {
  if (in.triangles_size() % 3 != 0) fail(where + ".triangles", where + ".triangles must hold 3 numbers each");
  if (in.segments_size() % 2 != 0) fail(where + ".segments", where + ".segments must hold 2 numbers each");
  const std::string triangles = where + ".triangles", segments = where + ".segments", points = where + ".points";
  std::size_t in_polygons = 0;
  for (const proto::Polygon& polygon : in.polygons())
    in_polygons += static_cast<std::size_t>(std::max(0, polygon.vertices_size() - 2));
  model.triangles.reserve(static_cast<std::size_t>(in.triangles_size() / 3) + in_polygons);
  model.segments.reserve(static_cast<std::size_t>(in.segments_size() / 2));
  model.points.reserve(static_cast<std::size_t>(in.points_size()));
  for (int i = 0; i < in.triangles_size(); i += 3)
    model.triangles.push_back({vertex(model, in.triangles(i), triangles), vertex(model, in.triangles(i + 1), triangles),
                               vertex(model, in.triangles(i + 2), triangles)});
  for (int i = 0; i < in.segments_size(); i += 2)
    model.segments.push_back({vertex(model, in.segments(i), segments), vertex(model, in.segments(i + 1), segments)});
  for (const std::uint32_t point : in.points()) model.points.push_back(vertex(model, point, points));
}

// A fan from the first vertex; the vertices keep their normals.
void SceneDecoder::addPolygons(Model& model, const proto::Primitives& in, const std::string& where) const {
  for (int p = 0; p < in.polygons_size(); ++p) {
    const auto& v = in.polygons(p).vertices();
    const auto at = [&] { return pathOf(where + ".polygons", p); };
    if (v.size() < 3) fail(at(), at() + ": a polygon needs three vertices or more");
    for (const std::uint32_t index : v) {
      if (index >= model.positions.size()) vertex(model, index, at());
    }
    for (int i = 2; i < v.size(); ++i) model.triangles.push_back({v[0], v[i - 1], v[i]});
  }
}

Model SceneDecoder::model(const proto::Primitives& in, const std::string& where) const {
  Model model;
  addVertices(model, in, where);
  addElements(model, in, where);
  addPolygons(model, in, where);
  addPatches(model, in, where);
  return model;
}

void SceneDecoder::addPatches(Model& model, const proto::Primitives& in, const std::string& where) const {
  if (in.patches_size() == 0) return;
  try {
    appendPart(model, modelOf(planOf(in)), 0);
  } catch (const Error& error) {
    fail(where + ".patches", where + ": " + error.what());
  }
  for (auto* list : {&model.triangle_materials, &model.segment_materials, &model.point_materials}) list->clear();
}

ModelCounts countsOf(const proto::Primitives& in) {
  const auto of = [](int count) { return static_cast<std::size_t>(count); };
  ModelCounts counts{.vertices = of(in.vertices_size()) / 3,
                     .normals = of(in.normals_size()) / 3,
                     .texcoords = of(in.texcoords_size()) / 2,
                     .triangles = of(in.triangles_size()) / 3,
                     .segments = of(in.segments_size()) / 2,
                     .points = of(in.points_size()),
                     .colours = of(in.colours_size()) / 3};
  for (const proto::Polygon& polygon : in.polygons()) counts.triangles += of(polygon.vertices_size());
  if (in.patches_size() == 0) return counts;
  const PatchPlan plan = planOf(in);
  counts.vertices += plan.vertices;
  counts.normals = counts.texcoords = counts.vertices;
  counts.triangles += plan.triangles;
  return counts;
}

NamedTextureUse SceneDecoder::textureUse(const proto::MaterialTexture& in, const std::string& where) const {
  if (!proto::Quantity_IsValid(in.quantity())) fail(where + ".quantity", where + ".quantity is none that HL knows");
  const bool height = in.quantity() == proto::HEIGHT;
  if (height && !in.has_high()) fail(where, where + ": a bump map needs high, its amplitude in metres");
  const double most = height ? kMaxHeight_m : kQuantityInfo[static_cast<std::size_t>(quantityOf(in.quantity()))].most;
  const double least = height ? -kMaxHeight_m : 0;
  return {in.texture(), checked(in.low(), least, most, where + ".low"),
          checked(in.has_high() ? in.high() : 1, least, most, where + ".high")};
}

SurfaceChange SceneDecoder::surface(const proto::Material& in, const std::string& where) const {
  SurfaceChange change;
  if (in.has_shade() && !proto::Shade_IsValid(in.shade()))
    fail(where + ".shade", where + ".shade must be SMOOTH or FLAT");
  if (in.has_shade()) change.smooth = in.shade() == proto::SMOOTH;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const google::protobuf::FieldDescriptor& field = fieldOf(in, kQuantityInfo[i].field);
    if (!in.GetReflection()->HasField(in, &field)) continue;
    change.*kSaidNumbers<SurfaceChange>[i] =
        checked(in.GetReflection()->GetDouble(in, &field), 0, kQuantityInfo[i].most, where + "." + field.json_name());
  }
  for (int i = 0; i < in.textures_size(); ++i) {
    const std::string at = pathOf(where + ".textures", i);
    NamedTextureUse use = textureUse(in.textures(i), at);
    auto& slot = change.textures[static_cast<std::size_t>(quantityOf(in.textures(i).quantity()))];
    if (slot) fail(at, at + ": there are two textures of one quantity");
    slot = std::move(use);
  }
  return change;
}

BodySpec SceneDecoder::body(const proto::Body& in, const std::string& where) const {
  BodySpec spec;
  spec.fixed = in.fixed();
  if (in.has_mass_kg())
    spec.mass_kg = checked(in.mass_kg(), body_limits::kMinMass_kg, body_limits::kMaxMass_kg, where + ".massKg");
  if (in.has_density_kg_m3())
    spec.density_kg_m3 = checked(in.density_kg_m3(), body_limits::kMinDensity_kg_m3, body_limits::kMaxDensity_kg_m3,
                                 where + ".densityKgM3");
  if (!proto::BodyShape_IsValid(in.shape())) fail(where + ".shape", where + ".shape is none that HL knows");
  spec.shape = static_cast<BodyShape>(in.shape());
  BodySurface& surface = spec.surface;
  if (in.has_static_friction())
    surface.static_friction = checked(in.static_friction(), 0, body_limits::kMaxFriction, where + ".staticFriction");
  if (in.has_dynamic_friction())
    surface.dynamic_friction = checked(in.dynamic_friction(), 0, body_limits::kMaxFriction, where + ".dynamicFriction");
  if (!in.has_static_friction() && in.has_dynamic_friction()) surface.static_friction = surface.dynamic_friction;
  if (!in.has_dynamic_friction() && in.has_static_friction()) surface.dynamic_friction = surface.static_friction;
  if (surface.static_friction < surface.dynamic_friction)
    fail(where + ".staticFriction", where + ".staticFriction must not be less than dynamicFriction");
  if (in.has_restitution()) surface.restitution = checked(in.restitution(), 0, 1, where + ".restitution");
  spec.velocity_m_s = checked(in.velocity_m_s(), body_limits::kMaxSpeed_m_s, where + ".velocityMS");
  spec.spin_rad_s = checked(in.spin_rad_s(), body_limits::kMaxSpin_rad_s, where + ".spinRadS");
  return spec;
}

ForceTable SceneDecoder::forceTable(const proto::ForceTable& in, const std::string& where) const {
  ForceTable table;
  if (in.position_size() != in.force_size())
    fail(where, where + ": a force table must have as many forces as positions");
  if (static_cast<std::size_t>(in.position_size()) > kMaxTableRows)
    fail(where, where + ": a force table has at most 256 rows");
  for (int i = 0; i < in.position_size(); ++i) {
    table.position.push_back(checked(in.position(i), -kMaxAlong, kMaxAlong, pathOf(where + ".position", i)));
    table.force.push_back(checked(in.force(i), -kMaxAlong, kMaxAlong, pathOf(where + ".force", i)));
    if (i > 0 && !(in.position(i) > in.position(i - 1)))
      fail(pathOf(where + ".position", i), where + ": the positions of a force table must increase");
  }
  return table;
}

JointForces SceneDecoder::jointForces(const proto::Joint& in, const std::string& where) const {
  JointForces along;
  if (in.has_low()) along.low = checked(in.low(), -kMaxAlong, kMaxAlong, where + ".low");
  if (in.has_high()) along.high = checked(in.high(), -kMaxAlong, kMaxAlong, where + ".high");
  if (along.low > along.high) fail(where + ".low", where + ".low must not be above high");
  along.rest = checked(in.rest(), -kMaxAlong, kMaxAlong, where + ".rest");
  along.spring = checked(in.spring(), 0, kMaxAlong, where + ".spring");
  along.damping = checked(in.damping(), 0, kMaxAlong, where + ".damping");
  along.friction = checked(in.friction(), 0, kMaxAlong, where + ".friction");
  along.table = forceTable(in.table(), where + ".table");
  return along;
}

JointSpec SceneDecoder::joint(const proto::Joint& in, const std::string& where) const {
  JointSpec spec;
  spec.name = in.name().empty() ? where : in.name();
  if (!proto::JointKind_IsValid(in.kind())) fail(where + ".kind", where + ".kind is none that HL knows");
  spec.kind = static_cast<JointKind>(in.kind());
  spec.anchor_W = checked(in.anchor(), kMaxPlace_m, where + ".anchor");
  spec.anchor_b_W = checked(in.anchor_b(), kMaxPlace_m, where + ".anchorB");
  if (hasAxis(spec.kind)) {
    const std::optional<Vec3> axis = unitOf(checked(in.axis(), kAnyLength, where + ".axis"));
    if (!axis) fail(where + ".axis", where + ": a hinge or slider needs an axis");
    spec.axis_W = *axis;
  }
  spec.along = jointForces(in, where);
  spec.collide = in.collide();
  return spec;
}

Vec3 SceneDecoder::unit(const proto::Vec3& in, const std::string& where) const {
  const std::optional<Vec3> unit = unitOf(checked(in, kAnyLength, where));
  if (!unit) fail(where, where + " must not be zero");
  return *unit;
}

std::vector<Vec3> SceneDecoder::corners(const google::protobuf::RepeatedField<double>& in,
                                        const std::string& where) const {
  const auto count = static_cast<std::size_t>(in.size()) / 3;
  if (in.size() % 3 != 0 || count == 0) fail(where, where + " must hold 3 numbers each, of one point or more");
  if (count > kMaxCorners) fail(where, fmt::format("{} must not be more than {}", where, kMaxCorners));
  std::vector<Vec3> points;
  for (int i = 0; i < in.size(); i += 3) {
    const auto number = [&](int k) { return checked(in[i + k], -kMaxPlace_m, kMaxPlace_m, where); };
    points.emplace_back(number(0), number(1), number(2));
  }
  const auto as_first = [&](const Vec3& point) { return point == points.front(); };
  if (points.size() > 1 && std::all_of(points.begin(), points.end(), as_first))
    fail(where, where + " of a line or curve must not all be the same: write one point once");
  return points;
}

std::optional<Vec3> SceneDecoder::planeNormal(bool given, const proto::Vec3& in, std::size_t points,
                                              const std::string& where) const {
  if (!given) return {};
  if (points != 1) fail(where + ".points", where + ".points of a plane, which has a normal, must be one point");
  return unit(in, where + ".normal");
}

SnapSpec SceneDecoder::snap(const proto::Snap& in, const std::string& where) const {
  SnapSpec snap;
  snap.name = in.name();
  snap.points = corners(in.points(), where + ".points");
  snap.normal = planeNormal(in.has_normal(), in.normal(), snap.points.size(), where);
  snap.capture_m = checked(in.capture(), kMinOfPlace, kMaxOfPlace, where + ".capture");
  snap.release_N = checked(in.release_n(), kMinOfPlace, kMaxOfPlace, where + ".releaseN");
  return snap;
}

// What a kind has nothing of must be left out.
FieldSpec SceneDecoder::field(const proto::Field& in, const std::string& where) const {
  if (!proto::FieldKind_IsValid(in.kind())) fail(where + ".kind", where + ".kind is none that HL knows");
  FieldSpec field;
  field.name = in.name();
  field.kind = static_cast<FieldKind>(in.kind());
  field.points = corners(in.points(), where + ".points");
  field.normal = planeNormal(in.has_normal(), in.normal(), field.points.size(), where);
  field.reach_m = checked(in.reach(), kMinOfPlace, kMaxOfPlace, where + ".reach");
  const auto leave_out = [&](bool given, const std::string& at) {
    if (given) fail(at, at + " is nothing that a " + proto::FieldKind_Name(in.kind()) + " has: leave it out");
  };
  const auto number = [&](bool wanted, double value, double most, const char* name) {
    if (!wanted) leave_out(value != 0, where + name);
    return wanted ? checked(value, kMinOfPlace, most, where + name) : 0;
  };
  const bool drag = field.kind == FieldKind::kDrag, spring = field.kind == FieldKind::kSpring;
  const bool unlimited = spring && in.force_n() == 0;
  field.force_N = unlimited ? kMaxFieldForce_N : number(!drag, in.force_n(), kMaxFieldForce_N, ".forceN");
  field.stiffness_N_m = number(spring, in.stiffness_n_m(), kMaxFieldStiffness_N_m, ".stiffnessNM");
  field.damping_Ns_m = number(drag, in.damping_ns_m(), kMaxFieldDamping_Ns_m, ".dampingNsM");
  const bool constant = field.kind == FieldKind::kConstant;
  if (constant) field.direction = unit(in.direction(), where + ".direction");
  leave_out(!constant && in.has_direction(), where + ".direction");
  return field;
}

FieldList SceneDecoder::fields(const google::protobuf::RepeatedPtrField<proto::Field>& in,
                               const std::string& where) const {
  if (static_cast<std::size_t>(in.size()) > kMaxFields)
    fail(where, fmt::format("{}: there are more than {}", where, kMaxFields));
  FieldList fields;
  for (int i = 0; i < in.size(); ++i) fields.push_back(field(in[i], pathOf(where, i)));
  return fields;
}

SnapList SceneDecoder::snaps(const google::protobuf::RepeatedPtrField<proto::Snap>& in,
                             const std::string& where) const {
  if (static_cast<std::size_t>(in.size()) > kMaxSnaps)
    fail(where, fmt::format("{}: there are more than {}", where, kMaxSnaps));
  SnapList snaps;
  for (int i = 0; i < in.size(); ++i) snaps.push_back(snap(in[i], pathOf(where, i)));
  return snaps;
}

Vec3 SceneDecoder::checked(const proto::Vec3& value, double most, const std::string& where) const {
  return {checked(value.x(), -most, most, where + ".x"), checked(value.y(), -most, most, where + ".y"),
          checked(value.z(), -most, most, where + ".z")};
}

void SceneDecoder::setReading(const proto::TextureImage& in, Texture& texture, const std::string& where) const {
  if (in.name().empty()) fail(where, where + ": a texture needs a name");
  if (!proto::Wrap_IsValid(in.wrap())) fail(where + ".wrap", where + ".wrap must be REPEAT or CLAMP");
  if (!proto::Filter_IsValid(in.filter())) fail(where + ".filter", where + ".filter must be BILINEAR or NEAREST");
  texture.name = in.name();
  texture.wrap = in.wrap() == proto::CLAMP ? Wrap::kClamp : Wrap::kRepeat;
  if (in.has_filter()) texture.filter = in.filter() == proto::NEAREST ? Filter::kNearest : Filter::kBilinear;
}

Texture SceneDecoder::texture(const proto::TextureImage& in, std::size_t most_texels, const std::string& where) const {
  Texture texture;
  if (in.source_case() == proto::TextureImage::kProcedural) {
    const proto::ProceduralTexture& p = in.procedural();
    const std::size_t size = p.size() == 0 ? kDefaultSize : p.size();
    if (size * size > most_texels || size > most_texels)
      fail(where,
           fmt::format("{}.procedural.size of {} is too large: there is room for {} texels", where, size, most_texels));
    const double duty = checked(p.has_duty() ? p.duty() : 0.5, 0, 1, where + ".procedural.duty");
    try {
      texture = makeTexture(p.kind(), size, duty);
    } catch (const Error& error) {
      fail(where, error.what());
    }
  } else if (in.source_case() == proto::TextureImage::kTexels) {
    const proto::Texels& t = in.texels();
    if (t.width() == 0 || t.height() == 0 || std::uint64_t{t.width()} * t.height() != t.values().size())
      fail(where + ".texels", where + ".texels must hold width x height bytes, at least one");
    if (t.values().size() > most_texels)
      fail(where + ".texels", fmt::format("{}.texels are too many: there is room for {}", where, most_texels));
    texture.width = t.width();
    texture.height = t.height();
    texture.texels.reserve(t.values().size());
    for (const char byte : t.values())
      texture.texels.push_back(static_cast<float>(static_cast<unsigned char>(byte)) / 255.0f);
  } else {
    fail(where, where + ": a texture needs a procedural or texels; a client's cannot be a file");
  }
  setReading(in, texture, where);
  return texture;
}

}  // namespace hl

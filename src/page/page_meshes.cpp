#include "page/page_meshes.h"

#include <hl.pb.h>

#include <algorithm>
#include <chrono>
#include <exception>

#include "base/error.h"
#include "base/guarded_thread.h"
#include "page/wire_bytes.h"
#include "scene/append_part.h"
#include "session/state_messages.h"
#include "surfaces/point_cloud.h"

namespace hl {

namespace {

constexpr std::uint64_t kSmallest = 1024;  // of a mesh and its message beside its lists
// Three corners with normals, and three indices.
constexpr std::uint64_t kDrawnTriangle_bytes = 6 * 3 * sizeof(float) + 3 * sizeof(std::uint32_t);
constexpr std::uint64_t kDrawnTexcoords_bytes = 2 * 3 * sizeof(float), kDrawnColours_bytes = 3 * sizeof(Rgb);

std::uint64_t texelsOf(const Look& look) {
  std::uint64_t texels = 0;
  for (const auto& texture : look) texels += texture ? texture->texels.size() : 0;
  return texels;
}

std::uint64_t messageBytes(const Model& model, const Look& look) {
  const std::uint64_t bytes =
      kSmallest + 3 * sizeof(float) * (model.positions.size() + model.normals.size()) +
      2 * sizeof(float) * model.texcoords.size() +
      sizeof(std::uint32_t) * (3 * model.triangles.size() + 2 * model.segments.size() + model.points.size()) +
      sizeof(std::uint16_t) * model.triangle_materials.size();
  std::uint64_t shown = model.appearance.empty() ? 0 : sizeof(Rgb) * model.positions.size();
  for (const Picture& picture : model.appearance.pictures) shown += picture.file->size();
  return bytes + texelsOf(look) + shown;
}

// Of a surface that is no mesh a page draws so many triangles, or a few more: it is felt exactly, and drawn as finely
// as a screen shows.
constexpr std::size_t kMaxDrawn = 1'000'000;
// One that changes at once, perhaps again and again, must be drawn soon.
constexpr std::size_t kMaxDrawnSoon = 100'000;

ColouredModel drawnOf(const Shape& shape, std::size_t most) {
  if (!shape.source) return colouredModel(shape.model);
  DrawnMesh drawn = shape.source->drawn(most);
  ColouredModel result{Model{}, std::move(drawn.colours)};
  Model& model = *result.model;
  model.positions = std::move(drawn.positions);
  model.normals = std::move(drawn.normals);
  model.texcoords = std::move(drawn.texcoords);
  model.triangles = std::move(drawn.triangles);
  repeatTexcoords(model, shape.repeat);
  if (shape.model.appearance.paints.empty()) return result;
  model.appearance = shape.model.appearance;
  model.appearance.triangle_paints.assign(model.triangles.size(), 0);
  result.colours = colouredModel(model).colours;
  return result;
}

// In full.
std::uint64_t drawnTriangles(const Shape& shape) {
  constexpr std::uint64_t kOfPoint = 4;
  return shape.elements() * (shape.source->kind() == PrimitiveKind::kPoint ? kOfPoint : 1);
}

std::uint64_t messageBytes(const Shape& shape, const Look& look, std::size_t most_drawn) {
  if (!shape.source) return messageBytes(shape.model, look);
  const std::uint64_t drawn = drawnTriangles(shape);
  const std::uint64_t each = kDrawnTriangle_bytes + (look.empty() ? 0 : kDrawnTexcoords_bytes) +
                             (shape.source->hasColours() ? kDrawnColours_bytes : 0);
  return kSmallest + each * std::min<std::uint64_t>(drawn, most_drawn) + texelsOf(look) +
         shape.model.appearance.bytes();
}

std::string meshMessage(std::uint32_t number, const Shape& shape, const ColouredModel& drawn, const Look& look) {
  const Model& model = drawn.model ? *drawn.model : shape.model;
  proto::ServerMessage message;
  proto::SceneMesh& out = *message.mutable_mesh();
  out.set_number(number);
  out.set_positions(floatsOf(model.positions));
  out.set_normals(floatsOf(model.normals));
  out.set_triangles(bytesOf(model.triangles));
  out.set_colours(bytesOf(drawn.colours));
  out.set_segments(bytesOf(model.segments));
  out.set_points(bytesOf(model.points));
  if (const auto* cloud = dynamic_cast<const PointCloud*>(shape.source.get()); cloud != nullptr)
    out.set_cloud_points(cloud->points()->size());
  if (!shape.bounds.empty()) {
    toProto(shape.bounds.min, *out.mutable_bounds_min());
    toProto(shape.bounds.max, *out.mutable_bounds_max());
  }
  addSurfaceImages(model, look, out);
  out.set_triangle_materials(bytesOf(model.triangle_materials));
  return message.SerializeAsString();
}

std::string emptyMessage(std::uint32_t number) {
  proto::ServerMessage message;
  message.mutable_mesh()->set_number(number);
  return message.SerializeAsString();
}

}  // namespace

PageMeshes::Made PageMeshes::make(std::uint32_t number, const Mesh& mesh) const {
  if (mesh.replaced && !mesh.refined) return make(number, mesh, kMaxDrawnSoon);
  Made made = make(number, mesh, kMaxDrawn);
  return mesh.refined && !made.lacking.empty() ? make(number, mesh, kMaxDrawnSoon) : made;
}

PageMeshes::Made PageMeshes::make(std::uint32_t number, const Mesh& mesh, std::size_t most_drawn) const {
  try {
    const Shape& shape = *mesh.shape;
    const Look& look = mesh.look;
    const std::uint64_t bytes = messageBytes(shape, look, most_drawn);
    if (bytes > most_bytes_)
      throw Error("it would take " + std::to_string(bytes / 1'000'000) + " MB, and a page is sent " +
                  std::to_string(most_bytes_ / 1'000'000) + " MB at most: show it in several objects");
    MemoryShare memory(memory_);
    memory.take(2 * bytes);  // the message is put together and then written
    const ColouredModel drawn = drawnOf(shape, most_drawn);
    auto message = std::make_shared<const std::string>(meshMessage(number, shape, drawn, look));
    memory.set(kSmallest + message->capacity());
    return {number, withShare(std::move(message), std::move(memory)), {}};
  } catch (const std::exception& error) {
    return {number, std::make_shared<const std::string>(emptyMessage(number)),
            std::string("a mesh can be touched but is not shown: ") + error.what()};
  }
}

std::string PageMeshes::lacking() const {
  for (const auto& [number, mesh] : meshes_) {
    if (!mesh.lacking.empty()) return mesh.lacking;
  }
  return {};
}

// What is drawn coarsely and has been the same for a while is another mesh from now on.
std::uint32_t PageMeshes::numberOf(const Instance& instance, std::int64_t now_ns) {
  Look look = lookOf(*instance.shape, *instance.surfaces);
  Identity identity{instance.shape->geometry, {}};
  for (const auto& texture : look) identity.second.push_back(texture.get());
  const auto known = numbers_.find(identity);
  const bool is_known = known != numbers_.end();
  if (is_known && !meshes_.at(known->second).dueAt(now_ns)) return known->second;
  const Shape& shape = *instance.shape;
  const bool replaced = instance.replaced_in > 0 && shape.source && drawnTriangles(shape) > kMaxDrawnSoon;
  meshes_[last_number_ + 1] = {instance.shape, std::move(look), replaced, is_known, now_ns};
  numbers_[std::move(identity)] = last_number_ + 1;  // last: a number has its mesh, whatever fails
  return ++last_number_;
}

bool PageMeshes::refines(std::int64_t now_ns) const {
  return std::any_of(numbers_.begin(), numbers_.end(),
                     [&](const auto& entry) { return meshes_.at(entry.second).dueAt(now_ns); });
}

std::vector<std::uint32_t> PageMeshes::numbersOf(const Snapshot& snapshot, std::int64_t now_ns) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(snapshot.instances.size());
  for (const Instance& instance : snapshot.instances) numbers.push_back(numberOf(instance, now_ns));
  return numbers;
}

// What failed as a whole is made again.
void PageMeshes::takeMade() {
  if (!making_.valid() || making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  guarded([this] {
    for (Made& made : making_.get()) {
      const auto mesh = meshes_.find(made.number);
      if (mesh == meshes_.end()) continue;
      mesh->second.message = std::move(made.message);
      mesh->second.lacking = std::move(made.lacking);
      mesh->second.shape.reset();
    }
  });
}

bool PageMeshes::ready() {
  takeMade();
  std::vector<std::pair<std::uint32_t, Mesh>> lacking;
  for (const auto& [number, mesh] : meshes_) {
    if (!mesh.message) lacking.emplace_back(number, mesh);
  }
  if (lacking.empty()) return true;
  if (making_.valid()) return false;
  try {
    making_ = std::async(std::launch::async, [this, lacking = std::move(lacking)] {
      nameThread("page meshes");
      std::vector<Made> made;
      for (const auto& [number, mesh] : lacking) made.push_back(make(number, mesh));
      return made;
    });
  } catch (const std::exception&) {  // no thread now: there may be one at the next state
  }
  return false;
}

void PageMeshes::keep(const std::set<std::uint32_t>& numbers) {
  std::erase_if(numbers_, [&](const auto& entry) { return !numbers.contains(entry.second); });
  std::erase_if(meshes_, [&](const auto& entry) { return !numbers.contains(entry.first); });
}

}  // namespace hl

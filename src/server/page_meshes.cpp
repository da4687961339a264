#include "server/page_meshes.h"

#include <hl.pb.h>

#include <chrono>

#include "server/feed_messages.h"
#include "server/wire_bytes.h"

namespace hl {

namespace {

PageMessage meshMessage(std::uint32_t number, const Shape& shape, const Look& look) {
  const Model& model = shape.model;
  proto::ServerMessage message;
  proto::SceneMesh& out = *message.mutable_mesh();
  out.set_number(number);
  out.set_positions(floatsOf(model.positions));
  out.set_normals(floatsOf(model.normals));
  out.set_triangles(bytesOf(model.triangles));
  out.set_segments(bytesOf(model.segments));
  out.set_points(bytesOf(model.points));
  if (!shape.bounds.empty()) {
    toProto(shape.bounds.min, *out.mutable_bounds_min());
    toProto(shape.bounds.max, *out.mutable_bounds_max());
  }
  addSurfaceImages(model, look, out);
  return std::make_shared<const std::string>(message.SerializeAsString());
}

}  // namespace

std::uint32_t PageMeshes::numberOf(const Instance& instance) {
  Look look = lookOf(*instance.shape, *instance.surfaces);
  Identity identity{instance.shape->geometry, {}};
  for (const auto& texture : look) identity.second.push_back(texture.get());
  const auto [known, fresh] = numbers_.try_emplace(std::move(identity), last_number_ + 1);
  if (fresh) meshes_[++last_number_] = {instance.shape, std::move(look), nullptr};
  return known->second;
}

std::vector<std::uint32_t> PageMeshes::numbersOf(const Snapshot& snapshot) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(snapshot.instances.size());
  for (const Instance& instance : snapshot.instances) numbers.push_back(numberOf(instance));
  return numbers;
}

void PageMeshes::takeMade() {
  if (!making_.valid() || making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  for (auto& [number, message] : making_.get()) {
    const auto mesh = meshes_.find(number);
    if (mesh == meshes_.end()) continue;
    mesh->second.message = std::move(message);
    mesh->second.shape.reset();
  }
}

bool PageMeshes::ready() {
  takeMade();
  std::vector<std::pair<std::uint32_t, Mesh>> lacking;
  for (const auto& [number, mesh] : meshes_) {
    if (!mesh.message) lacking.emplace_back(number, mesh);
  }
  if (lacking.empty()) return true;
  if (making_.valid()) return false;
  making_ = std::async(std::launch::async, [lacking = std::move(lacking)] {
    Made made;
    for (const auto& [number, mesh] : lacking) made.emplace_back(number, meshMessage(number, *mesh.shape, mesh.look));
    return made;
  });
  return false;
}

void PageMeshes::keep(const std::set<std::uint32_t>& numbers) {
  std::erase_if(numbers_, [&](const auto& entry) { return !numbers.contains(entry.second); });
  std::erase_if(meshes_, [&](const auto& entry) { return !numbers.contains(entry.first); });
}

}  // namespace hl

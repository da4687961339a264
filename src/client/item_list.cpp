#include "client/item_list.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "client/fault.h"

namespace hl::client {

bool ItemList::draw(const Matrix4& matrix, const Look& look, HLenum mode, Vertices& vertices, DrawOrder order) {
  if (order.empty()) vertices.shorten(wholeVertices(mode, vertices.size()));
  if (vertices.size() == 0) {
    vertices.clear();
    return false;
  }
  if (vertices.size() > std::numeric_limits<std::uint32_t>::max())
    throw Fault(HL_OUT_OF_MEMORY, "more vertices than indices can count; split them");
  const auto joins = [&](const Item& last) {
    return last.call == 0 && last.geometry.patches.empty() && last.geometry.takes(vertices) && last.matrix == matrix &&
           last.look == look;
  };
  if (!items_.empty() && joins(items_.back())) {
    appendPrimitives(items_.back().geometry, mode, vertices, order);
    return true;
  }
  Item item{matrix, look, 0, {}};
  appendPrimitives(item.geometry, mode, vertices, order);
  items_.push_back(std::move(item));
  return true;
}

void ItemList::drawHeights(const Matrix4& matrix, const Look& look, proto::Heights heights,
                           const std::array<double, 2>& repeat) {
  items_.push_back({matrix, look, 0, {}});
  items_.back().geometry.heights = std::move(heights);
  items_.back().geometry.repeat = repeat;
}

void ItemList::drawCloud(const Matrix4& matrix, const Look& look, std::shared_ptr<proto::Cloud> cloud) {
  items_.push_back({matrix, look, 0, {}});
  items_.back().geometry.cloud = std::move(cloud);
}

void ItemList::drawVolume(const Matrix4& matrix, const Look& look, std::shared_ptr<const proto::Volume> volume,
                          double iso, bool below) {
  items_.push_back({matrix, look, 0, {}});
  items_.back().geometry.volume = std::move(volume);
  items_.back().geometry.iso = iso;
  items_.back().geometry.below = below;
}

void ItemList::drawPatch(const Matrix4& matrix, const Look& look, proto::Patch patch, double error_m) {
  const auto joins = [&](const Item& last) {
    return !last.geometry.patches.empty() && last.geometry.patch_error == error_m && last.matrix == matrix &&
           last.look == look;
  };
  if (!items_.empty() && joins(items_.back())) {
    items_.back().geometry.patches.push_back(std::move(patch));
    return;
  }
  Item item{matrix, look, 0, {}};
  item.geometry.patch_error = error_m;
  item.geometry.patches.push_back(std::move(patch));
  items_.push_back(std::move(item));
}

void ItemList::drawImplicit(const Matrix4& matrix, const Look& look, std::shared_ptr<const proto::Implicit> implicit) {
  items_.push_back({matrix, look, 0, {}});
  items_.back().geometry.implicit = std::move(implicit);
}

proto::Cloud* ItemList::lastCloud() {
  const auto last = std::find_if(items_.rbegin(), items_.rend(), [](const Item& item) { return item.geometry.cloud; });
  return last == items_.rend() ? nullptr : last->geometry.cloud.get();
}

std::shared_ptr<const proto::Volume> ItemList::lastVolume() const {
  const auto last = std::find_if(items_.rbegin(), items_.rend(), [](const Item& item) { return item.geometry.volume; });
  return last == items_.rend() ? nullptr : last->geometry.volume;
}

void ItemList::call(const Matrix4& matrix, const Look& look, HLuint object) {
  items_.push_back({matrix, look, object, {}});
}

Uses ItemList::uses() const {
  Uses uses;
  for (const Item& item : items_) {
    if (item.call != 0) uses.objects.insert(item.call);
    for (const TextureUse& use : item.look.textures) uses.textures.insert(use.texture);
  }
  return uses;
}

std::vector<ItemVertices> ItemList::vertices() const {
  std::vector<ItemVertices> all;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const Vertices& v = items_[i].geometry.vertices;
    if (v.size() > 0) all.push_back({static_cast<std::uint32_t>(i), v.size(), !v.normals.empty()});
  }
  return all;
}

std::vector<std::uint32_t> ItemList::volumes() const {
  std::vector<std::uint32_t> all;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (items_[i].geometry.volume) all.push_back(static_cast<std::uint32_t>(i));
  }
  return all;
}

}  // namespace hl::client

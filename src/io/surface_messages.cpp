#include "io/surface_messages.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/machine_memory.h"
#include "io/decode_implicit.h"

namespace hl {

namespace {

constexpr const char* kBrokenSurface = "a surface in it makes no sense: its parts do not belong together";

// What a later surface shares with the one of this number.
template <typename Shared>
Shared sharedWith(const std::map<std::uint64_t, Shared>& known, std::uint64_t id) {
  const auto found = known.find(id);
  if (found == known.end()) throw Error(kBrokenSurface);
  return found->second;
}

}  // namespace

Vec2 repeatIn(const google::protobuf::RepeatedField<double>& factors) {
  if (factors.empty()) return Vec2::Ones();
  if (factors.size() != 2 || !std::isfinite(factors[0]) || !std::isfinite(factors[1])) throw Error(kBrokenSurface);
  return {factors[0], factors[1]};
}

void writeRepeat(const Vec2& repeat, google::protobuf::RepeatedField<double>& factors) {
  if (repeat != Vec2::Ones()) factors.Add(repeat.begin(), repeat.end());
}

void SurfaceWriter::write(const PrimitiveSource& source, std::uint64_t id, SurfaceParts& out) {
  const auto take = [&](auto& part) {
    part.set_id(id);
    out.take(part);
  };
  if (const auto* const field = dynamic_cast<const HeightField*>(&source)) return writeHeights(*field, take);
  if (const auto* const frame = dynamic_cast<const DepthFrame*>(&source)) return writeDepths(*frame, take);
  if (const auto* const cloud = dynamic_cast<const PointCloud*>(&source)) {
    const auto [first, is_new] = clouds_.try_emplace(cloud->points().get(), First<CloudPoints>{cloud->points(), id});
    return writeCloud(*cloud, is_new ? 0 : first->second.id, take);
  }
  if (const auto* const implicit = dynamic_cast<const ImplicitSurface*>(&source)) {
    proto::RecordedImplicit part;
    toProto(*implicit, part);
    return take(part);
  }
  const auto* const surface = dynamic_cast<const IsoSurface*>(&source);
  if (surface == nullptr) throw Error("a surface of a kind that is not known cannot be written down");
  const auto [first, is_new] = volumes_.try_emplace(surface->volume().get(), First<Volume>{surface->volume(), id});
  writeVolume(*surface, is_new ? 0 : first->second.id, take);
}

std::size_t SurfaceReader::mostBytes() const { return std::min(left_, machineMemory_bytes()); }

// True for the first part of a surface.
bool SurfaceReader::begin(std::uint64_t id) {
  if (begun_ && *begun_ != id) throw Error(kBrokenSurface);
  return !std::exchange(begun_, id).has_value();
}

SurfaceReader::Source SurfaceReader::finish(Source source, bool shares) {
  begun_.reset();
  heights_.reset();
  volume_.reset();
  cloud_.reset();
  if (!shares) left_ -= std::min(left_, source->bytes() + source->shared().bytes);
  return source;
}

SurfaceReader::Source SurfaceReader::add(const proto::RecordedHeights& part) {
  if (begin(part.id())) heights_.emplace(headerOf(part), mostBytes());
  if (!heights_) throw Error(kBrokenSurface);
  heights_->add(part.samples().data(), part.samples().size());
  return part.continues() ? nullptr : finish(heights_->take(), false);
}

SurfaceReader::Source SurfaceReader::add(const proto::RecordedVolume& part) {
  const bool shares = part.like() != 0;
  if (begin(part.id())) {
    volume_surface_ = {frameOf(part), isoOf(part), matterOf(part)};
    if (!shares) volume_.emplace(headerOf(part), mostBytes());
  }
  if (!shares) {
    if (!volume_) throw Error(kBrokenSurface);
    volume_->add(part.samples().data(), part.samples().size());
    if (part.continues()) return nullptr;
  }
  const std::shared_ptr<const Volume> volume = shares ? sharedWith(volumes_, part.like()) : volume_->take();
  volumes_[part.id()] = volume;
  const auto& [frame, iso, matter] = volume_surface_;
  return finish(std::make_shared<const IsoSurface>(volume, frame, iso, matter), shares);
}

SurfaceReader::Source SurfaceReader::add(const proto::RecordedCloud& part) {
  const bool shares = part.like() != 0;
  if (begin(part.id())) {
    cloud_look_ = {frameOf(part), lookOf(part)};
    if (!shares) cloud_.emplace(part, mostBytes(), true);
  }
  if (!shares) {
    if (!cloud_) throw Error(kBrokenSurface);
    cloud_->add(part);
    if (part.continues()) return nullptr;
  }
  const std::shared_ptr<const CloudPoints> points = shares ? sharedWith(clouds_, part.like()) : cloud_->take();
  clouds_[part.id()] = points;
  return finish(std::make_shared<const PointCloud>(points, cloud_look_.first, cloud_look_.second), shares);
}

SurfaceReader::Source SurfaceReader::add(const proto::RecordedImplicit& part) {
  if (begun_) throw Error(kBrokenSurface);
  return implicitOf(part);
}

}  // namespace hl

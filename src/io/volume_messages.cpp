#include "io/volume_messages.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.h"
#include "io/sample_parts.h"
#include "io/value_messages.h"

namespace hl {

namespace {

// At most 2^60 samples, as no side has more than 2^20.
std::size_t bytesOf(const VolumeHeader& header) {
  std::size_t bytes = sizeOf(header.kind);
  for (const std::uint32_t side : header.side) bytes *= side;
  return bytes;
}

void toProto(const IsoValue& iso, proto::RecordedVolume& out) {
  out.set_iso(iso.value);
  out.set_below(iso.solid == SolidSide::kBelow);
}

SampleRoom roomFor(const VolumeHeader& header, std::size_t most_bytes) {
  checkVoxelSides(header.side);
  const std::size_t bytes = bytesOf(header);
  if (bytes > most_bytes)
    throw Error(fmt::format("a volume of {} x {} x {} samples takes {:.1f} GB of memory, and there are {:.1f} GB",
                            header.side[0], header.side[1], header.side[2], 1e-9 * static_cast<double>(bytes),
                            1e-9 * static_cast<double>(most_bytes)));
  return SampleRoom(bytes);
}

}  // namespace

void toProto(const VolumeHeader& header, proto::RecordedVolume& out) {
  for (const std::uint32_t side : header.side) out.add_side(side);
  out.set_kind(static_cast<std::uint32_t>(header.kind));
  if (header.missing) out.set_missing(*header.missing);
  out.set_scale(header.values.scale);
  out.set_offset(header.values.offset);
  for (const double value : header.frame.axes.reshaped()) out.add_axes(value);
  for (const double value : header.frame.origin) out.add_origin(value);
  if (header.iso) toProto(*header.iso, out);
}

GridFrame frameOf(const proto::RecordedVolume& in) {
  if (in.axes_size() != 9 || in.origin_size() != 3) throw Error("a volume in it makes no sense");
  GridFrame frame;
  std::copy(in.axes().begin(), in.axes().end(), frame.axes.data());
  std::copy(in.origin().begin(), in.origin().end(), frame.origin.data());
  return frame;
}

VolumeHeader headerOf(const proto::RecordedVolume& in) {
  if (in.kind() > static_cast<std::uint32_t>(SampleKind::kFloat32) || in.side_size() != 3)
    throw Error("a volume in it makes no sense");
  VolumeHeader header;
  std::copy(in.side().begin(), in.side().end(), header.side.begin());
  header.kind = static_cast<SampleKind>(in.kind());
  if (in.has_missing()) header.missing = in.missing();
  header.values = {in.scale(), in.offset()};
  header.frame = frameOf(in);
  if (in.has_iso()) header.iso = isoOf(in);
  return header;
}

IsoValue isoOf(const proto::RecordedVolume& in) {
  return {in.iso(), in.below() ? SolidSide::kBelow : SolidSide::kAbove};
}

std::shared_ptr<const MatterTable> matterOf(const proto::RecordedVolume& in) {
  if (in.matter().empty()) return nullptr;
  std::vector<MatterRow> rows(static_cast<std::size_t>(in.matter_size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    readValues(in.matter(static_cast<int>(i)), "the matter of a volume", rows[i]);
  return std::make_shared<const MatterTable>(std::move(rows));
}

void writeVolume(const IsoSurface& surface, std::uint64_t like,
                 const std::function<void(proto::RecordedVolume& part)>& take) {
  const VoxelGrid& grid = surface.volume()->grid;
  proto::RecordedVolume part;
  toProto({{grid.side(0), grid.side(1), grid.side(2)},
           grid.samples().kind(),
           grid.samples().missing(),
           grid.values(),
           surface.frame(),
           surface.iso()},
          part);
  if (surface.matter()) {
    for (const MatterRow& row : surface.matter()->rows()) toProto(valuesOf(row), *part.add_matter());
  }
  part.set_like(like);
  if (like != 0) return take(part);
  takeInParts(std::move(part), grid.samples().data(), grid.count() * sizeOf(grid.samples().kind()), take);
}

VolumeCollector::VolumeCollector(const VolumeHeader& header, std::size_t most_bytes)
    : header_(header), room_(roomFor(header, most_bytes)) {}

std::shared_ptr<const Volume> VolumeCollector::take() {
  return std::make_shared<const Volume>(
      VoxelGrid(header_.side, Samples(header_.kind, room_.take(), header_.missing), header_.values));
}

}  // namespace hl

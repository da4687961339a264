#include "io/height_messages.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "io/sample_parts.h"

namespace hl {

namespace {

SampleRoom samplesOf(const GridSize& size, std::size_t most_bytes) {
  checkGridSize(size);
  if (size.bytes() > most_bytes)
    throw Error(fmt::format("a height field of {} x {} samples takes {:.1f} GB of memory, and there are {:.1f} GB",
                            size.columns, size.rows, 1e-9 * static_cast<double>(size.bytes()),
                            1e-9 * static_cast<double>(most_bytes)));
  return SampleRoom(size.bytes());
}

}  // namespace

void toProto(const HeightHeader& header, proto::RecordedHeights& out) {
  out.set_columns(header.size.columns);
  out.set_rows(header.size.rows);
  out.set_kind(static_cast<std::uint32_t>(header.size.kind));
  if (header.missing) out.set_missing(*header.missing);
  for (const double value : header.frame.axes.reshaped()) out.add_axes(value);
  for (const double value : header.frame.origin) out.add_origin(value);
  if (!header.camera) return;
  const DepthCamera& camera = *header.camera;
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy, camera.join}) out.add_camera(value);
}

HeightHeader headerOf(const proto::RecordedHeights& in) {
  if (in.kind() > static_cast<std::uint32_t>(SampleKind::kFloat32) || in.axes_size() != 9 || in.origin_size() != 3)
    throw Error("a height field in it makes no sense");
  HeightHeader header;
  header.size = {in.columns(), in.rows(), static_cast<SampleKind>(in.kind())};
  if (in.has_missing()) header.missing = in.missing();
  std::copy(in.axes().begin(), in.axes().end(), header.frame.axes.data());
  std::copy(in.origin().begin(), in.origin().end(), header.frame.origin.data());
  if (in.camera_size() == 0) return header;
  if (in.camera_size() != 5) throw Error("a depth image in it makes no sense");
  header.camera = {in.camera(0), in.camera(1), in.camera(2), in.camera(3), in.camera(4)};
  checkCamera(*header.camera);
  return header;
}

void writeHeights(const HeightField& field, const std::function<void(proto::RecordedHeights& part)>& take) {
  const HeightGrid& grid = field.grid();
  proto::RecordedHeights part;
  toProto(HeightHeader{grid.size(), grid.missing(), field.frame(), {}}, part);
  takeInParts(std::move(part), grid.samples(), grid.size().bytes(), take);
}

void writeDepths(const DepthFrame& frame, const std::function<void(proto::RecordedHeights& part)>& take) {
  const DepthPixels& pixels = frame.image().pixels;
  const GridSize size{pixels.columns(), pixels.rows(), SampleKind::kFloat32};
  proto::RecordedHeights part;
  toProto(HeightHeader{size, {}, frame.frame(), frame.image().camera}, part);
  takeInParts(std::move(part), pixels.all(), pixels.bytes(), take);
}

HeightCollector::HeightCollector(const HeightHeader& header, std::size_t most_bytes)
    : header_(header), samples_(samplesOf(header.size, most_bytes)) {}

std::shared_ptr<const PrimitiveSource> HeightCollector::take() {
  const auto grid = std::make_shared<const HeightGrid>(header_.size, samples_.take(), header_.missing);
  if (header_.camera)
    return std::make_shared<const DepthFrame>(smoothed(*grid, 1, *header_.camera, nullptr, 0), header_.frame);
  auto field = std::make_shared<const HeightField>(grid, header_.frame);
  requireTriangles(*field);
  return field;
}

}  // namespace hl

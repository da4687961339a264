#include "io/decode_volumes.h"

#include <fmt/core.h>

#include <array>
#include <utility>
#include <vector>

#include "base/error.h"
#include "io/decode_samples.h"
#include "surfaces/threshold.h"

namespace hl {

namespace {

using Sides = std::array<std::uint32_t, 3>;

Sides sidesOf(const proto::Volume& in) {
  if (in.size_size() != 3) throw Error("size must be three numbers of samples: along x, y and z");
  const Sides side{in.size(0), in.size(1), in.size(2)};
  checkVoxelSides(side);
  return side;
}

// Along each axis; `otherwise` where nothing is said.
Vec3 stepsOf(const proto::Volume& in, const Vec3& otherwise) {
  const int count = in.spacing_size();
  if (count == 0) return otherwise;
  if (count != 1 && count != 3) throw Error("spacing must be one length or three: along x, y and z");
  Vec3 spacing;
  for (int axis = 0; axis < 3; ++axis)
    spacing[axis] = lengthOf(in.spacing(count == 1 ? 0 : axis), otherwise[axis], "spacing");
  return spacing;
}

// With the middle of the grid at the origin.
GridFrame centred(const Sides& side, const Mat3& axes) {
  return {axes, -0.5 * (axes * Vec3(side[0] - 1.0, side[1] - 1.0, side[2] - 1.0))};
}

template <typename Message>
IsoChoice choiceOf(bool has_value, double value, const Message& in) {
  IsoChoice choice;
  if (has_value) choice.value = value;
  if (in.has_below()) choice.solid = in.below() ? SolidSide::kBelow : SolidSide::kAbove;
  return choice;
}

}  // namespace

GridFrame uprightFrame(const Sides& side, const Vec3& spacing) { return centred(side, spacing.asDiagonal()); }

std::uint64_t bytesToMakeVolume(const proto::Volume& in) {
  constexpr std::uint64_t kSmallest = 8192;
  const std::uint64_t bytes = bytesOfSamples(in);
  // The pyramid takes a 16th of 16-bit samples, and of the thinnest grids, with the slices of its bricks, 7 / 12.
  return kSmallest + bytes + bytes / 8 * 5;
}

PlacedVolume decodeVolume(const proto::Volume& in) {
  if (!in.file().empty() || !in.builtin().empty()) throw Error("a file of a volume is named in scene files only");
  if (!in.grid().empty()) throw Error("grid is that of a file");
  const Sides side = sidesOf(in);
  const SampleKind kind = kindOf(in);
  std::uint64_t bytes = sizeOf(kind);
  for (const std::uint32_t samples : side) bytes *= samples;  // below 2^63
  const GridFrame frame = uprightFrame(side, stepsOf(in, Vec3::Ones()));
  const std::optional<double> missing = missingOf(in);
  const ValueScale values{in.scale() == 0 ? 1 : in.scale(), in.offset()};
  return {std::make_shared<const Volume>(VoxelGrid(side, Samples(kind, samplesOf(in, bytes), missing), values)), frame};
}

PlacedVolume withSpacing(PlacedVolume volume, const proto::Volume& in) {
  if (in.size_size() != 0 || in.values_size() != 0 || in.samples_size() != 0 || !in.kind().empty() ||
      in.has_missing() || in.scale() != 0 || in.offset() != 0)
    throw Error("size, values, samples, kind, missing, scale and offset are those of its file");
  if (in.spacing_size() == 0) return volume;
  const VoxelGrid& grid = volume.volume->grid;
  const Vec3 before = volume.frame.axes.colwise().norm();
  const Mat3 axes = volume.frame.axes * stepsOf(in, before).cwiseQuotient(before).asDiagonal();
  volume.frame = centred({grid.side(0), grid.side(1), grid.side(2)}, axes);
  return volume;
}

std::shared_ptr<const MatterTable> matterOf(const proto::Volume& in) {
  if (in.matter().empty()) return nullptr;
  std::vector<MatterRow> rows;
  for (const proto::Matter& row : in.matter()) {
    MatterRow& out = rows.emplace_back();
    out.value = row.value();
    if (row.has_stiffness()) out.stiffness = row.stiffness();
    if (row.has_strength_n()) out.strength_N = row.strength_n();
    out.force = {row.resistance_n(), row.drag_ns_m()};
  }
  return std::make_shared<const MatterTable>(std::move(rows));
}

IsoChoice isoChoiceOf(const proto::Volume& in) { return choiceOf(in.has_iso(), in.iso(), in); }
IsoChoice isoChoiceOf(const proto::Item& in) { return choiceOf(in.has_iso(), in.iso(), in); }
IsoChoice isoChoiceOf(const proto::IsoChange& in) { return choiceOf(true, in.value(), in); }
IsoChoice isoChoiceOf(const proto::IsoUpdate& in) { return choiceOf(true, in.value(), in); }

std::shared_ptr<const IsoSurface> isoSurfaceOf(const PlacedVolume& volume, const IsoChoice& iso,
                                               std::shared_ptr<const MatterTable> matter) {
  requireValues(*volume.volume);
  const auto found = [&] { return IsoValue{iso.value ? 0 : thresholdOf(*volume.volume)}; };
  const IsoValue value = iso.over(volume.iso ? *volume.iso : found());
  auto surface = std::make_shared<const IsoSurface>(volume.volume, volume.frame, value, std::move(matter));
  // A volume of one value is no mistake of who has not chosen the iso value: it comes with a warning.
  const ValueRange& range = volume.volume->pyramid.range();
  const bool one_value = range.low == range.high && value.value == range.low;
  if (iso.value || !one_value) requireSurface(*surface);
  return surface;
}

}  // namespace hl

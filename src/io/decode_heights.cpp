#include "io/decode_heights.h"

#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "io/read_heights.h"
#include "surfaces/sample_room.h"

namespace hl {

namespace {

SampleKind kindOf(const proto::Heights& in) {
  if (in.kind().empty()) return SampleKind::kFloat32;
  for (const SampleKind kind : {SampleKind::kInt16, SampleKind::kUint16, SampleKind::kFloat32}) {
    if (in.kind() == nameOf(kind)) return kind;
  }
  throw Error("kind must be int16, uint16 or float32");
}

// What is left out reads as 0.
double lengthOf(double given, double otherwise, const char* name) {
  constexpr double kLeast = 1e-12, kMost = 1e9;
  if (given == 0) return otherwise;
  if (!(given >= kLeast && given <= kMost)) throw Error(std::string(name) + " must be from 1e-12 to 1e9");
  return given;
}

struct Spacing {
  double columns, rows, up;
};

Spacing spacingOf(const proto::Heights& in) {
  const double columns = lengthOf(in.spacing(), 1, "spacing");
  return {columns, lengthOf(in.spacing_rows(), columns, "spacingRows"),
          lengthOf(in.vertical_scale(), 1, "verticalScale")};
}

SampleRoom samplesOf(const proto::Heights& in) {
  SampleRoom samples(GridSize{in.columns(), in.rows(), kindOf(in)}.bytes());
  if (in.values_size() > 0 && (in.samples_size() > 0 || !in.kind().empty()))
    throw Error("it has values or samples of a kind, not both");
  if (in.values_size() > 0) samples.add(in.values().data(), sizeof(float) * static_cast<std::size_t>(in.values_size()));
  for (const std::string& piece : in.samples()) samples.add(piece.data(), piece.size());
  return samples;
}

}  // namespace

std::uint64_t bytesToMakeHeights(const proto::Heights& in) {
  std::uint64_t bytes = sizeof(float) * static_cast<std::uint64_t>(in.values_size());
  for (const std::string& piece : in.samples()) bytes += piece.size();
  constexpr std::uint64_t kSmallest = 8192;
  return kSmallest + 2 * bytes;  // the pyramid takes a quarter of 16-bit samples, and more of the smallest grids
}

std::shared_ptr<const HeightField> decodeHeights(const proto::Heights& in) {
  if (!in.file().empty()) throw Error("a file of heights is named in scene files only");
  const GridSize size{in.columns(), in.rows(), kindOf(in)};
  checkGridSize(size);
  const std::uint64_t given = bytesToMakeHeights(in);
  if (size.bytes() > given) throw Error("it has fewer samples than it says");  // before memory is taken for them
  const Spacing spacing = spacingOf(in);
  if (in.has_missing() && std::isinf(in.missing())) throw Error("missing must be a finite number");
  std::optional<double> missing;
  if (in.has_missing()) missing = in.missing();
  SampleRoom samples = samplesOf(in);
  const auto grid = std::make_shared<const HeightGrid>(size, samples.take(), missing);
  auto field = std::make_shared<const HeightField>(grid, uprightFrame(size, spacing.columns, spacing.rows, spacing.up));
  requireTriangles(*field);
  return field;
}

std::shared_ptr<const PrimitiveSource> withSpacing(const std::shared_ptr<const PrimitiveSource>& field,
                                                   const proto::Heights& in) {
  if (in.columns() != 0 || in.rows() != 0 || in.values_size() != 0 || in.samples_size() != 0 || !in.kind().empty() ||
      in.has_missing())
    throw Error("columns, rows, values, samples, kind and missing are those of its file");
  Spacing spacing = spacingOf(in);
  if (in.spacing() == 0 && in.spacing_rows() != 0) throw Error("spacingRows needs spacing");
  const auto& heights = dynamic_cast<const HeightField&>(*field);
  const Mat3& axes = heights.frame().axes;
  Vec3 factor(1, spacing.up, 1);
  if (in.spacing() != 0) {
    factor.x() = spacing.columns / axes.row(0).cwiseAbs().maxCoeff();
    factor.z() = spacing.rows / axes.row(2).cwiseAbs().maxCoeff();
  }
  return field->placed(factor.asDiagonal(), Vec3::Zero());
}

}  // namespace hl

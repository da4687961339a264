#include "io/decode_heights.h"

#include <optional>

#include "base/error.h"
#include "io/decode_samples.h"
#include "io/read_heights.h"

namespace hl {

namespace {

struct Spacing {
  double columns, rows, up;
};

Spacing spacingOf(const proto::Heights& in) {
  const double columns = lengthOf(in.spacing(), 1, "spacing");
  return {columns, lengthOf(in.spacing_rows(), columns, "spacingRows"),
          lengthOf(in.vertical_scale(), 1, "verticalScale")};
}

}  // namespace

std::uint64_t bytesToMakeHeights(const proto::Heights& in) {
  constexpr std::uint64_t kSmallest = 8192;
  // The pyramid takes a quarter of 16-bit samples, and more of the smallest grids.
  return kSmallest + 2 * bytesOfSamples(in);
}

std::shared_ptr<const HeightField> decodeHeights(const proto::Heights& in) {
  if (!in.file().empty()) throw Error("a file of heights is named in scene files only");
  const GridSize size{in.columns(), in.rows(), kindOf(in)};
  checkGridSize(size);
  const Spacing spacing = spacingOf(in);
  const std::optional<double> missing = missingOf(in);
  const auto grid = std::make_shared<const HeightGrid>(size, samplesOf(in, size.bytes()), missing);
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

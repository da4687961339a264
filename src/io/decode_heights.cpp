#include "io/decode_heights.h"

#include <optional>
#include <utility>

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

DepthCamera cameraOf(const proto::Heights& in) {
  if (in.camera_size() != 4)
    throw Error("a camera has four numbers: focal lengths fx and fy above 0, and its centre cx, cy, in pixels");
  if (in.spacing() != 0 || in.spacing_rows() != 0) throw Error("a depth image has a camera, and no spacing");
  DepthCamera camera{in.camera(0), in.camera(1), in.camera(2), in.camera(3)};
  if (in.join() != 0) camera.join = in.join();
  checkCamera(camera);
  return camera;
}

std::shared_ptr<const PrimitiveSource> depthImageOf(const HeightGrid& grid, const proto::Heights& in,
                                                    const PrimitiveSource* before) {
  const DepthCamera camera = cameraOf(in);
  if (!(in.smoothing() >= 0 && in.smoothing() < 1)) throw Error("smoothing must be from 0 to less than 1");
  const auto* const last = dynamic_cast<const DepthFrame*>(before);
  const double scale_m = lengthOf(in.vertical_scale(), 1, "verticalScale");
  auto image = smoothed(grid, scale_m, camera, last != nullptr ? &last->image() : nullptr, in.smoothing());
  return std::make_shared<const DepthFrame>(std::move(image), cameraFrame(1));
}

void requireNoCamera(const proto::Heights& in) {
  if (in.join() != 0 || in.smoothing() != 0) throw Error("join and smoothing are of depth images, which have a camera");
}

}  // namespace

std::uint64_t bytesToMakeHeights(const proto::Heights& in) {
  constexpr std::uint64_t kSmallest = 8192;
  // The pyramid takes a quarter of 16-bit samples, and more of the smallest grids.
  // Of a depth image the depths are kept as float32, beside those of 16 bits.
  return kSmallest + (in.camera_size() > 0 ? 4 : 2) * bytesOfSamples(in);
}

std::shared_ptr<const PrimitiveSource> decodeHeights(const proto::Heights& in, const PrimitiveSource* before) {
  if (!in.file().empty()) throw Error("a file of heights is named in scene files only");
  const GridSize size{in.columns(), in.rows(), kindOf(in)};
  checkGridSize(size);
  const std::optional<double> missing = missingOf(in);
  const auto grid = std::make_shared<const HeightGrid>(size, samplesOf(in, size.bytes()), missing);
  if (in.camera_size() > 0) return depthImageOf(*grid, in, before);
  requireNoCamera(in);
  const Spacing spacing = spacingOf(in);
  auto field = std::make_shared<const HeightField>(grid, uprightFrame(size, spacing.columns, spacing.rows, spacing.up));
  requireTriangles(*field);
  requireSlopes(*field);
  return field;
}

std::shared_ptr<const PrimitiveSource> withSpacing(const std::shared_ptr<const PrimitiveSource>& field,
                                                   const proto::Heights& in) {
  if (in.columns() != 0 || in.rows() != 0 || in.values_size() != 0 || in.samples_size() != 0 || !in.kind().empty() ||
      in.has_missing())
    throw Error("columns, rows, values, samples, kind and missing are those of its file");
  const auto& heights = dynamic_cast<const HeightField&>(*field);
  if (in.camera_size() > 0) return depthImageOf(heights.grid(), in, nullptr);
  requireNoCamera(in);
  Spacing spacing = spacingOf(in);
  if (in.spacing() == 0 && in.spacing_rows() != 0) throw Error("spacingRows needs spacing");
  const Mat3& axes = heights.frame().axes;
  Vec3 factor(1, spacing.up, 1);
  if (in.spacing() != 0) {
    factor.x() = spacing.columns / axes.row(0).cwiseAbs().maxCoeff();
    factor.z() = spacing.rows / axes.row(2).cwiseAbs().maxCoeff();
  }
  return field->placed(factor.asDiagonal(), Vec3::Zero());
}

}  // namespace hl

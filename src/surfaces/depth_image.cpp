#include "surfaces/depth_image.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace hl {

namespace {

/// A pixel of one image after another.
class SmoothPixel {
 public:
  SmoothPixel(const DepthCamera& camera, const DepthImage* before, double smoothing)
      : camera_(camera), before_(before), smoothing_(smoothing) {}

  double depth(std::uint32_t column, std::uint32_t row, std::size_t at, double now, std::uint8_t& held) const {
    if (before_ == nullptr) return now;
    const double then = before_->grid->at(column, row);
    if (camera_.joins(now, now, then)) return then + (1 - smoothing_) * (now - then);
    if (now > 0 || !(then > 0)) return now;
    held = static_cast<std::uint8_t>(1 + (before_->held.empty() ? 0 : before_->held[at]));
    return held <= kMostHeld ? then : now;
  }

 private:
  const DepthCamera& camera_;
  const DepthImage* before_;
  const double smoothing_;
};

}  // namespace

std::shared_ptr<const DepthImage> smoothed(const HeightGrid& now, double scale_m, const DepthCamera& camera,
                                           const DepthImage* before, double smoothing) {
  const bool counts = before != nullptr && smoothing > 0 && before->camera == camera &&
                      before->grid->columns() == now.columns() && before->grid->rows() == now.rows();
  const SmoothPixel pixel(camera, counts ? before : nullptr, smoothing);
  const auto depths = std::make_shared<std::vector<float>>(now.size().samples());
  std::vector<std::uint8_t> held(counts ? depths->size() : 0);
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, now.rows()), [&](const auto& rows) {
    for (std::uint32_t row = rows.begin(); row < rows.end(); ++row) {
      for (std::uint32_t column = 0; column < now.columns(); ++column) {
        const std::size_t at = std::size_t{row} * now.columns() + column;
        std::uint8_t since = 0;
        (*depths)[at] = static_cast<float>(pixel.depth(column, row, at, scale_m * now.at(column, row), since));
        if (counts) held[at] = since;
      }
    }
  });
  const std::shared_ptr<const void> data(depths, depths->data());
  auto grid = std::make_shared<const HeightGrid>(GridSize{now.columns(), now.rows(), SampleKind::kFloat32}, data);
  return std::make_shared<const DepthImage>(std::move(grid), camera, std::move(held));
}

}  // namespace hl

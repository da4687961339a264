#include "surfaces/depth_image.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "surfaces/depth_rows.h"

namespace hl {

namespace {

constexpr std::size_t kPiece = 2048;  // pixels whose depths are in the cache from one loop to the next

// Calls each(first, count) for pieces of so many pixels, on all threads.
template <typename Each>
void inPieces(std::size_t pixels, const Each& each) {
  const std::size_t pieces = (pixels + kPiece - 1) / kPiece;
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pieces), [&](const auto& some) {
    for (std::size_t piece = some.begin(); piece < some.end(); ++piece)
      each(piece * kPiece, std::min(kPiece, pixels - piece * kPiece));
  });
}

// `held`: of the image that is made.
void follow(const HeightGrid& now, double scale_m, const DepthImage& before, double smoothing, DepthPixels& pixels,
            std::vector<std::uint8_t>& held) {
  static constexpr std::array<std::uint8_t, kPiece> kAllSeen{};
  const FollowRule rule{static_cast<float>(before.camera.join), static_cast<float>(1 - smoothing), kMaxHeld};
  inPieces(pixels.count(), [&](std::size_t first, std::size_t count) {
    std::array<float, kPiece> depths;
    readDepths(now.list(), first, count, scale_m, depths.data());
    const std::uint8_t* const held_before = before.held.empty() ? kAllSeen.data() : before.held.data() + first;
    followDepths(
        {count, depths.data(), before.pixels.all() + first, held_before, pixels.all() + first, held.data() + first},
        rule);
  });
}

}  // namespace

std::shared_ptr<const DepthImage> smoothed(const HeightGrid& now, double scale_m, const DepthCamera& camera,
                                           const DepthImage* before, double smoothing) {
  DepthPixels pixels(now.columns(), now.rows());
  const bool counts = before != nullptr && smoothing > 0 && before->camera == camera &&
                      before->pixels.columns() == now.columns() && before->pixels.rows() == now.rows();
  std::vector<std::uint8_t> held(counts ? pixels.count() : 0);
  if (counts) {
    follow(now, scale_m, *before, smoothing, pixels, held);
  } else {
    inPieces(pixels.count(), [&](std::size_t first, std::size_t count) {
      readDepths(now.list(), first, count, scale_m, pixels.all() + first);
    });
  }
  return std::make_shared<const DepthImage>(std::move(pixels), camera, std::move(held));
}

}  // namespace hl

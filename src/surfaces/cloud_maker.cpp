#include "surfaces/cloud_maker.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "geometry/box.h"
#include "geometry/primitive.h"
#include "surfaces/cloud_order.h"
#include "surfaces/cloud_search.h"

namespace hl {

namespace {

constexpr const char* kNoPoints = "there are no points in it";
constexpr std::size_t kGrain = 256;  // blocks for one thread at a time
using BlockRange = oneapi::tbb::blocked_range<std::size_t>;

// A cloud of so many points is not made coarser, though its blocks may have one point each: 4 MB at most.
constexpr std::size_t kKeptExactly = 10'000;

// So many codes of spacings are an octave; those from kUsual on are larger than is usual.
constexpr double kCodeRatio = 1.0442737824274138;  // 2^(1/16)
constexpr int kUsual = 223;                        // kept spacings reach from 2^-14 to 2^2 times the usual one

}  // namespace

/// Fills the lists of a cloud.
class CloudMaker {
 public:
  explicit CloudMaker(CloudInput input) : input_(std::move(input)), cloud_(std::make_shared<CloudPoints>()) {}

  std::shared_ptr<const CloudPoints> make() {
    order();
    pack();
    addColours();
    addNodes();
    measure();
    addNormals();
    return std::move(cloud_);
  }

 private:
  static constexpr std::size_t kPerBlock = CloudPoints::kPerBlock, kPerNode = CloudPoints::kPerNode;

  void order();
  void pack();
  void addColours();
  void addBlock(std::span<const LatticePoint> points);
  void addNodes();
  void measure();
  void addNormals();
  std::span<const std::uint32_t> normalsOf(std::size_t block) const;
  double lookAround(const CloudSearch& search, std::size_t block);
  static std::uint32_t unitOf(std::size_t byte);
  static std::size_t bytesFor(std::uint64_t bits);

  CloudInput input_;
  std::shared_ptr<CloudPoints> cloud_;
  HugeVector<std::uint32_t> normals_;  // by slot
};

void CloudMaker::order() {
  sortPoints(input_.points);
  arrangePoints(input_.points, input_.lattice.step);
  const bool is_exact = input_.made_before || input_.points.size() <= kKeptExactly;
  const int powers = is_exact ? 0 : coarserBy(input_.points);
  if (powers > 0) {
    CloudLattice same = input_.lattice;
    coarsen(input_.colours, same, powers);
    coarsen(input_.points, input_.lattice, powers);
    sortPoints(input_.points);
    arrangePoints(input_.points, input_.lattice.step);
  }
  cloud_->lattice_ = input_.lattice;
  cloud_->size_ = input_.points.size();
  if (!input_.exact || powers > 0) cloud_->error_m_ = 0.5 * input_.lattice.step.norm();
}

// A block ends early where its points are too far apart for 16 bits.
void CloudMaker::pack() {
  constexpr std::int64_t kWidest = 0xffff;
  std::vector<LatticePoint>& points = input_.points;
  const std::size_t runs = (points.size() + kPerBlock - 1) / kPerBlock;
  cloud_->blocks_.reserve(runs);
  cloud_->packed_.reserve(runs * bytesFor(kPerBlock * CloudPoints::kMostOffsetBits) + kReadBehind_bytes);
  normals_.reserve(runs * kPerBlock);
  for (std::size_t first = 0; first < points.size(); first += kPerBlock) {
    const std::span<LatticePoint> run = std::span(points).subspan(first, std::min(kPerBlock, points.size() - first));
    std::sort(run.begin(), run.end(), [](const LatticePoint& a, const LatticePoint& b) { return a.at < b.at; });
    std::size_t begin = 0;
    LatticeBox box{run[0].at, run[0].at};
    for (std::size_t i = 1; i < run.size(); ++i) {
      bool wide = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], run[i].at[axis]);
        box.high[axis] = std::max(box.high[axis], run[i].at[axis]);
        wide = wide || std::int64_t{box.high[axis]} - box.low[axis] > kWidest;
      }
      if (!wide) continue;
      addBlock(run.subspan(begin, i - begin));
      box = {run[i].at, run[i].at};
      begin = i;
    }
    addBlock(run.subspan(begin));
  }
  points = {};
  cloud_->blocks_.shrink_to_fit();
  cloud_->packed_.resize(cloud_->packed_.size() + kReadBehind_bytes, 0);
}

std::uint32_t CloudMaker::unitOf(std::size_t byte) {
  const std::size_t unit = byte / (CloudPoints::kUnit_bits / 8);
  if (unit > std::numeric_limits<std::uint32_t>::max()) throw Error("it has more points than a cloud can keep");
  return static_cast<std::uint32_t>(unit);
}

// Whole units.
std::size_t CloudMaker::bytesFor(std::uint64_t bits) {
  constexpr std::uint64_t kUnit = CloudPoints::kUnit_bits;
  return static_cast<std::size_t>((bits + kUnit - 1) / kUnit * (kUnit / 8));
}

// The offsets and, at first, no normals; of empty slots the offsets are 0.
void CloudMaker::addBlock(std::span<const LatticePoint> points) {
  HugeVector<std::uint8_t>& packed = cloud_->packed_;
  CloudPoints::Block block{points[0].at, {}, static_cast<std::uint8_t>(points.size()), kUsual, unitOf(packed.size())};
  for (const LatticePoint& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) block.low[axis] = std::min(block.low[axis], point.at[axis]);
  }
  const auto offset = [&](const LatticePoint& point, std::size_t axis) {
    return static_cast<std::uint16_t>(point.at[axis] - block.low[axis]);
  };
  for (const LatticePoint& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) block.size[axis] = std::max(block.size[axis], offset(point, axis));
  }
  const CloudPoints::Offsets offsets(block);
  packed.resize(packed.size() + bytesFor(offsets.bits()), 0);
  std::uint64_t bit = offsets.first_bit;
  for (const LatticePoint& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      writeBits(packed.data(), bit, offsets.width[axis], offset(point, axis));
      bit += offsets.width[axis];
    }
    normals_.push_back(point.normal);
  }
  normals_.resize(kPerBlock * (cloud_->blocks() + 1), kNoNormal);
  cloud_->blocks_.push_back(block);
}

// Each point is looked up by its place; of several colours at one place the highest number counts, whatever the order.
void CloudMaker::addColours() {
  std::vector<LatticePoint>& colours = input_.colours;
  if (colours.empty()) return;
  sortPoints(colours);
  cloud_->colours_.resize(kPerBlock * cloud_->blocks(), Rgb{});
  oneapi::tbb::parallel_for(BlockRange(0, cloud_->blocks(), kGrain), [&](const BlockRange& range) {
    for (std::size_t block = range.begin(); block < range.end(); ++block) {
      for (std::size_t i = 0; i < cloud_->countIn(block); ++i) {
        const std::size_t slot = kPerBlock * block + i;
        const LatticePoint wanted{cloud_->stepsAt(slot), 0};
        const auto found = std::lower_bound(colours.begin(), colours.end(), wanted,
                                            [](const auto& a, const auto& b) { return a.at < b.at; });
        if (found != colours.end() && found->at == wanted.at) cloud_->colours_[slot] = unpackRgb(found->normal);
      }
    }
  });
  colours = {};
}

void CloudMaker::addNodes() {
  for (int level = 0; cloud_->countOn(level) > 1; ++level) {
    const std::size_t parts = cloud_->countOn(level);
    HugeVector<LatticeBox> nodes;
    nodes.reserve((parts + kPerNode - 1) / kPerNode);
    for (std::size_t first = 0; first < parts; first += kPerNode) {
      LatticeBox box = cloud_->box(level, first);
      for (std::size_t i = first + 1; i < std::min(first + kPerNode, parts); ++i) {
        const LatticeBox part = cloud_->box(level, i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          box.low[axis] = std::min(box.low[axis], part.low[axis]);
          box.high[axis] = std::max(box.high[axis], part.high[axis]);
        }
      }
      nodes.push_back(box);
    }
    cloud_->nodes_.push_back(std::move(nodes));
  }
}

// The spacing around the points of a block: the middle one. Normals that lack are added; empty slots have the last one,
// so that the block needs no more bits.
double CloudMaker::lookAround(const CloudSearch& search, std::size_t block) {
  std::array<double, kPerBlock> spacing{};
  const std::size_t count = cloud_->countIn(block);
  const std::array<CloudNeighbours, kPerBlock> nearest = search.aroundAll(block);
  for (std::size_t i = 0; i < count; ++i) {
    spacing[i] = nearest[i].spacing();
    std::uint32_t& normal = normals_[block * kPerBlock + i];
    if (normal == kNoNormal) normal = packNormal(nearest[i].normal());
  }
  const auto empty = normals_.begin() + static_cast<std::ptrdiff_t>(block * kPerBlock + count);
  std::fill(empty, empty + static_cast<std::ptrdiff_t>(kPerBlock - count), *(empty - 1));
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(spacing.begin(), middle, spacing.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

void CloudMaker::measure() {
  const CloudSearch search(*cloud_);
  std::vector<double> spacing(cloud_->blocks());
  oneapi::tbb::parallel_for(BlockRange(0, spacing.size(), kGrain), [&](const BlockRange& range) {
    for (std::size_t block = range.begin(); block < range.end(); ++block) spacing[block] = lookAround(search, block);
  });
  std::vector<double> ordered = spacing;
  const auto middle = ordered.begin() + static_cast<std::ptrdiff_t>(ordered.size() / 2);
  std::nth_element(ordered.begin(), middle, ordered.end());
  constexpr double kOfOnePoint_m = 1e-3;
  const double usual = *middle > 0 ? *middle : kOfOnePoint_m;
  cloud_->usual_spacing_ = usual;
  std::array<double, 256>& kept = cloud_->spacings_;
  kept[kUsual] = usual;
  for (int i = kUsual + 1; i < 256; ++i) kept[i] = kept[i - 1] * kCodeRatio;
  for (int i = kUsual - 1; i >= 0; --i) kept[i] = kept[i + 1] / kCodeRatio;
  for (std::size_t block = 0; block < spacing.size(); ++block) {
    const auto least = std::lower_bound(kept.begin(), kept.end() - 1, spacing[block]);  // rounded up
    cloud_->blocks_[block].spacing = static_cast<std::uint8_t>(least - kept.begin());
  }
}

std::span<const std::uint32_t> CloudMaker::normalsOf(std::size_t block) const {
  return std::span(normals_).subspan(kPerBlock * block, kPerBlock);
}

// Moves the offsets apart, so that the normals of each block follow its own.
void CloudMaker::addNormals() {
  HugeVector<CloudPoints::Block>& blocks = cloud_->blocks_;
  std::vector<std::size_t> begin(blocks.size() + 1);  // bytes; first the size of the block before
  oneapi::tbb::parallel_for(BlockRange(0, blocks.size(), kGrain), [&](const BlockRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const BlockNormals normals(normalsOf(i));
      begin[i + 1] = bytesFor(CloudPoints::Offsets(blocks[i]).bits() + normals.bits(kPerBlock));
    }
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  unitOf(begin.back());  // before there is memory for it
  HugeVector<std::uint8_t> packed(begin.back() + kReadBehind_bytes);
  std::fill(packed.end() - kReadBehind_bytes, packed.end(), std::uint8_t{0});
  oneapi::tbb::parallel_for(BlockRange(0, blocks.size(), kGrain), [&](const BlockRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      CloudPoints::Block& block = blocks[i];
      const std::uint64_t bits = CloudPoints::Offsets(block).bits();
      std::uint8_t* to = packed.data() + begin[i];
      const std::uint8_t* from = cloud_->packed_.data() + CloudPoints::kUnit_bits / 8 * block.begin;
      std::fill(std::copy_n(from, bytesFor(bits), to), packed.data() + begin[i + 1], std::uint8_t{0});
      BlockNormals(normalsOf(i)).write(normalsOf(i), to, bits);
      block.begin = unitOf(begin[i]);
    }
  });
  cloud_->packed_ = std::move(packed);
}

std::shared_ptr<const CloudPoints> makeCloud(CloudInput input) {
  if (input.points.empty()) throw Error(kNoPoints);
  return CloudMaker(std::move(input)).make();
}

namespace {

// The middle one along each axis, and the side of the box of the middle half of them. Of many positions a part stands
// for all.
struct Bulk {
  Vec3 middle = Vec3::Zero();
  double side = 0;
};

Bulk bulkOf(const std::vector<Vec3>& positions) {
  constexpr std::size_t kLookedAt = 10'000;
  const std::size_t stride = std::max<std::size_t>(1, positions.size() / kLookedAt);
  Bulk bulk;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (std::size_t i = 0; i < positions.size(); i += stride) {
      if (positions[i].allFinite()) along.push_back(positions[i][axis]);
    }
    if (along.empty()) return bulk;
    std::sort(along.begin(), along.end());
    bulk.middle[axis] = along[along.size() / 2];
    bulk.side = std::max(bulk.side, along[along.size() - 1 - along.size() / 4] - along[along.size() / 4]);
  }
  return bulk;
}

// How many points of the lattice stand for positions that differ.
std::size_t mergedOn(const CloudLattice& lattice, std::vector<Vec3> positions) {
  const auto step_of = [&](const Vec3& p) -> Vec3 { return ((p - lattice.origin) / lattice.step[0]).array().round(); };
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::erase_if(positions, [](const Vec3& p) { return !p.allFinite(); });
  std::sort(positions.begin(), positions.end(), before);
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  const std::size_t different = positions.size();
  for (Vec3& p : positions) p = step_of(p);
  std::sort(positions.begin(), positions.end(), before);
  return different - static_cast<std::size_t>(std::unique(positions.begin(), positions.end()) - positions.begin());
}

// The side of what a lattice has room for; points at one place need some too.
double sideFor(const Box& bounds) {
  constexpr double kLeast_m = 1e-6, kLeastPart = 1e-6;
  return std::max({bounds.size().maxCoeff(), kLeast_m, kLeastPart * bounds.max.cwiseAbs().maxCoeff()});
}

std::string whyTooCoarse(const Box& bounds, const Bulk& bulk, const std::vector<Vec3>& positions) {
  const double side = bounds.size().maxCoeff();
  const Eigen::IOFormat plain(Eigen::StreamPrecision, Eigen::DontAlignCols, " ", " ");
  std::ostringstream text;
  if (side < sideFor(bounds)) {
    text << "and all of them lie within " << side << " m around " << bounds.centre().transpose().format(plain)
         << ": check that they are in metres, and near the origin";
    return text.str();
  }
  const auto distance = [&](const Vec3& p) { return p.allFinite() ? (p - bulk.middle).norm() : 0; };
  const Vec3& stray = *std::max_element(positions.begin(), positions.end(),
                                        [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
  text << "as the point " << stray.transpose().format(plain) << " lies so far from the rest, which is around "
       << bulk.middle.transpose().format(plain) << "; remove the stray points";
  return text.str();
}

// A lattice is as wide as all points together, but has some width in any case. Where most of them lie within a small
// part of it, it may be too coarse for them: then the stray ones are at fault, or the unit or the place of all.
void requireFineEnough(const CloudLattice& lattice, const std::vector<Vec3>& positions, const Box& bounds) {
  constexpr double kEnoughSteps = 1 << 20;  // across most of the points
  constexpr std::size_t kFew = 100;         // one in so many may be merged
  const Bulk bulk = bulkOf(positions);
  if (bulk.side >= kEnoughSteps * lattice.step[0]) return;
  const std::size_t merged = mergedOn(lattice, positions);
  if (merged * kFew <= positions.size()) return;
  std::ostringstream text;
  text << merged << " of its " << positions.size() << " points would be one with others: they are kept in steps of "
       << lattice.step[0] << " m, ";
  throw Error(text.str() + whyTooCoarse(bounds, bulk, positions));
}

}  // namespace

CloudInput onFineLattice(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& normals,
                         std::size_t& skipped, const std::vector<Rgb>& colours) {
  constexpr double kSteps = 2147483648.0;  // 2^31: from -2^30 to 2^30
  Box bounds;
  for (const Vec3& p : positions) {
    if (p.allFinite()) bounds.extend(p);
  }
  if (bounds.empty()) throw Error(kNoPoints);
  if (!withinReach(bounds.min) || !withinReach(bounds.max)) throw Error("its points lie beyond 1e9 m");
  const double step = std::exp2(std::ceil(std::log2(sideFor(bounds) / kSteps)));
  CloudInput input;
  input.lattice = {Vec3::Constant(step), (bounds.centre() / step).array().round() * step};
  requireFineEnough(input.lattice, positions, bounds);
  input.points.reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!positions[i].allFinite()) {
      ++skipped;
      continue;
    }
    const Vec3 at = ((positions[i] - input.lattice.origin) / step).array().round();
    const auto along = [&](Eigen::Index axis) { return static_cast<std::int32_t>(at[axis]); };
    input.points.push_back({{along(0), along(1), along(2)}, i < normals.size() ? normals[i] : kNoNormal});
    if (i < colours.size()) input.colours.push_back({input.points.back().at, packRgb(colours[i])});
  }
  return input;
}

}  // namespace hl

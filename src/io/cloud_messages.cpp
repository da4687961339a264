#include "io/cloud_messages.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "base/error.h"

namespace hl {

namespace {

constexpr const char* kBrokenCloud = "a cloud in it makes no sense";

template <typename Item>
void setBytes(std::span<const Item> items, std::string& out) {
  out.assign(reinterpret_cast<const char*>(items.data()), items.size_bytes());
}

template <typename Item>
std::vector<Item> pointBytesAs(const std::string& bytes) {
  if (bytes.size() % sizeof(Item) != 0) throw Error(kBrokenCloud);
  std::vector<Item> items(bytes.size() / sizeof(Item));
  if (!items.empty()) std::memcpy(static_cast<void*>(items.data()), bytes.data(), bytes.size());
  return items;
}

template <typename Numbers>
Vec3 lengthsOf(const Numbers& numbers) {
  if (numbers.size() != 3) throw Error(kBrokenCloud);
  return {numbers.Get(0), numbers.Get(1), numbers.Get(2)};
}

}  // namespace

void toProto(const CloudHeader& header, proto::RecordedCloud& out) {
  for (const double value : header.turn.reshaped()) out.add_axes(value);
  if (!header.lattice) return;
  for (const double value : header.lattice->step) out.add_step(value);
  for (const double value : header.lattice->origin) out.add_lattice_origin(value);
}

void toProto(const CloudPiece& piece, proto::RecordedCloud& out) {
  setBytes(piece.steps, *out.mutable_steps());
  setBytes(piece.positions, *out.mutable_positions());
  setBytes(piece.normals, *out.mutable_normals());
  setBytes(piece.colours, *out.mutable_colours());
}

Mat3 turnOf(const proto::RecordedCloud& in) {
  if (in.axes_size() != 9) throw Error(kBrokenCloud);
  Mat3 turn;
  std::copy(in.axes().begin(), in.axes().end(), turn.data());
  return turn;
}

GridFrame frameOf(const proto::RecordedCloud& in) { return {turnOf(in), lengthsOf(in.origin())}; }

CloudLook lookOf(const proto::RecordedCloud& in) {
  return {in.surfels() ? CloudForm::kSurfels : CloudForm::kPoints, in.reach()};
}

void writeCloud(const PointCloud& cloud, std::uint64_t like,
                const std::function<void(proto::RecordedCloud& part)>& take) {
  constexpr std::size_t kBlocksInPart = std::size_t{1} << 14;
  const CloudPoints& points = *cloud.points();
  proto::RecordedCloud part;
  toProto(CloudHeader{points.lattice(), cloud.frame().axes}, part);
  for (const double value : cloud.frame().origin) part.add_origin(value);
  part.set_surfels(cloud.surfels());
  part.set_reach(cloud.look().reach);
  part.set_inexact(points.error_m() > 0);
  part.set_like(like);
  if (like != 0) return take(part);
  std::vector<std::array<std::int32_t, 3>> steps;
  std::vector<std::uint32_t> normals;
  std::vector<Rgb> colours;
  for (std::size_t block = 0; block < points.blocks();) {
    steps.clear();
    normals.clear();
    colours.clear();
    for (const std::size_t end = std::min(block + kBlocksInPart, points.blocks()); block < end; ++block) {
      for (std::size_t i = 0; i < points.countIn(block); ++i) {
        const std::size_t slot = block * CloudPoints::kPerBlock + i;
        steps.push_back(points.stepsAt(slot));
        normals.push_back(points.normal(slot));
        if (points.hasColours()) colours.push_back(points.colour(slot));
      }
    }
    toProto(CloudPiece{steps, {}, normals, colours}, part);
    part.set_continues(block < points.blocks());
    take(part);
    part.Clear();
  }
}

CloudCollector::CloudCollector(const proto::RecordedCloud& header, std::size_t most_bytes, bool made_before)
    : on_lattice_(header.step_size() > 0), left_bytes_(most_bytes) {
  input_.exact = on_lattice_ && !header.inexact();
  input_.made_before = made_before;
  if (!on_lattice_) return;
  input_.lattice = {lengthsOf(header.step()), lengthsOf(header.lattice_origin())};
  if (!input_.lattice.origin.allFinite() || !input_.lattice.step.allFinite() || !(input_.lattice.step.minCoeff() > 0))
    throw Error(kBrokenCloud);
}

void CloudCollector::takeRoom(std::size_t points, bool coloured) {
  constexpr std::size_t kOfPosition = 60, kOfStep = 32, kOfColour = 40;  // bytes, with what is made of it
  const std::size_t each = (on_lattice_ ? kOfStep : kOfPosition) + (coloured ? kOfColour : 0);
  if (points > left_bytes_ / each)
    throw Error(fmt::format("a cloud of more than {} points takes more memory than there is",
                            input_.points.size() + positions_.size() + left_bytes_ / each));
  left_bytes_ -= points * each;
}

void CloudCollector::add(const proto::RecordedCloud& part) {
  const auto steps = pointBytesAs<std::array<std::int32_t, 3>>(part.steps());
  const auto positions = pointBytesAs<Vec3>(part.positions());
  const auto normals = pointBytesAs<std::uint32_t>(part.normals());
  const auto colours = pointBytesAs<Rgb>(part.colours());
  const std::size_t count = steps.size() + positions.size();
  const auto agrees = [&](const auto& list) { return list.empty() || list.size() == count; };
  if (!(on_lattice_ ? positions.empty() : steps.empty()) || !agrees(normals) || !agrees(colours))
    throw Error(kBrokenCloud);
  takeRoom(count, !colours.empty());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    input_.points.push_back({steps[i], normals.empty() ? kNoNormal : normals[i]});
    if (!colours.empty()) input_.colours.push_back({steps[i], packRgb(colours[i])});
  }
  if (!colours.empty() && !on_lattice_) colours_.resize(positions_.size());
  if (!on_lattice_) colours_.insert(colours_.end(), colours.begin(), colours.end());
  if (!normals.empty() && !on_lattice_) normals_.resize(positions_.size(), kNoNormal);
  positions_.insert(positions_.end(), positions.begin(), positions.end());
  if (!on_lattice_) normals_.insert(normals_.end(), normals.begin(), normals.end());
}

std::shared_ptr<const CloudPoints> CloudCollector::take() {
  if (on_lattice_) return makeCloud(std::move(input_));
  std::size_t skipped = 0;
  CloudInput input = onFineLattice(positions_, normals_, skipped, colours_);
  positions_ = {};
  colours_ = {};
  normals_ = {};
  return makeCloud(std::move(input));
}

std::shared_ptr<const PointCloud> cloudOfFile(const std::shared_ptr<const CloudPoints>& points, const Mat3& turn,
                                              std::string& note) {
  constexpr double kFar = 10;  // times its size
  const GridFrame lattice{points->lattice().step.asDiagonal(), points->lattice().origin};
  const GridFrame frame = lattice.placed(turn, Vec3::Zero());
  auto cloud = std::make_shared<const PointCloud>(points, frame, CloudLook{});
  const Vec3 middle = cloud->bounds().centre();
  if (!(middle.norm() > kFar * cloud->bounds().size().norm())) return cloud;
  const Vec3 in_file = turn.inverse() * middle;
  note =
      fmt::format("lies far from the origin of its file: its middle, {:.9g} {:.9g} {:.9g} there, is put at the origin",
                  in_file.x(), in_file.y(), in_file.z());
  return std::make_shared<const PointCloud>(points, frame.placed(Mat3::Identity(), -middle), CloudLook{});
}

}  // namespace hl

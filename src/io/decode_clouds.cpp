#include "io/decode_clouds.h"

#include <utility>
#include <vector>

#include "base/error.h"
#include "io/colour_messages.h"
#include "surfaces/cloud_maker.h"

namespace hl {

namespace {

CloudLook lookOf(const proto::Cloud& in) {
  CloudLook look;
  look.form = in.surfels() ? CloudForm::kSurfels : CloudForm::kPoints;
  if (in.reach() != 0) look.reach = in.reach();
  if (in.reach() != 0 && !in.surfels()) throw Error("reach is of surfels, and this cloud is of points");
  return look;
}

}  // namespace

std::uint64_t bytesToMakeCloud(const proto::Cloud& in) {
  constexpr std::uint64_t kSmallest = 16384, kEach = 60, kOfColour = 40;
  return kSmallest +
         (kEach + (in.colours_size() > 0 ? kOfColour : 0)) * (static_cast<std::uint64_t>(in.positions_size()) / 3);
}

std::shared_ptr<const PointCloud> decodeCloud(const proto::Cloud& in) {
  if (!in.file().empty() || !in.builtin().empty()) throw Error("a file of a cloud is named in scene files only");
  if (in.positions_size() % 3 != 0) throw Error("positions must be three numbers for each point");
  if (in.normals_size() != 0 && in.normals_size() != in.positions_size())
    throw Error("normals must be three numbers for each point, or absent");
  if (in.colours_size() != 0 && in.colours_size() != in.positions_size())
    throw Error("colours must be three numbers for each point, or absent");
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> normals;
  positions.reserve(static_cast<std::size_t>(in.positions_size()) / 3);
  for (int i = 0; i < in.positions_size(); i += 3)
    positions.emplace_back(in.positions(i), in.positions(i + 1), in.positions(i + 2));
  for (int i = 0; i < in.normals_size(); i += 3)
    normals.push_back(packNormal(Vec3(in.normals(i), in.normals(i + 1), in.normals(i + 2))));
  std::size_t skipped = 0;
  CloudInput input = onFineLattice(positions, normals, skipped, coloursIn(in.colours()));
  if (skipped > 0) throw Error("positions must be finite numbers");
  return std::make_shared<const PointCloud>(makeCloud(std::move(input)), lookOf(in));
}

std::shared_ptr<const PointCloud> withLook(const PointCloud& cloud, const proto::Cloud& in) {
  if (in.positions_size() + in.normals_size() + in.colours_size() != 0)
    throw Error("positions, normals and colours are those of its file");
  return std::make_shared<const PointCloud>(cloud.points(), cloud.frame(), lookOf(in));
}

}  // namespace hl

#include "kept_hulls.h"

#include <bit>
#include <cstdint>
#include <sstream>

#include "base/splitmix64.h"

namespace hl {

namespace {

constexpr std::string_view kLines =
#include "kept_hulls.inc"
    ;

std::string keyOf(const std::vector<Vec3>& points) {
  std::uint64_t key = points.size();
  for (const Vec3& point : points) {
    for (const double number : point) key = splitmix64(key ^ std::bit_cast<std::uint64_t>(number));
  }
  return std::to_string(key);
}

// As many numbers as the first of them says.
template <typename Number>
std::vector<Number> listFrom(std::istream& in) {
  std::size_t count = 0;
  in >> count;
  std::vector<Number> list(count);
  for (Number& number : list) in >> number;
  return list;
}

template <typename Number>
void writeList(const std::vector<Number>& list, std::ostream& out) {
  out << ' ' << list.size();
  for (const Number number : list) out << ' ' << number;
}

}  // namespace

std::string_view keptHulls() { return kLines; }

std::string lineOf(const std::vector<Vec3>& points, const HullFaces& hull) {
  std::ostringstream out;
  out.precision(17);
  out << keyOf(points) << ' ' << hull.error;
  writeList(hull.points, out);
  out << ' ' << hull.faces.size();
  for (const auto& face : hull.faces) writeList(face, out);
  return out.str();
}

std::optional<HullFaces> keptHull(std::string_view lines, const std::vector<Vec3>& points) {
  const std::string key = keyOf(points) + ' ';
  const std::size_t at = lines.find(key);
  if (at == std::string_view::npos || (at > 0 && lines[at - 1] != '\n')) return std::nullopt;
  std::istringstream in{std::string(lines.substr(at + key.size()))};
  HullFaces hull;
  in >> hull.error;
  hull.points = listFrom<std::size_t>(in);
  std::size_t faces = 0;
  in >> faces;
  for (std::size_t i = 0; i < faces; ++i) hull.faces.push_back(listFrom<Convex::Index>(in));
  return hull;
}

}  // namespace hl

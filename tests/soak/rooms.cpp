#include "soak/rooms.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "soak/add_triangle.h"

namespace hl::soak {

namespace {

constexpr int kOutside = -1;

// A parallelogram in n x n cells, each cut along one or the other diagonal.
void addSheet(test::Random& random, Model& model, const Vec3& corner, const Vec3& u, const Vec3& v, int n) {
  const auto at = [&](int i, int j) { return Vec3(corner + u * i / n + v * j / n); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const bool turned = random.below(2) == 0;
      addTriangle(model, a, b, turned ? d : c);
      addTriangle(model, turned ? b : a, c, d);
    }
  }
}

// The six sides of the box centre - half .. centre + half: visit(corner, u, v) for each.
template <typename Visit>
void forEachSide(const Vec3& centre, const Vec3& half, Visit visit) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 u = 2 * half[(axis + 1) % 3] * Vec3::Unit((axis + 1) % 3);
    const Vec3 v = 2 * half[(axis + 2) % 3] * Vec3::Unit((axis + 2) % 3);
    visit(Vec3(centre - half), u, v);
    visit(Vec3(centre - half + 2 * half[axis] * Vec3::Unit(axis)), u, v);
  }
}

void addBox(test::Random& random, Model& model, const Vec3& centre, const Vec3& half, int n = 1) {
  forEachSide(centre, half, [&](const Vec3& a, const Vec3& u, const Vec3& v) { addSheet(random, model, a, u, v, n); });
}

bool inBox(const Vec3& p, const Vec3& half) { return (p.cwiseAbs().array() < half.array()).all(); }

void addSegment(Model& model, const Vec3& a, const Vec3& b) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  model.positions.insert(model.positions.end(), {a, b});
  model.segments.push_back({first, first + 1});
}

// Triangles, needles, segments and points of mixed sizes; they only take free space away, so the rooms stay rooms.
void addClutter(test::Random& random, Model& model, int count, const Vec3& half) {
  const auto place = [&] { return Vec3(random.inCube(1).cwiseProduct(half)); };
  for (int i = 0; i < count; ++i) {
    const Vec3 a = place();
    const double size = 4 * std::pow(10.0, random.uniform(-1.5, 0));
    const Vec3 b = a + random.inCube(size);
    const int kind = random.below(10);
    if (kind == 0) {
      model.positions.push_back(a);
      model.points.push_back(static_cast<std::uint32_t>(model.positions.size() - 1));
    } else if (kind == 1) {
      addSegment(model, a, b);
    } else {
      const double width = kind == 2 ? size * std::pow(10.0, random.uniform(-9, -2)) : size;
      addTriangle(model, a, b, b + random.inCube(width));
    }
  }
}

// A side of the torn box. Every vertex of every triangle is moved by up to kTear, and some triangles that have no
// vertex on the rim of the side and none in common are left out. A point of the whole side is then within kTear of a
// triangle or, where one is left out, within kCell (1 - 1 / sqrt 2) more: less than 0.9 in all, so the hole is not one
// to a sphere of radius 1.
constexpr double kTear = 0.45, kCell = 1.5;

void addTornSide(test::Random& random, Model& model, const Vec3& corner, const Vec3& u, const Vec3& v, int n) {
  Model whole;
  addSheet(random, whole, corner, u, v, n);
  for (int cell = 0; cell < n * n; ++cell) {
    const int i = cell / n, j = cell % n;
    const bool may_lack = i % 2 == 1 && j % 2 == 1 && i < n - 1 && j < n - 1;
    const int lacking = may_lack ? random.below(4) : 2;  // of its two triangles; 2, 3: none
    for (int half = 0; half < 2; ++half) {
      if (half == lacking) continue;
      const auto torn = [&](std::size_t k) {
        const auto& triangle = whole.triangles[static_cast<std::size_t>(2 * cell + half)];
        return Vec3(whole.positions[triangle[k]] + kTear * random.uniform(0, 1) * random.direction());
      };
      const Vec3 a = torn(0), b = torn(1), c = torn(2);
      addTriangle(model, a, b, c);
    }
  }
}

// Gaps between sheets and widths of slots: about the diameter, by amounts from below rounding to plain.
double aboutADiameter(test::Random& random) {
  const double off = random.below(4) == 0 ? 0 : std::pow(10.0, random.uniform(-13, -1));
  return 2 * (1 + (random.below(2) == 0 ? off : -off));
}

// A line of x and z with x never falling.
using Profile = std::vector<std::pair<double, double>>;

void addGroove(test::Random& random, Profile& profile, double x) {
  const double depth = random.uniform(0.5, 8);
  const double bottom = random.below(2) == 0 ? 0 : random.uniform(0, 2.5);
  const double side = std::min(4.0, depth * std::tan(random.uniform(0.01, 1.3)));
  profile.insert(profile.end(), {{x, 0}, {x + side, -depth}, {x + side + bottom, -depth}, {x + 2 * side + bottom, 0}});
}

void addChannel(test::Random& random, Profile& profile, double x) {
  const double depth = random.uniform(0.5, 8), width = aboutADiameter(random);
  profile.insert(profile.end(), {{x, 0}, {x, -depth}, {x + width, -depth}, {x + width, 0}});
}

bool isBelow(const Profile& profile, const Vec3& p) {
  bool below = false;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto& [x0, z0] = profile[i];
    const auto& [x1, z1] = profile[i + 1];
    if (p.x() >= x0 && p.x() < x1 && p.z() < z0 + (z1 - z0) * (p.x() - x0) / (x1 - x0)) below = !below;
  }
  return below;
}

// Heights at the nodes of a grid and the diagonals of its cells.
struct EggBox {
  int cells;
  double cell;
  std::vector<double> height;
  std::vector<bool> turned;

  double at(int i, int j) const { return height[static_cast<std::size_t>(i * (cells + 1) + j)]; }
  bool turnedAt(int i, int j) const { return turned[static_cast<std::size_t>(i * cells + j)]; }
  Vec3 node(int i, int j) const { return {cell * (i - 0.5 * cells), cell * (j - 0.5 * cells), at(i, j)}; }

  bool isBelow(const Vec3& p) const {
    const double u = p.x() / cell + 0.5 * cells, v = p.y() / cell + 0.5 * cells;
    const int i = std::clamp(static_cast<int>(u), 0, cells - 1), j = std::clamp(static_cast<int>(v), 0, cells - 1);
    const double s = u - i, t = v - j;
    const double a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
    if (turnedAt(i, j))
      return p.z() < (s + t < 1 ? a + s * (b - a) + t * (d - a) : c + (1 - s) * (d - c) + (1 - t) * (b - c));
    return p.z() < (s > t ? a + s * (b - a) + t * (c - b) : a + t * (d - a) + s * (c - d));
  }
};

EggBox makeEggBox(test::Random& random, double height) {
  EggBox box{6 + random.below(8), random.uniform(0.7, 3), {}, {}};
  const bool regular = random.below(2) == 0;
  for (int i = 0; i <= box.cells; ++i) {
    for (int j = 0; j <= box.cells; ++j)
      box.height.push_back(regular ? ((i + j) % 2 == 0 ? height : -height) : random.uniform(-height, height));
  }
  for (int i = 0; i < box.cells * box.cells; ++i) box.turned.push_back(random.below(2) == 0);
  return box;
}

// Values at the crossings of a lattice, and between them by both ways.
class Lattice {
 public:
  Lattice(test::Random& random, int cells, double height) : cells_(cells) {
    for (int i = 0; i < (cells + 1) * (cells + 1); ++i) values_.push_back(random.uniform(-height, height));
  }
  /// x and y from 0 to 1.
  double at(double x, double y) const {
    const int i = std::min(cells_ - 1, static_cast<int>(x * cells_)),
              j = std::min(cells_ - 1, static_cast<int>(y * cells_));
    const double s = x * cells_ - i, t = y * cells_ - j;
    return (1 - s) * ((1 - t) * value(i, j) + t * value(i, j + 1)) +
           s * ((1 - t) * value(i + 1, j) + t * value(i + 1, j + 1));
  }

 private:
  double value(int i, int j) const { return values_[static_cast<std::size_t>(i * (cells_ + 1) + j)]; }

  int cells_;
  std::vector<double> values_;
};

// Octaves from some radii down to a cell, each with slopes that are about a fixed part of those above it.
EggBox makeRoughBox(test::Random& random) {
  EggBox box{24 + random.below(25), random.uniform(0.1, 0.5), {}, {}};
  const double side = box.cells * box.cell, gain = random.uniform(0.75, 1.15);
  double slope = random.uniform(0.1, 0.6);
  std::vector<Lattice> octaves;
  for (int cells = 2 + random.below(2); cells <= box.cells; cells *= 2, slope *= gain)
    octaves.emplace_back(random, cells, slope * side / cells);
  for (int i = 0; i <= box.cells; ++i) {
    for (int j = 0; j <= box.cells; ++j) {
      double height = 0;
      for (const Lattice& octave : octaves)
        height += octave.at(static_cast<double>(i) / box.cells, static_cast<double>(j) / box.cells);
      box.height.push_back(height);
    }
  }
  for (int i = 0; i < box.cells * box.cells; ++i) box.turned.push_back(random.below(2) == 0);
  return box;
}

// Triangles from the origin to each side of a ring about z, or segments to its corners.
void addRing(Model& model, const std::vector<Vec3>& ring, bool segments) {
  const auto first = static_cast<std::uint32_t>(model.positions.size()), n = static_cast<std::uint32_t>(ring.size());
  model.positions.push_back(Vec3::Zero());
  model.positions.insert(model.positions.end(), ring.begin(), ring.end());
  for (std::uint32_t i = 0; i < n; ++i) {
    if (segments) {
      model.segments.push_back({first, first + 1 + i});
    } else {
      model.triangles.push_back({first, first + 1 + i, first + 1 + (i + 1) % n});
    }
  }
}

// Triangles on one edge along x through the origin.
void addBook(test::Random& random, Model& model, int pages, double size) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  model.positions.insert(model.positions.end(), {Vec3(-size, 0, 0), Vec3(size, 0, 0)});
  for (int i = 0; i < pages; ++i) {
    const double angle = random.uniform(0, 2 * M_PI);
    model.positions.emplace_back(size * random.uniform(-1, 1), size * std::cos(angle), size * std::sin(angle));
    model.triangles.push_back({first, first + 1, first + 2 + static_cast<std::uint32_t>(i)});
  }
}

std::vector<Vec3> makeRing(test::Random& random, int corners, double size) {
  const double width = random.below(4) == 0 ? size * std::pow(10.0, random.uniform(-6, 0)) : size;
  const double tip = random.below(5) == 0 ? 0 : size * random.uniform(-1, 1);
  const double rough = random.below(2) == 0 ? 0 : size * std::pow(10.0, random.uniform(-9, -0.5));
  std::vector<Vec3> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners;
    ring.emplace_back(width * std::cos(angle), width * std::sin(angle), tip + rough * random.uniform(-1, 1));
  }
  return ring;
}

void addEggBox(Model& model, const EggBox& box) {
  for (int i = 0; i < box.cells; ++i) {
    for (int j = 0; j < box.cells; ++j) {
      const Vec3 a = box.node(i, j), b = box.node(i + 1, j), c = box.node(i + 1, j + 1), d = box.node(i, j + 1);
      const bool turned = box.turnedAt(i, j);
      addTriangle(model, a, b, turned ? d : c);
      addTriangle(model, turned ? b : a, c, d);
    }
  }
}

}  // namespace

Rooms makeSoup(test::Random& random) {
  const int n = 6 + random.below(3);
  const Vec3 half = Vec3::Constant(0.5 * kCell * n);
  Rooms rooms{{}, 1.5 * half, [half](const Vec3& p) { return inBox(p, half) ? 0 : kOutside; }};
  forEachSide(Vec3::Zero(), half, [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    addTornSide(random, rooms.model, corner, u, v, n);
  });
  addClutter(random, rooms.model, random.below(120), rooms.half);
  return rooms;
}

Rooms makePlates(test::Random& random) {
  const Vec3 half(8, 8, 10);
  std::vector<double> sheets;
  for (double z = -half.z() + 3; z < half.z() - 0.1;) {
    sheets.push_back(z);
    const int kind = random.below(5);
    z += kind == 0   ? 0
         : kind == 1 ? std::pow(10.0, random.uniform(-9, 0))
         : kind == 2 ? aboutADiameter(random)
                     : random.uniform(0, 6);
  }
  Rooms rooms{{}, half, {}};
  addBox(random, rooms.model, Vec3::Zero(), half);
  const Vec3 u(2 * half.x() + 2, 0, 0), v(0, 2 * half.y() + 2, 0);
  for (const double z : sheets)
    addSheet(random, rooms.model, Vec3(-half.x() - 1, -half.y() - 1, z), u, v, 1 + random.below(4));
  for (int i = random.below(6); i > 0; --i) {
    const Vec3 size(random.uniform(0.1, 4), random.uniform(0.1, 4), std::pow(10.0, random.uniform(-9, -0.5)));
    addBox(random, rooms.model, random.inCube(1).cwiseProduct(half), size);
  }
  addClutter(random, rooms.model, random.below(10), half);
  rooms.room = [half, sheets](const Vec3& p) {
    if (!inBox(p, half)) return kOutside;
    return static_cast<int>(std::lower_bound(sheets.begin(), sheets.end(), p.z()) - sheets.begin());
  };
  return rooms;
}

Rooms makeSlots(test::Random& random) {
  const Vec3 half(16, 5, 12);
  Profile profile{{-half.x() - 1, 0}};
  for (double x = -half.x() + 3; x < half.x() - 12; x = profile.back().first + random.uniform(0, 3))
    random.below(2) == 0 ? addGroove(random, profile, x) : addChannel(random, profile, x);
  profile.emplace_back(half.x() + 1, 0);
  Rooms rooms{{}, half, {}};
  addBox(random, rooms.model, Vec3::Zero(), half);
  const int strips = 1 + random.below(3);
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec3 a(profile[i].first, -half.y() - 1, profile[i].second);
    const Vec3 u(profile[i + 1].first - a.x(), 0, profile[i + 1].second - a.z());
    if (u.norm() > 0) addSheet(random, rooms.model, a, u, Vec3(0, 2 * half.y() + 2, 0), strips);
  }
  addClutter(random, rooms.model, random.below(10), half);
  rooms.room = [half, profile](const Vec3& p) { return !inBox(p, half) ? kOutside : isBelow(profile, p) ? 1 : 0; };
  return rooms;
}

Rooms makeCorners(test::Random& random) {
  const double height = random.uniform(0.2, 4);
  const EggBox egg_box = makeEggBox(random, height);
  const double side = egg_box.cell * (0.5 * egg_box.cells - 0.5);
  const Vec3 half(side, side, height + 6);
  Rooms rooms{{}, half, {}};
  addBox(random, rooms.model, Vec3::Zero(), half);
  addEggBox(rooms.model, egg_box);
  for (int i = random.below(20); i > 0; --i) {
    const Vec3 foot = random.inCube(1).cwiseProduct(half), top = foot + Vec3(0, 0, 6) + random.inCube(1);
    const double width = std::pow(10.0, random.uniform(-6, 0));
    for (int k = 0; k < 3; ++k) addTriangle(rooms.model, foot + random.inCube(width), foot + random.inCube(width), top);
  }
  addClutter(random, rooms.model, random.below(30), half);
  rooms.room = [half, egg_box](const Vec3& p) { return !inBox(p, half) ? kOutside : egg_box.isBelow(p) ? 1 : 0; };
  return rooms;
}

Rooms makeRoughs(test::Random& random) {
  const EggBox terrain = makeRoughBox(random);
  const double side = terrain.cell * (0.5 * terrain.cells - 0.5);
  const double top = *std::max_element(terrain.height.begin(), terrain.height.end());
  const double bottom = *std::min_element(terrain.height.begin(), terrain.height.end());
  const Vec3 half(side, side, std::max(top, -bottom) + 4);
  Rooms rooms{{}, half, {}};
  addBox(random, rooms.model, Vec3::Zero(), half);
  addEggBox(rooms.model, terrain);
  rooms.room = [half, terrain](const Vec3& p) { return !inBox(p, half) ? kOutside : terrain.isBelow(p) ? 1 : 0; };
  return rooms;
}

Rooms makeApexes(test::Random& random) {
  constexpr double kMaxDegreeLg = 3;
  const int degree = 3 + static_cast<int>(std::pow(10.0, random.uniform(0, kMaxDegreeLg)) - 1);
  const double size = std::pow(10.0, random.uniform(-1, 1));
  const Vec3 half = Vec3::Constant(size + 4);
  Rooms rooms{{}, half, [half](const Vec3& p) { return inBox(p, half) ? 0 : kOutside; }, {Vec3::Zero()}};
  addBox(random, rooms.model, Vec3::Zero(), half);
  if (random.below(5) == 0) {
    addBook(random, rooms.model, degree, size);
  } else {
    addRing(rooms.model, makeRing(random, degree, size), random.below(5) == 0);
  }
  return rooms;
}

}  // namespace hl::soak

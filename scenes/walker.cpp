#include "walker.h"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/plain_math.h"

namespace hl {

namespace {

// Collects flat-shaded parts: every triangle has its own vertices.
class Builder {
 public:
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(model_.positions.size());
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (const Vec3& p : {a, b, c}) {
      model_.positions.push_back(p);
      model_.normals.push_back(normal);
    }
    model_.triangles.push_back({first, first + 1, first + 2});
  }
  void plate(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  // A box whose top (towards +y) is smaller by `taper` in x and z: 12 triangles.
  void box(const Vec3& centre, const Vec3& half, double taper = 1) {
    std::array<Vec3, 8> p;
    for (std::size_t i = 0; i < 8; ++i) {
      const double t = (i & 2) != 0 ? taper : 1;
      p[i] = centre + Vec3((i & 1) != 0 ? t * half.x() : -t * half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                           (i & 4) != 0 ? t * half.z() : -t * half.z());
    }
    plate(p[0], p[2], p[3], p[1]);
    plate(p[4], p[5], p[7], p[6]);
    plate(p[0], p[1], p[5], p[4]);
    plate(p[2], p[6], p[7], p[3]);
    plate(p[0], p[4], p[6], p[2]);
    plate(p[1], p[3], p[7], p[5]);
  }
  // A closed cylinder or cone between two centres: 4 triangles per side.
  void cylinder(const Vec3& from, const Vec3& to, double r_from, double r_to, int sides) {
    const Vec3 axis = (to - from).normalized();
    const Vec3 e = axis.unitOrthogonal();
    const Vec3 f = axis.cross(e);
    for (int i = 0; i < sides; ++i) {
      const double a = 2 * M_PI * i / sides;
      const double b = 2 * M_PI * (i + 1) / sides;
      const Vec3 da = plain::cos(a) * e + plain::sin(a) * f;
      const Vec3 db = plain::cos(b) * e + plain::sin(b) * f;
      plate(from + r_from * da, from + r_from * db, to + r_to * db, to + r_to * da);
      triangle(from, from + r_from * db, from + r_from * da);
      triangle(to, to + r_to * da, to + r_to * db);
    }
  }
  std::size_t triangles() const { return model_.triangles.size(); }
  Model take() { return std::move(model_); }

 private:
  Model model_;
};

void addLeg(Builder& b, double x, double z, double stride) {
  const Vec3 hip(x, 0.105, z);
  const Vec3 knee(x + 0.4 * stride, 0.058, z);
  const Vec3 ankle(x + stride, 0.014, z);
  const double out = z > 0 ? 1 : -1;
  const Vec3 side(0, 0, 0.011 * out);
  b.cylinder(hip - side, hip + side, 0.013, 0.013, 40);
  b.cylinder(knee - side, knee + side, 0.010, 0.010, 40);
  b.cylinder(ankle - 0.9 * side, ankle + 0.9 * side, 0.0075, 0.0075, 32);
  b.cylinder(hip, knee, 0.0075, 0.0060, 24);
  b.cylinder(knee, ankle, 0.0060, 0.0050, 24);
  b.box(0.5 * (hip + knee) + Vec3(0.004, 0, 0), Vec3(0.006, 0.019, 0.0065));
  b.box(0.5 * (knee + ankle) + Vec3(0.003, 0, 0), Vec3(0.005, 0.016, 0.0055));
  b.cylinder(ankle - Vec3(0, 0.004, 0), ankle - Vec3(0, 0.010, 0), 0.009, 0.015, 48);
  b.cylinder(ankle - Vec3(0, 0.010, 0), ankle - Vec3(0, 0.014, 0), 0.016, 0.016, 48);
  for (int toe = 0; toe < 4; ++toe) {
    const double a = M_PI / 4 + toe * M_PI / 2;
    b.box(ankle + Vec3(0.016 * plain::cos(a), -0.011, 0.016 * plain::sin(a)), Vec3(0.004, 0.003, 0.004), 0.7);
  }
}

void addBody(Builder& b) {
  b.box(Vec3(0, 0.135, 0), Vec3(0.075, 0.022, 0.034), 0.86);
  b.box(Vec3(0, 0.108, 0), Vec3(0.070, 0.009, 0.030));
  b.box(Vec3(-0.002, 0.158, 0), Vec3(0.060, 0.004, 0.026), 0.8);
  b.box(Vec3(-0.070, 0.132, 0), Vec3(0.010, 0.018, 0.028), 0.8);
  for (const double z : {-0.028, 0.028}) {
    b.cylinder(Vec3(-0.052, 0.105, z), Vec3(0.052, 0.105, z), 0.008, 0.008, 32);
    for (int i = 0; i < 9; ++i)
      b.cylinder(Vec3(-0.048 + 0.012 * i, 0.122, z), Vec3(-0.048 + 0.012 * i, 0.122, z * 1.28), 0.004, 0.004, 16);
  }
}

void addHead(Builder& b) {
  for (int i = 0; i < 5; ++i) {
    const double x = 0.076 + 0.006 * i;
    b.cylinder(Vec3(x, 0.137, 0), Vec3(x + 0.0045, 0.137, 0), 0.011, 0.011, 32);
  }
  b.box(Vec3(0.122, 0.138, 0), Vec3(0.018, 0.015, 0.019), 0.82);
  b.box(Vec3(0.142, 0.133, 0), Vec3(0.008, 0.008, 0.014), 0.9);
  b.box(Vec3(0.148, 0.140, 0), Vec3(0.0035, 0.0022, 0.012));
  for (const double z : {-0.007, 0.007}) {
    b.cylinder(Vec3(0.140, 0.122, z), Vec3(0.168, 0.122, z), 0.0025, 0.0018, 24);
    b.cylinder(Vec3(0.166, 0.122, z), Vec3(0.172, 0.122, z), 0.0030, 0.0030, 24);
  }
  for (const double z : {-0.022, 0.022}) {
    b.cylinder(Vec3(0.112, 0.137, z), Vec3(0.132, 0.137, z), 0.0045, 0.0045, 24);
    b.cylinder(Vec3(0.130, 0.137, z), Vec3(0.152, 0.137, z), 0.0016, 0.0012, 16);
  }
}

// Armour: plates of zero thickness, a little away from the hull and from each other, as many as are needed for the
// total number of triangles.
void addArmour(Builder& b) {
  const std::size_t plates = (kWalkerTriangles - b.triangles()) / 2;
  const std::size_t columns = 48;
  const std::size_t rows = (plates + 2 * columns - 1) / (2 * columns);
  for (std::size_t i = 0; i < plates; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    const std::size_t cell = i / 2;
    const std::size_t row = cell / columns;
    const double w = 0.140 / columns;
    const double h = 0.040 / static_cast<double>(rows);
    const double x = -0.070 + w * static_cast<double>(cell % columns);
    const double y = 0.114 + h * static_cast<double>(row);
    const double z = side * (0.0352 - 0.11 * (y - 0.114) + 0.0004 * static_cast<double>(cell % 3));
    const Vec3 right(side * 0.93 * w, 0, 0);
    const Vec3 up(0, 0.93 * h, -side * 0.10 * h);
    const Vec3 corner(side > 0 ? x : x + w, y, z);
    b.plate(corner, corner + right, corner + right + up, corner + up);
  }
}

}  // namespace

Model makeWalker() {
  Builder builder;
  addBody(builder);
  addHead(builder);
  addLeg(builder, 0.052, 0.026, 0.016);
  addLeg(builder, 0.052, -0.026, -0.008);
  addLeg(builder, -0.052, 0.026, -0.012);
  addLeg(builder, -0.052, -0.026, 0.012);
  addArmour(builder);
  assert(builder.triangles() == kWalkerTriangles);
  Model model = builder.take();
  model.name = "walker";
  return model;
}

}  // namespace hl

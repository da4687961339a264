// A liver that this program bends: a lattice of springs, solved at 30 Hz from the forces that the hand has felt, and
// felt at the rate of the servo. docs/tissue.md explains how.
//
//   14_liver [URL [SECONDS]]
#include <Eigen/Sparse>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <hl/hl.hpp>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

namespace {

enum Object : HLuint { kLiver = 1 };
constexpr int kSide = 25;  // nodes
constexpr double kWidth_m = 0.12;
constexpr double kNeighbour_N_m = 100;  // springs between neighbours ...
constexpr double kGround_N_m = 3;       // ... and from each node to where it rests; together about 200 N/m at a point
constexpr double kFrames_Hz = 30;

int nodeAt(int row, int column) { return row * kSide + column; }

// Nodes on a dome that move along y: A u = f.
class Liver {
 public:
  Liver() : u_m_(Eigen::VectorXd::Zero(kSide * kSide)) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto join = [&](int a, int b) {
      for (const auto& [row, column, sign] : {std::tuple(a, a, 1), {b, b, 1}, {a, b, -1}, {b, a, -1}})
        entries.emplace_back(row, column, sign * kNeighbour_N_m);
    };
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        const int node = nodeAt(row, column);
        entries.emplace_back(node, node, kGround_N_m);
        if (row + 1 < kSide) join(node, nodeAt(row + 1, column));
        if (column + 1 < kSide) join(node, nodeAt(row, column + 1));
      }
    }
    Eigen::SparseMatrix<double> stiffness(kSide * kSide, kSide * kSide);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    solver_.compute(stiffness);
  }

  // Where it is under the forces of the hand.
  void press(const std::vector<HLcontactforce>& contacts) {
    Eigen::VectorXd load_N = Eigen::VectorXd::Zero(kSide * kSide);
    for (const HLcontactforce& contact : contacts) {
      if (contact.object == kLiver) load_N -= contact.force[1] * weightsOf(contact);
    }
    u_m_ = solver_.solve(load_N);
  }
  // m/N at the place of a contact: how far it goes down for each newton there.
  double complianceAt(const HLcontactforce& contact) const {
    const Eigen::VectorXd weights = weightsOf(contact);
    return weights.dot(solver_.solve(weights));
  }
  double deepest_m() const { return -u_m_.minCoeff(); }

  std::vector<double> vertices() const {
    std::vector<double> xyz;
    for (int node = 0; node < kSide * kSide; ++node) {
      const double x = (1.0 * (node % kSide) / (kSide - 1) - 0.5) * kWidth_m;
      const double z = (0.5 - 1.0 * (node / kSide) / (kSide - 1)) * kWidth_m;
      const double rest = 0.03 - 4 * (x * x + z * z);
      xyz.insert(xyz.end(), {x, rest + u_m_[node], z});
    }
    return xyz;
  }

 private:
  static Eigen::VectorXd weightsOf(const HLcontactforce& contact) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(kSide * kSide);
    for (HLuint i = 0; i < contact.vertex_count; ++i) weights[contact.vertices[i]] += contact.weights[i];
    return weights;
  }

  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  Eigen::VectorXd u_m_;
};

void define(const Liver& liver) {
  const std::vector<double> vertices = liver.vertices();
  std::vector<HLuint> triangles;
  for (int row = 0; row + 1 < kSide; ++row) {
    for (int column = 0; column + 1 < kSide; ++column) {
      const auto at = [&](int down, int right) { return static_cast<HLuint>(nodeAt(row + down, column + right)); };
      triangles.insert(triangles.end(), {at(0, 0), at(0, 1), at(1, 1), at(0, 0), at(1, 1), at(1, 0)});
    }
  }
  hlNewObject(kLiver);
  hlVertexPointer(3, HL_DOUBLE, 0, vertices.data());
  hlEnableClientState(HL_VERTEX_ARRAY);
  hlDrawElements(HL_TRIANGLES, static_cast<HLsizei>(triangles.size()), HL_UNSIGNED_INT, triangles.data());
  hlDisableClientState(HL_VERTEX_ARRAY);
  hlEndObject();
}

// One frame: from the forces since the last one to the mesh that they make, and how it yields until the next.
void bend(Liver& liver) {
  const hl::ContactReport report = hl::takeContactReport();
  liver.press(report.contacts);
  const std::vector<double> vertices = liver.vertices();
  hlUpdateVertices(kLiver, 0, kSide * kSide, vertices.data(), nullptr);
  const auto touched = std::find_if(report.contacts.begin(), report.contacts.end(),
                                    [](const HLcontactforce& contact) { return contact.object == kLiver; });
  if (touched != report.contacts.end()) {
    const double compliance_m_N = liver.complianceAt(*touched);
    hlCompliance(kLiver, compliance_m_N, compliance_m_N, nullptr);  // nullptr: for the forces of this very report
    std::printf("pressed: %.2f N, %.1f mm deep, %.0f N/m there\n", report.mean.force[1], 1e3 * liver.deepest_m(),
                1 / compliance_m_N);
  } else {
    const double none_N[3] = {0, 0, 0};
    hlCompliance(kLiver, 1 / kNeighbour_N_m, 1 / kNeighbour_N_m, none_N);  // until it is known where it is touched
  }
  hlFlush();
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10;
  hl::Context context(url);
  hlWorkspaced(0, 0.03, 0, 1);
  hlStateRate(kFrames_Hz);
  hlKeepContactReport(HL_TRUE);
  Liver liver;
  define(liver);
  hlCallObject(kLiver);
  for (int i = 0; i < kFrames_Hz * seconds; ++i) {
    // Nobody holds the simulated device of inproc:, so the program does, and presses up and down.
    if (url.starts_with("inproc:")) hlHandGoal3d(0.01, 0.03 - 0.015 * (1 - std::cos(0.1 * i)) + 0.01, 0);
    context.poll();
    bend(liver);
    std::this_thread::sleep_for(std::chrono::duration<double>(1 / kFrames_Hz));
  }
  hl::check();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "14_liver: %s\n", error.what());
  return 2;
}

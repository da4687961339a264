#include "cad/cad_mesh.h"

#include <fmt/core.h>
#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Poly_Triangulation.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "cad/cad_face.h"
#include "cad/cad_progress.h"

namespace hl {

namespace {

constexpr double kEstimatePart = 0.1, kMeshPart = 0.9;  // of the whole, at their ends

// Of the coarse mesh that shows how large the fine one would be: a chord of it is this many times as far from its
// curve. The angle goes with the root of it.
constexpr double kCoarse = 64;
// Of a shape that is large for its deflection that mesh may be too much itself. The first is no finer than this part of
// the shape, each one after it by kFiner.
constexpr double kFirst = 1e-3, kFiner = 8;
// Of the processor, for all meshes: the reading process has 120 s.
constexpr double kMost_s = 90;
// Where nobody has asked for a deflection, nobody is to wait for so long: in triangles of small faces, some 14 us each.
// By counts and not by the clock, so that a file is the same mesh everywhere.
constexpr double kUnaskedWork = 700'000;

void makeMesh(const TopoDS_Shape& shape, const CadMeshing& meshing, const Message_ProgressRange& progress) {
  IMeshTools_Parameters parameters;
  parameters.Deflection = meshing.deflection_m / kCadUnit_m;
  parameters.Angle = meshing.angle_rad;
  parameters.AngleInterior = meshing.angle_rad;
  BRepMesh_IncrementalMesh(shape, parameters, progress);
}

// How the number of its triangles grows as the deflection becomes finer: with this power of their ratio.
double growthOf(const TopoDS_Face& face) {
  const GeomAbs_SurfaceType kind = BRepAdaptor_Surface(face, false).GetType();
  const bool straight = kind == GeomAbs_Plane || kind == GeomAbs_Cylinder || kind == GeomAbs_Cone;
  return straight ? 0.5 : 1;
}

struct FaceEstimate {
  double coarse_triangles = 0;  // of the coarse mesh
  double growth = 1;

  /// Where the deflection is 1 / `ratio` of the coarse one.
  double triangles(double ratio) const { return coarse_triangles * std::pow(ratio, growth); }
};

// Of a mesh.
struct MeshLimits {
  std::size_t triangles = 0;
  double time_s = kMost_s;  // of the processor
};

// What a coarse mesh shows of finer ones.
struct MeshEstimate {
  double coarse_m = 0;  // its deflection
  double coarse_s = 0;  // of the processor
  std::vector<FaceEstimate> faces;

  double triangles(double deflection_m) const {
    double sum = 0;
    for (const FaceEstimate& face : faces) sum += face.triangles(coarse_m / deflection_m);
    return sum;
  }
  double time_s(double deflection_m) const { return coarse_s * work(deflection_m) / std::max(1.0, work(coarse_m)); }
  bool fits(double deflection_m, const MeshLimits& most) const {
    return triangles(deflection_m) <= static_cast<double>(most.triangles) && time_s(deflection_m) <= most.time_s;
  }
  /// In triangles of small faces. Of a face of n it is n (1 + n / 70 000): measured of a sphere of 18 000 to 590 000.
  double work(double deflection_m) const {
    constexpr double kOfTwiceTheTime = 70'000;
    double sum = 0;
    for (const FaceEstimate& face : faces) {
      const double of_face = face.triangles(coarse_m / deflection_m);
      sum += of_face * (1 + of_face / kOfTwiceTheTime);
    }
    return sum;
  }
  /// The finest one from this on that fits.
  double finestThatFits_m(double deflection_m, const MeshLimits& most) const {
    while (!fits(deflection_m, most) && deflection_m < kMaxDeflection_m) deflection_m *= 2;
    return deflection_m;
  }
  /// As fits(), with the growth from a mesh still coarser to this one: where angles decide, it is less.
  bool fitsAsItGrew(const MeshEstimate& coarser, double deflection_m, const MeshLimits& most) const {
    const double growth =
        std::log(coarseTriangles() / coarser.coarseTriangles()) / std::log(coarser.coarse_m / coarse_m);
    const double more = std::pow(coarse_m / deflection_m, std::clamp(growth, 0.0, 1.0));
    return more * coarseTriangles() <= static_cast<double>(most.triangles) && more * coarse_s <= most.time_s;
  }

 private:
  double coarseTriangles() const { return std::max(1.0, triangles(coarse_m)); }
};

double processorTime_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

MeshEstimate estimateBy(double coarse_m, const TopoDS_Shape& shape, const CadMeshing& meshing,
                        const Message_ProgressRange& progress) {
  constexpr double kWidest_rad = 1;
  const double begin_s = processorTime_s(), wider = std::sqrt(coarse_m / meshing.deflection_m);
  makeMesh(shape, {coarse_m, std::min(kWidest_rad, wider * meshing.angle_rad)}, progress);
  MeshEstimate estimate{coarse_m, processorTime_s() - begin_s, {}};
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
    const TopoDS_Face face = TopoDS::Face(at.Current());
    TopLoc_Location place;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
    if (!mesh.IsNull()) estimate.faces.push_back({static_cast<double>(mesh->NbTriangles()), growthOf(face)});
  }
  BRepTools::Clean(shape);
  return estimate;
}

double sizeOf_m(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  const double size_m = box.IsVoid() ? 0 : kCadUnit_m * std::sqrt(box.SquareExtent());
  if (!std::isfinite(size_m)) throw Error("has no finite size: the file is corrupt");
  return size_m;
}

// Ends where it is seen that the mesh does not fit.
MeshEstimate estimateMesh(const TopoDS_Shape& shape, const CadMeshing& meshing, const MeshLimits& most,
                          const std::function<void(double)>& report) {
  const double finest_m = kCoarse * meshing.deflection_m;
  std::optional<MeshEstimate> coarser;
  for (double coarse_m = std::max(finest_m, kFirst * sizeOf_m(shape));;
       coarse_m = std::max(finest_m, coarse_m / kFiner)) {
    CadProgress progress(report, 0, kEstimatePart);
    MeshEstimate estimate = estimateBy(coarse_m, shape, meshing, progress.begin());
    const bool too_large = coarser && !estimate.fits(meshing.deflection_m, most) &&
                           !estimate.fitsAsItGrew(*coarser, meshing.deflection_m, most);
    if (coarse_m <= finest_m || too_large) return estimate;
    coarser = std::move(estimate);
  }
}

// Throws if a mesh as it is asked for would have too many triangles or take too long.
void requireFits(const MeshEstimate& estimate, const CadMeshing& meshing, const MeshLimits& most) {
  if (estimate.fits(meshing.deflection_m, most)) return;
  throw Error(fmt::format(
      "makes about {:.2g} million triangles at a deflection of {:.2g} m, in {:.0f} s; at most {:.2g} "
      "million in {:.0f} s can be: --deflection {:.2g} fits",
      1e-6 * estimate.triangles(meshing.deflection_m), meshing.deflection_m, estimate.time_s(meshing.deflection_m),
      1e-6 * static_cast<double>(most.triangles), most.time_s, estimate.finestThatFits_m(meshing.deflection_m, most)));
}

std::string coarserWarning(const MeshEstimate& estimate, const CadMeshing& meshing) {
  const double usual_m = CadMeshing{}.deflection_m;
  return fmt::format(
      "is meshed with a deflection of {:.2g} m, as that of {:.2g} m would make {:.2g} million triangles in {:.0f} s: "
      "--deflection chooses another",
      meshing.deflection_m, usual_m, 1e-6 * estimate.triangles(usual_m), estimate.time_s(usual_m));
}

std::size_t countOf(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  std::size_t count = 0;
  for (TopExp_Explorer at(shape, kind); at.More(); at.Next()) ++count;
  return count;
}

// Puts the triangles of faces together, and counts.
class MeshCollection {
 public:
  MeshCollection(const TopoDS_Shape& shape, const CadMeshing& meshing, const std::function<void(double)>& report)
      : meshing_(meshing), report_(report), reading_{meshing.deflection_m, meshing.angle_rad} {
    ShapeAnalysis_ShapeTolerance tolerance;
    reading_.tolerance_m = kCadUnit_m * tolerance.Tolerance(shape, 1);
    reading_.solids = countOf(shape, TopAbs_SOLID);
    reading_.faces = countOf(shape, TopAbs_FACE);
  }

  /// The faces of a shape that belong to nothing of the kind `beside`, and its edges without faces.
  void add(const TopoDS_Shape& shape, TopAbs_ShapeEnum beside = TopAbs_SHAPE) {
    for (TopExp_Explorer at(shape, TopAbs_FACE, beside); at.More(); at.Next()) {
      const std::optional<double> error_m = appendFace(TopoDS::Face(at.Current()), model_);
      if (!error_m) ++lacking_;
      reading_.error_m = std::max(reading_.error_m, error_m.value_or(0));
      report_(kMeshPart +
              (1 - kMeshPart) * std::min(1.0, static_cast<double>(++done_) / static_cast<double>(reading_.faces)));
    }
    for (TopExp_Explorer at(shape, TopAbs_EDGE, TopAbs_FACE); at.More(); at.Next())
      appendEdge(TopoDS::Edge(at.Current()), meshing_, model_);
  }

  /// What has been added since the last part is one.
  void endPart(const std::string& name, const std::optional<Rgb>& colour) {
    const auto added = [](std::size_t now, std::size_t& before) {
      return static_cast<std::uint32_t>(now - std::exchange(before, now));
    };
    ModelPart part{name, colour};
    part.vertices = added(model_.positions.size(), vertices_);
    part.triangles = added(model_.triangles.size(), triangles_);
    part.segments = added(model_.segments.size(), segments_);
    if (part.triangles + part.segments > 0) model_.parts.push_back(std::move(part));
  }

  Model take() {
    if (lacking_ > 0)
      model_.warnings.push_back(
          fmt::format("{} of {} faces cannot be meshed: nothing is there", lacking_, reading_.faces));
    model_.reading.cad = reading_;
    return std::move(model_);
  }

 private:
  const CadMeshing& meshing_;
  const std::function<void(double)>& report_;
  CadReading reading_;
  Model model_;
  std::size_t lacking_ = 0, done_ = 0, vertices_ = 0, triangles_ = 0, segments_ = 0;
};

Model collectMesh(const CadShape& cad, const CadMeshing& meshing, const std::function<void(double)>& report) {
  MeshCollection mesh(cad.shape, meshing, report);
  const bool apart = !cad.solids.empty() && cad.solids.size() < kMaxModelParts;
  if (!apart) {
    mesh.add(cad.shape);
    return mesh.take();
  }
  for (const CadSolid& solid : cad.solids) {
    mesh.add(solid.shape);
    mesh.endPart(solid.name, solid.colour);
  }
  mesh.add(cad.shape, TopAbs_SOLID);
  mesh.endPart("what is no solid", {});
  return mesh.take();
}

// Triangles may be farther from their surface than edges from their curves: then finer edges are tried, as long as that
// fits.
Model meshWithin(const CadShape& cad, const CadMeshing& meshing, const MeshEstimate& estimate, const MeshLimits& most,
                 const std::function<void(double)>& report) {
  constexpr int kTries = 3;
  constexpr double kMargin = 0.9, kFinest = 0.25;
  const double begin_s = processorTime_s();
  double finer = 1;
  for (int i = 1;; ++i) {
    CadProgress progress(report, kEstimatePart, kMeshPart);
    BRepTools::Clean(cad.shape);
    makeMesh(cad.shape, {finer * meshing.deflection_m, meshing.angle_rad}, progress.begin());
    Model model = collectMesh(cad, meshing, report);
    const CadReading& reading = *model.reading.cad;
    if (i == kTries || reading.error_m <= meshing.deflection_m + reading.tolerance_m) return model;
    finer *= std::max(kFinest, kMargin * meshing.deflection_m / reading.error_m);
    const MeshLimits left{most.triangles, most.time_s - (processorTime_s() - begin_s)};
    if (!estimate.fits(finer * meshing.deflection_m, left)) return model;
    if (!meshing.asked && estimate.work(finer * meshing.deflection_m) > kUnaskedWork) return model;
  }
}

}  // namespace

Model meshCad(const CadShape& cad, const CadMeshing& meshing, const std::function<void(double)>& report,
              std::size_t most_triangles) {
  try {
    BRepTools::Clean(cad.shape);
    const MeshLimits most{most_triangles};
    const double begin_s = processorTime_s();
    const MeshEstimate estimate = estimateMesh(cad.shape, meshing, most, report);
    CadMeshing fitting = meshing;
    while (!meshing.asked && estimate.work(fitting.deflection_m) > kUnaskedWork &&
           fitting.deflection_m < kMaxDeflection_m)
      fitting.deflection_m *= 2;
    requireFits(estimate, fitting, most);
    const double left_s = most.time_s - (processorTime_s() - begin_s);
    Model model = meshWithin(cad, fitting, estimate, {most_triangles, left_s}, report);
    if (fitting.deflection_m != meshing.deflection_m) model.warnings.push_back(coarserWarning(estimate, fitting));
    return model;
  } catch (const Standard_Failure& failure) {
    throw Error(fmt::format("cannot be meshed: {}", failure.DynamicType()->Name()));
  }
}

}  // namespace hl

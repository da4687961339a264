#include "cad/read_cad_shape.h"

#include <fmt/core.h>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <fstream>

#include "base/error.h"
#include "cad/cad_progress.h"
#include "io/sandbox.h"

namespace hl {

namespace {

constexpr double kReadPart = 0.5;  // of the time, before shapes are made of what was read

// All roots of a file as one shape. Their number is told where some give none.
TopoDS_Shape transferred(XSControl_Reader& reader, std::vector<std::string>& warnings,
                         const std::function<void(double)>& report) {
  CadProgress progress(report, kReadPart, 1);
  const int roots = reader.NbRootsForTransfer();
  const int made = reader.TransferRoots(progress.begin());
  if (made < roots) warnings.push_back(fmt::format("{} of {} shapes in it cannot be made", roots - made, roots));
  return reader.OneShape();
}

TopoDS_Shape readStep(const std::string& path, std::vector<std::string>& warnings,
                      const std::function<void(double)>& report) {
  std::ifstream in(path, std::ios::binary);
  if (!forbidOpening()) throw Error(kNoFilters);
  STEPControl_Reader reader;
  if (reader.ReadStream("file", in) != IFSelect_RetDone) throw Error("cannot be understood: it is no sound STEP file");
  report(kReadPart);
  return transferred(reader, warnings, report);
}

// It cannot be read but by its name.
TopoDS_Shape readIges(const std::string& path, std::vector<std::string>& warnings,
                      const std::function<void(double)>& report) {
  IGESControl_Reader reader;
  const IFSelect_ReturnStatus status = reader.ReadFile(path.c_str());
  if (!forbidOpening()) throw Error(kNoFilters);
  if (status != IFSelect_RetDone) throw Error("cannot be understood: it is no sound IGES file");
  report(kReadPart);
  return transferred(reader, warnings, report);
}

TopoDS_Shape readBrep(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!forbidOpening()) throw Error(kNoFilters);
  TopoDS_Shape shape;
  BRepTools::Read(shape, in, BRep_Builder());
  return shape;
}

TopoDS_Shape readShape(const ModelFile& file, std::vector<std::string>& warnings,
                       const std::function<void(double)>& report) {
  if (file.ending == ".brep") return readBrep(file.path);
  const bool iges = file.ending == ".iges" || file.ending == ".igs";
  return iges ? readIges(file.path, warnings, report) : readStep(file.path, warnings, report);
}

}  // namespace

CadShape readCadShape(const ModelFile& file, const std::function<void(double)>& report) {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  CadShape cad;
  try {
    cad.shape = readShape(file, cad.warnings, report);
  } catch (const Standard_Failure& failure) {
    throw Error(fmt::format("cannot be understood: {}: the file is corrupt", failure.DynamicType()->Name()));
  }
  if (cad.shape.IsNull()) throw Error("there is no shape in it that can be made: the file is empty or corrupt");
  return cad;
}

}  // namespace hl

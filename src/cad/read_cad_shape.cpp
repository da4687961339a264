#include "cad/read_cad_shape.h"

#include <fmt/core.h>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESBasic_Group.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fstream>

#include "base/error.h"
#include "cad/cad_document.h"
#include "cad/cad_progress.h"
#include "cad/check_iges.h"
#include "io/mapped_file.h"
#include "io/sandbox.h"

namespace hl {

namespace {

constexpr double kReadPart = 0.5;  // of the time, before shapes are made of what was read

// Some programs write IGES with an empty group beside the one of all parts.
bool isEmptyGroup(const Handle(Standard_Transient) & root) {
  const Handle(IGESBasic_Group) group = Handle(IGESBasic_Group)::DownCast(root);
  return !group.IsNull() && group->NbEntities() == 0;
}

int lostRoots(XSControl_Reader& roots) {
  const Handle(Transfer_TransientProcess)& made = roots.WS()->TransferReader()->TransientProcess();
  int lost = 0;
  for (int i = 1; i <= roots.NbRootsForTransfer(); ++i) {
    const Handle(Standard_Transient) root = roots.RootForTransfer(i);
    lost += made->IsBound(root) || isEmptyGroup(root) ? 0 : 1;
  }
  return lost;
}

// All of a file, with the names and colours of its solids. The number of its roots is reported where some give none.
template <typename Reader>
void transfer(Reader& reader, XSControl_Reader& roots, CadShape& cad, const std::function<void(double)>& report) {
  report(kReadPart);
  reader.SetNameMode(Standard_True);
  reader.SetColorMode(Standard_True);
  Handle(TDocStd_Document) document = newCadDocument();
  CadProgress progress(report, kReadPart, 1);
  reader.Transfer(document, progress.begin());
  const int wanted = roots.NbRootsForTransfer(), lost = lostRoots(roots);
  if (lost > 0) cad.warnings.push_back(fmt::format("{} of {} shapes in it cannot be made", lost, wanted));
  cad.shape = wholeShape(document);
  cad.solids = solidsIn(document);
}

void readStep(const std::string& path, CadShape& cad, const std::function<void(double)>& report) {
  std::ifstream in(path, std::ios::binary);
  if (!forbidOpening()) throw Error(kNoFilters);
  STEPCAFControl_Reader reader;
  if (reader.ChangeReader().ReadStream("file", in) != IFSelect_RetDone)
    throw Error("cannot be understood: it is no sound STEP file");
  transfer(reader, reader.ChangeReader(), cad, report);
}

// It cannot be read but by its name.
void readIges(const std::string& path, CadShape& cad, const std::function<void(double)>& report) {
  checkIges(MappedFile(path).bytes());
  IGESCAFControl_Reader reader;
  const IFSelect_ReturnStatus status = reader.ReadFile(path.c_str());
  if (!forbidOpening()) throw Error(kNoFilters);
  if (status != IFSelect_RetDone) throw Error("cannot be understood: it is no sound IGES file");
  transfer(reader, reader, cad, report);
}

void readBrep(const std::string& path, CadShape& cad) {
  std::ifstream in(path, std::ios::binary);
  if (!forbidOpening()) throw Error(kNoFilters);
  in.exceptions(std::ios::badbit | std::ios::failbit);  // its reader goes on for ever where a number is missing
  try {
    BRepTools::Read(cad.shape, in, BRep_Builder());
  } catch (const std::ios::failure&) {
    throw Error("ends early, or has no number where one must be: it is cut or corrupt");
  }
  if (!cad.shape.IsNull()) cad.solids = solidsIn(cad.shape);
}

void readShape(const ModelFile& file, CadShape& cad, const std::function<void(double)>& report) {
  if (file.ending == ".brep") return readBrep(file.path, cad);
  const bool iges = file.ending == ".iges" || file.ending == ".igs";
  iges ? readIges(file.path, cad, report) : readStep(file.path, cad, report);
}

}  // namespace

CadShape readCadShape(const ModelFile& file, const std::function<void(double)>& report) {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  CadShape cad;
  try {
    readShape(file, cad, report);
  } catch (const Standard_Failure& failure) {
    throw Error(fmt::format("cannot be understood: {}: the file is corrupt", failure.DynamicType()->Name()));
  }
  if (cad.shape.IsNull()) throw Error("there is no shape in it that can be made: the file is empty or corrupt");
  return cad;
}

}  // namespace hl

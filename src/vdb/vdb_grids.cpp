#include "vdb/vdb_grids.h"

#include <fmt/core.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/NanoToOpenVDB.h>
#include <openvdb/io/Stream.h>

#include <algorithm>
#include <fstream>

#include "base/error.h"
#include "io/sandbox.h"
#include "io/text_words.h"

namespace hl {

namespace {

using openvdb::FloatGrid;

std::string listed(const std::vector<GridInFile>& grids) {
  constexpr std::size_t kMaxListed = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(grids.size(), kMaxListed); ++i)
    text += fmt::format("{}'{}' of {}", i == 0 ? "" : ", ", shown(grids[i].name), shown(grids[i].type));
  return text + (grids.size() > kMaxListed ? ", ..." : "");
}

FloatGrid::Ptr floatsOf(const openvdb::GridBase::Ptr& grid) {
  FloatGrid::Ptr floats = openvdb::gridPtrCast<FloatGrid>(grid);
  if (!floats) throw Error("is not a sound file: a grid in it has another type than it says");
  return floats;
}

FloatGrid::Ptr readOpenVdb(std::istream& in, const std::string& name) {
  openvdb::initialize();
  in.exceptions(std::ios::failbit | std::ios::badbit);  // OpenVDB does not look whether the file has ended
  openvdb::io::Stream file(in, false);                  // all at once: nothing is read later, from a copy of the file
  const openvdb::GridPtrVecPtr all = file.getGrids();
  std::vector<GridInFile> grids;
  for (const openvdb::GridBase::Ptr& grid : *all)
    grids.push_back({grid->getName(), grid->valueType(), grid->isType<FloatGrid>(),
                     grid->getGridClass() == openvdb::GRID_LEVEL_SET});
  return floatsOf((*all)[chosenGrid(grids, name)]);
}

// Of all that a NanoVDB file may hold, what becomes floats: OpenVDB's own function would make the code for all of it.
template <typename... Builds>
struct FloatBuilds {
  static bool has(nanovdb::GridType type) { return ((type == nanovdb::mapToGridType<Builds>()) || ...); }

  static FloatGrid::Ptr read(const nanovdb::GridHandle<>& handle) {
    FloatGrid::Ptr grid;
    ((grid = grid ? grid : readAs<Builds>(handle)), ...);
    return grid;
  }

 private:
  template <typename Build>
  static FloatGrid::Ptr readAs(const nanovdb::GridHandle<>& handle) {
    const auto* const grid = handle.grid<Build>();
    return grid != nullptr ? nanovdb::nanoToOpenVDB(*grid) : nullptr;
  }
};
using NanoFloats = FloatBuilds<float, nanovdb::Fp4, nanovdb::Fp8, nanovdb::Fp16, nanovdb::FpN>;

FloatGrid::Ptr readNanoVdb(std::istream& in, const std::string& name) {
  std::vector<GridInFile> grids;
  for (const auto& grid : nanovdb::io::readGridMetaData(in))
    grids.push_back({grid.gridName, nanovdb::toStr(grid.gridType), NanoFloats::has(grid.gridType),
                     grid.gridClass == nanovdb::GridClass::LevelSet});
  const std::size_t chosen = chosenGrid(grids, name);
  in.clear();
  in.seekg(0);
  return floatsOf(NanoFloats::read(nanovdb::io::readGrid(in, chosen)));
}

// OpenVDB says what is wrong with what it has read, in words for those who program with it: "IoError: not a VDB file".
// Of these a user needs to know whether the file is another one, or broken.
std::string reasonOf(std::string_view what) {
  const auto says = [&](const char* word) { return what.find(word) != std::string_view::npos; };
  if (says("not a VDB file") || says("magic")) return "is not an OpenVDB or NanoVDB file";
  if (says("version")) return fmt::format("is of a version that cannot be read ({}): save it anew", shown(what));
  return "is not a sound file: it is corrupt or cut, or has a grid of an unknown kind: save it anew";
}

}  // namespace

std::size_t chosenGrid(const std::vector<GridInFile>& grids, const std::string& name) {
  if (grids.empty()) throw Error("has no grid in it");
  if (!name.empty()) {
    const auto found = std::find_if(grids.begin(), grids.end(), [&](const auto& grid) { return grid.name == name; });
    if (found == grids.end()) throw Error(fmt::format("has no grid '{}'; it has {}", shown(name), listed(grids)));
    if (!found->floats)
      throw Error(fmt::format("has {} in its grid '{}': one of float can be touched", found->type, shown(name)));
    return static_cast<std::size_t>(found - grids.begin());
  }
  for (const bool level_set : {true, false}) {
    const auto fits = [&](const GridInFile& grid) { return grid.floats && (grid.level_set || !level_set); };
    const auto count = std::count_if(grids.begin(), grids.end(), fits);
    if (count > 1)
      throw Error(fmt::format("has several grids: say which (--grid NAME, or \"grid\" in a scene file); it has {}",
                              listed(grids)));
    if (count == 1) return static_cast<std::size_t>(std::find_if(grids.begin(), grids.end(), fits) - grids.begin());
  }
  throw Error(fmt::format("has no grid of float, which could be touched; it has {}", listed(grids)));
}

FloatGrid::Ptr readVdbGrid(const ModelFile& file, const std::string& name) {
  std::ifstream in(file.path, std::ios::binary);
  if (file.alone && !forbidOpening()) throw Error(kNoFilters);
  try {
    return file.ending == ".nvdb" ? readNanoVdb(in, name) : readOpenVdb(in, name);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(reasonOf(error.what()));
  }
}

}  // namespace hl

#include "io/read_clouds.h"

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace hl {

namespace {

using ReadCloud = void (*)(const ModelFile&, CloudSink&);
constexpr std::array<std::pair<std::string_view, ReadCloud>, 5> kCloudReaders{
    {{".las", readLas}, {".pcd", readPcd}, {".xyz", readXyz}, {".pts", readXyz}, {".ply", readPlyPoints}}};

ReadCloud cloudReaderOf(const std::string& ending) {
  for (const auto& [of, read] : kCloudReaders) {
    if (of == ending) return read;
  }
  return nullptr;
}

}  // namespace

bool readsClouds(const std::string& ending) { return ending != ".ply" && cloudReaderOf(ending) != nullptr; }

std::string cloudAdvice(const std::string& ending) {
  if (ending == ".laz") return "is packed LAS, which cannot be read: unpack it, as in laszip -i a.laz -o a.las";
  if (ending == ".e57") return "is E57, which cannot be read: convert it to PLY or LAS, as CloudCompare does";
  if (ending == ".txt" || ending == ".csv")
    return "files ending in '" + ending +
           "' cannot be read; a list of points, x y z on each line, can if it is renamed to end in .xyz";
  return {};
}

void readCloud(const ModelFile& file, CloudSink& sink) { cloudReaderOf(file.ending)(file, sink); }

}  // namespace hl

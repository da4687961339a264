#include "io/read_heights.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/error.h"

namespace hl {

namespace {

using Read = void (*)(const ModelFile&, HeightSink&);
constexpr std::array<std::pair<std::string_view, Read>, 6> kHeightReaders{{{".tif", readGeoTiff},
                                                                           {".tiff", readGeoTiff},
                                                                           {".hgt", readSrtm},
                                                                           {".asc", readEsriGrid},
                                                                           {".png", readHeightPng},
                                                                           {".npy", readNumpy}}};

Read readerOf(const std::string& ending) {
  for (const auto& [of, read] : kHeightReaders) {
    if (of == ending) return read;
  }
  return nullptr;
}

}  // namespace

bool readsHeights(const std::string& ending) { return readerOf(ending) != nullptr; }

void readHeights(const ModelFile& file, HeightSink& sink) { readerOf(file.ending)(file, sink); }

GridFrame uprightFrame(const GridSize& size, double east_m, double south_m, double up_m) {
  GridFrame frame;
  frame.axes = Mat3::Zero();
  frame.axes(0, 0) = east_m;
  frame.axes(2, 1) = south_m;
  frame.axes(1, 2) = up_m;
  frame.origin = {-0.5 * east_m * (size.columns - 1.0), 0, -0.5 * south_m * (size.rows - 1.0)};
  return frame;
}

// Series of the lengths of arcs on the ellipsoid.
DegreeLength degreeAt(double latitude_deg) {
  const double phi = latitude_deg * M_PI / 180;
  return {111412.84 * std::cos(phi) - 93.5 * std::cos(3 * phi) + 0.118 * std::cos(5 * phi),
          111132.92 - 559.82 * std::cos(2 * phi) + 1.175 * std::cos(4 * phi)};
}

DegreeLength spacingOfDegrees(double east_deg, double south_deg, double latitude_deg, HeightSink& sink) {
  constexpr double kPole_deg = 89.9;
  if (!(std::abs(latitude_deg) <= kPole_deg)) throw Error("its middle lies at no latitude from -89.9 to 89.9 degrees");
  const DegreeLength degree = degreeAt(latitude_deg);
  const DegreeLength spacing{east_deg * degree.east_m, south_deg * degree.north_m};
  sink.warn(fmt::format("its samples lie in degrees: {:.6g} x {:.6g} m apart, as at its middle, {:.4g} degrees north",
                        spacing.east_m, spacing.north_m, latitude_deg));
  return spacing;
}

}  // namespace hl

// Files of heights: GeoTIFF, SRTM .hgt, Esri .asc, 16-bit PNG, NumPy .npy. They are read in one pass, a row or a strip
// at a time, however large they are.
#pragma once

#include <string>

#include "io/height_sink.h"
#include "io/model_file.h"

namespace hl {

/// Whether a reader takes files of this ending (".tif").
bool readsHeights(const std::string& ending);

/// In a process of its own; throws on failure. The middle of the grid is put at x = z = 0, columns to the east (x),
/// rows to the south (z), heights up (y), in metres as the file says.
void readHeights(const ModelFile& file, HeightSink& sink);

// For readHeights().
void readGeoTiff(const ModelFile& file, HeightSink& sink);
void readSrtm(const ModelFile& file, HeightSink& sink);
void readEsriGrid(const ModelFile& file, HeightSink& sink);
void readHeightPng(const ModelFile& file, HeightSink& sink);
void readNumpy(const ModelFile& file, HeightSink& sink);

/// The frame of an upright grid: metres between samples, and metres for a unit of them.
GridFrame uprightFrame(const GridSize& size, double east_m, double south_m, double up_m);

/// Metres for a degree of longitude and of latitude on WGS 84 there, to some centimetres.
struct DegreeLength {
  double east_m, north_m;
};
DegreeLength degreeAt(double latitude_deg);

/// Warns how degrees were made into metres. Returns metres between samples.
DegreeLength spacingOfDegrees(double east_deg, double south_deg, double latitude_deg, HeightSink& sink);

}  // namespace hl

// The header of a GeoTIFF (OGC 19-008r4): where its samples lie, from the tags of GeoTIFF, and what they stand for,
// from GDAL's tags for missing samples and for scale and offset.
#pragma once

#include "io/height_sink.h"
#include "io/tiff_file.h"

namespace hl {

/// Columns lead east (x) and rows south (z) as the file's own map says, so both may lead backward. Throws hl::Error for
/// what cannot be; warns of what is left out.
HeightHeader geotiffHeader(const TiffFile& file, const GridSize& size, HeightSink& sink);

}  // namespace hl

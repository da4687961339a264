// Files of points: LAS, PCD, PLY without faces, and text in columns. They are read in pieces, however large they are; a
// packed PCD is held as a whole.
#pragma once

#include <string>

#include "io/cloud_sink.h"
#include "io/model_file.h"

namespace hl {

/// Whether a reader takes files of this ending (".las") as clouds. Of a .ply, isPlyOfPoints() decides.
bool readsClouds(const std::string& ending);
/// A PLY file whose header has vertices, without lists, and nothing that joins them.
bool isPlyOfPoints(const std::string& path);
/// The same of one whose vertices have lists among their properties, which no reader of clouds takes.
bool isPlyOfListedPoints(const std::string& path);
/// Empty, or what to do with a file of this ending that holds points but cannot be read.
std::string cloudAdvice(const std::string& ending);

/// In a process of its own; throws on failure.
void readCloud(const ModelFile& file, CloudSink& sink);

// For readCloud().
/// LAS 1.0 to 1.4, formats 0 to 10: x to the east, y to the north, z up become +x, -z, +y.
void readLas(const ModelFile& file, CloudSink& sink);
void readPcd(const ModelFile& file, CloudSink& sink);
void readPlyPoints(const ModelFile& file, CloudSink& sink);
/// Text: x y z, and normals and colours where a line of names or the numbers of the first lines show them.
void readXyz(const ModelFile& file, CloudSink& sink);

}  // namespace hl

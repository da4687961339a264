// A companion file: one that another file names, as a header does that has its samples in a file of their own.
#pragma once

#include <string>

namespace hl {

/// Where the file is that the file at `path` calls `name`. It must lie beside that file or in a folder beneath, so that
/// a file from somewhere else cannot have any file of its user read. Throws hl::Error, without the name of the file at
/// `path`, for an absolute name, one with "..", one that a symbolic link leads elsewhere, and one that does not exist,
/// neither as it is nor with its percent signs decoded, as names in a URI are.
std::string companionPath(const std::string& path, const std::string& name);

/// Whether the existing file `file` lies, links followed, in the folder of the file at `path` or in one beneath.
bool isCompanion(const std::string& path, const std::string& file);

}  // namespace hl

// Files that are written beside their place and then put there, so that whoever looks finds them whole or not at all.
#pragma once

#include <string>

namespace hl {

/// In the names of such files.
inline constexpr const char* kBeside = ".part-";

/// A name in the folder of `path` that nobody else has, on no machine.
std::string nameBeside(const std::string& path);
/// Whether it is such a file that a killed program has left: nothing has been written to it for ten minutes.
bool isLeftBeside(const std::string& file);
/// Removes those beside `path`.
void removeBeside(const std::string& path);
/// Puts the file in its place. Throws hl::Error, with the name of the place, and removes it where it cannot.
void putInPlace(const std::string& beside, const std::string& path);

}  // namespace hl

// Model files that were sent to a server: open descriptors without a name on the disk, read by a program of their own
// that can open nothing else.
#pragma once

#include <atomic>
#include <string>

#include "io/cad_file.h"
#include "io/isolated.h"
#include "scene/scene_model.h"

namespace hl {

/// The ending of a file's name that decides what reads it: ".obj" of "A.OBJ", ".hl.json" of a scene file.
std::string sentEndingOf(const std::string& name);
/// Whether one of the readers takes files of this ending.
bool readsSent(const std::string& ending);

/// As loadScene() of a file, but from a process with threads, and without any other file that it names. `program` is
/// one that calls readSent(); `name`, which is that of the scene and for errors, is added to its words. CAD files have
/// a program of their own.
SceneModel loadSent(int descriptor, const std::string& name, ReaderProgram program, const IsolationLimits& limits,
                    const std::atomic<bool>& given_up, const CadMeshing& cad = {});

/// What the program does: reads its standard input, gives the model on its standard output, and ends.
/// `name`: of the file where it was sent from; nothing of this name is opened.
[[noreturn]] void readSent(const std::string& name);

}  // namespace hl

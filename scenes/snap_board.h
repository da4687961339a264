// Snap board: a board on which each kind of snap can be tried, and two fields: two sockets on pins, a rail between
// posts, a curve on the board, a sheet at its end; a block that is lifted by its handle; a magnetic block; a ball of
// drag.
#pragma once

#include "scene/scene_model.h"

namespace hl {

/// y up, the board's top at y = 0; 0.22 m wide.
SceneModel makeSnapBoard();

}  // namespace hl

// Workshop: a table of things that move when they are touched: a door with a latch, a drawer, a row of dominoes, a pile
// of blocks, buttons and a rocker switch, a seesaw, a spinning top, a ball in a bowl, and a soft block.
#pragma once

#include "scene/scene_model.h"

namespace hl {

/// y up, the table's top at y = 0; 0.3 m wide.
SceneModel makeWorkshop();

}  // namespace hl

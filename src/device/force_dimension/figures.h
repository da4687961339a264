// Figures of Force Dimension's devices, by the type that the library gives.
#pragma once

#include "device/device.h"

namespace hl {

/// All but the name. Of a type that is not known: the weakest of those that are.
DeviceInfo forceDimensionFigures(int system_type);

}  // namespace hl

// Options of the force: the user's limits, what has to be held, the effects of the servo. The same for hl and hld.
#pragma once

#include <CLI/CLI.hpp>

#include "control/servo_options.h"

namespace hl {

/// `options` must outlive `app`.
void addForceOptions(CLI::App& app, ServoOptions& options);

}  // namespace hl

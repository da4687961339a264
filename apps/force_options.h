// Options of the force: how often it is made, the user's limits, what has to be held, the effects of the servo. The
// same for hl and hld.
#pragma once

#include <CLI/CLI.hpp>

#include "control/servo_options.h"
#include "touch/servo_rate.h"

namespace hl {

/// `options` and `rate` must outlive `app`.
void addForceOptions(CLI::App& app, ServoOptions& options, ServoRate& rate);

}  // namespace hl

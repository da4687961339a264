// The options of the surfaces, over what the scene says. The same for all commands that touch it.
#pragma once

#include <CLI/CLI.hpp>

#include "base/ledger.h"
#include "scene/material.h"

namespace hl {

/// --shade, --stiffness, frictions, --viscosity, --textures; and --ledger. What is given must outlive `command`.
void addSurfaceOptions(CLI::App& command, MaterialOverride& surfaces, LedgerMode& ledger);

}  // namespace hl

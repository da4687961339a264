#include "surface_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>

#include "value_checks.h"

namespace hl {

void addSurfaceOptions(CLI::App& command, MaterialOverride& surfaces, LedgerMode& ledger) {
  const std::map<std::string, bool> shades{{"flat", false}, {"smooth", true}};
  const std::map<std::string, bool> switches{{"on", true}, {"off", false}};
  const std::map<std::string, LedgerMode> ledgers{
      {"tank", LedgerMode::kTank}, {"strict", LedgerMode::kStrict}, {"report", LedgerMode::kReport}};
  command.add_option("--shade", surfaces.smooth, "flat: true facets; smooth: forces along interpolated vertex normals")
      ->transform(oneOf(shades))
      ->option_text("flat|smooth (default: the scene's; flat for model files)");
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const QuantityInfo& info = kQuantityInfo[i];
    const std::string unit = *info.unit == 0 ? "" : std::string(" ") + info.unit;
    command.add_option(optionName(info), surfaces.number(i), info.words)
        ->check(within(0, std::min(info.most, kMaxNumber)))
        ->option_text(
            fmt::format("0..{:g}{} (default: the scene's; {:g} for model files)", info.most, unit, info.otherwise));
  }
  command.add_option("--textures", surfaces.textures, "read the scene's textures, or leave them out")
      ->transform(oneOf(switches))
      ->option_text("on|off (default: on)");
  command
      .add_option("--ledger", ledger, "energy that the surfaces may add: from a tank of 10 mJ, none, or any, counted")
      ->transform(oneOf(ledgers))
      ->option_text("tank|strict|report (default: tank)");
}

}  // namespace hl

#include "dds_options.h"

#include "base/error.h"

namespace hl {

void addReachOptions(CLI::App& app, DdsReach& reach, const DdsUse& use, const ReachHelp& help) {
  const std::string option = use.option;
  const auto add = [&](const char* end, auto& value, const std::string& what, const char* text) {
    return app.add_option(option + end, value, what)->needs(option)->option_text(text)->group(help.group);
  };
  add("-security", reach.enclave, help.security, "FOLDER");
  add("-interface", reach.interface_name,
      std::string(help.interface_name) + "; lo is this machine alone, another needs " + option + "-security", "NAME");
  add("-peer", reach.peers, "where another machine is, if multicast does not reach it; several times for several",
      "ADDRESS")
      ->allow_extra_args(false);
}

std::string presenceOf(const DdsProgram& program, const char* for_what, const char* what) {
  if (placeOf(program).empty()) return program.absent;
  try {
    return std::string(program.name) + " is here, for " + for_what + "; " + what + " would be in domain " +
           std::to_string(ddsDomain());
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace hl

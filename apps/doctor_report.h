// The report of hl doctor, to be sent in: what was found, as JSON, without names of users and without secrets.
#pragma once

#include <optional>
#include <string>

#include "doctor_device.h"
#include "doctor_machine.h"

namespace hl {

/// `text` without what may name a person or a machine: home folders become "~", hosts of URLs "HOST".
std::string withoutNames(std::string text);

/// The whole report. `device`: none, when none was looked at.
std::string reportOf(const MachineExamination& machine, const std::optional<DeviceExamination>& device);

}  // namespace hl

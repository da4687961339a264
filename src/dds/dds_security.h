// The settings of Cyclone DDS by which its plug-ins of DDS Security guard a participant.
#pragma once

#include <dds/dds.h>

#include "ros/enclave.h"

namespace hl {

/// Adds the enclave and the plug-ins to the properties of a participant.
void addSecurity(dds_qos_t& qos, const Enclave& enclave);

}  // namespace hl

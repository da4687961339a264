// Keystores: folders with an authority and the enclaves that it has made, laid out as SROS2 does it, so that both can
// go on with those of the other:
//
//   public/                 ca.cert.pem; identity_ca.cert.pem and permissions_ca.cert.pem point to it
//   private/                ca.key.pem, likewise: whoever has it may let others in
//   enclaves/               governance.xml, governance.p7s
//   enclaves/NAME/          cert.pem, key.pem, permissions.xml, permissions.p7s; the rest of an Enclave points to the
//   above
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hl {

/// Makes these enclaves, with permissions for all topics of the domain, and the keystore where there is none yet. Each
/// is there as a whole or not at all. `names`: as of namespaces in ROS 2, without the / before them.
/// Throws hl::Error and makes nothing when one is there already, or the folder is something else.
void makeEnclaves(const std::filesystem::path& keystore, const std::vector<std::string>& names, std::uint32_t domain);

}  // namespace hl

// What DDS Security's signed documents say (DDS Security 1.1, 9.4.1): the governance, how each topic of a domain is
// protected, and permissions, what a participant may do. Both are XML.
#pragma once

#include <cstdint>
#include <string>

namespace hl {

/// The largest domain that Cyclone DDS takes in such documents.
inline constexpr std::uint32_t kMaxKeysDomain = 230;

/// Authentication and encryption of everything, in all domains up to this, as SROS2 has it for one.
std::string governanceText();
/// `enclave`: the name in the certificate. All topics of this domain, between these times (of UTC, see pem.h).
std::string permissionsText(const std::string& enclave, std::uint32_t domain, const std::string& begin,
                            const std::string& end);

/// Throws hl::Error when in this domain anybody without a certificate could read a topic or write to one, by this
/// governance; and for what is no governance. `name`: of its file, for the message.
void requireProtection(const std::string& governance, std::uint32_t domain, const std::string& name);

}  // namespace hl

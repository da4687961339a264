#include "dds/dds_security.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>

namespace hl {

namespace {

// Debian has the plug-ins in a folder of their own beside the library, where no linker looks for them; others have them
// beside it, or where dlopen() finds them by name.
std::string plugin(const std::string& name) {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&dds_create_participant), &library) == 0) return name;
  const std::filesystem::path folder = std::filesystem::path(library.dli_fname).parent_path();
  for (const char* place : {"libddsc0debian", "."}) {
    const std::filesystem::path file = folder / place / ("lib" + name + ".so");
    if (std::filesystem::exists(file)) return file.string();
  }
  return name;
}

void addPlugin(dds_qos_t& qos, const std::string& use, const std::string& library, const std::string& what) {
  const std::string prefix = "dds.sec." + use + ".library.";
  dds_qset_prop(&qos, (prefix + "path").c_str(), plugin(library).c_str());
  dds_qset_prop(&qos, (prefix + "init").c_str(), ("init_" + what).c_str());
  dds_qset_prop(&qos, (prefix + "finalize").c_str(), ("finalize_" + what).c_str());
}

}  // namespace

void addSecurity(dds_qos_t& qos, const Enclave& enclave) {
  addPlugin(qos, "auth", "dds_security_auth", "authentication");
  addPlugin(qos, "crypto", "dds_security_crypto", "crypto");
  addPlugin(qos, "access", "dds_security_ac", "access_control");
  const auto add = [&](const char* name, const std::string& content) {
    dds_qset_prop(&qos, name, ("data:," + content).c_str());
  };
  add("dds.sec.auth.identity_ca", enclave.identity_ca);
  add("dds.sec.auth.identity_certificate", enclave.certificate);
  add("dds.sec.auth.private_key", enclave.key);
  add("dds.sec.access.permissions_ca", enclave.permissions_ca);
  add("dds.sec.access.governance", enclave.governance);
  add("dds.sec.access.permissions", enclave.permissions);
}

}  // namespace hl

#include "device/vendor_library.h"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.h"

namespace hl {

namespace {

std::string fileOf(const VendorLibraryName& name) {
  const char* file = std::getenv(name.variable);
  return file != nullptr && *file != '\0' ? file : name.file;
}

}  // namespace

VendorLibrary::VendorLibrary(const VendorLibraryName& name)
    : file_(fileOf(name)), advice_(name.advice), handle_(dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) {
    const char* const given = dlerror();
    const std::string reason = given != nullptr ? given : file_;  // kept: its own goes with the next call of the loader
    throw Error(reason + "; " + name.advice + ", or set " + name.variable + " to its file");
  }
}

std::string VendorLibrary::description() const {
  link_map* map = nullptr;
  if (dlinfo(handle_, RTLD_DI_LINKMAP, &map) != 0 || map == nullptr) return file_;
  std::error_code none;
  const std::filesystem::path real = std::filesystem::canonical(map->l_name, none);
  return none ? file_ : real.filename().string();
}

VendorLibrary::~VendorLibrary() { dlclose(handle_); }

void* VendorLibrary::find(const char* name) const {
  void* const symbol = findIfPresent(name);
  if (symbol == nullptr) throw Error(file_ + " has no " + name + ": it is too old or another library; " + advice_);
  return symbol;
}

void* VendorLibrary::findIfPresent(const char* name) const { return dlsym(handle_, name); }

}  // namespace hl

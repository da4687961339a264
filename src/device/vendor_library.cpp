#include "device/vendor_library.h"

#include <dlfcn.h>

#include <cstdlib>

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
    const char* const told = dlerror();
    const std::string reason = told != nullptr ? told : file_;  // kept: its own goes with the next call of the loader
    throw Error(reason + "; " + name.advice + ", or set " + name.variable + " to its file");
  }
}

VendorLibrary::~VendorLibrary() { dlclose(handle_); }

void* VendorLibrary::find(const char* name) const {
  void* const symbol = findIfPresent(name);
  if (symbol == nullptr) throw Error(file_ + " has no " + name + ": it is too old or another library; " + advice_);
  return symbol;
}

void* VendorLibrary::findIfPresent(const char* name) const { return dlsym(handle_, name); }

}  // namespace hl

// VendorLibrary: a vendor's shared library, opened at run time, so that HL is built and runs without it.
#pragma once

#include <string>

namespace hl {

struct VendorLibraryName {
  const char* file;      ///< as the system's loader finds it
  const char* variable;  ///< of the environment: another file, when it is set
  const char* advice;    ///< what to install, and where from
};

class VendorLibrary {
 public:
  /// Throws hl::Error with why it cannot be had, and the advice.
  explicit VendorLibrary(const VendorLibraryName& name);
  ~VendorLibrary();
  VendorLibrary(const VendorLibrary&) = delete;
  VendorLibrary& operator=(const VendorLibrary&) = delete;

  /// Which file the loader has taken, under its true name: vendors write the version there. Folders are left out.
  std::string description() const;

  /// `function` as the library has it. Throws hl::Error when it has none of this name.
  template <typename Function>
  void bind(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(find(name));
  }
  /// The same of a function that older versions lack; null then.
  template <typename Function>
  void bindIfPresent(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(findIfPresent(name));
  }

 private:
  void* find(const char* name) const;
  void* findIfPresent(const char* name) const;

  std::string file_;
  const char* advice_;
  void* handle_;
};

}  // namespace hl

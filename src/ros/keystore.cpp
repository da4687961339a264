#include "ros/keystore.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>

#include "base/error.h"
#include "ros/governance.h"
#include "ros/pem.h"

namespace hl {

namespace {

namespace fs = std::filesystem;

constexpr mode_t kSecret = 0600, kOpen = 0644, kSecretFolder = 0700, kOpenFolder = 0755;

[[noreturn]] void fail(const fs::path& path) {
  throw Error(path.string() + " cannot be made: " + std::strerror(errno));
}

void writeNew(const fs::path& file, const std::string& text, mode_t mode) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) fail(file);
  const bool written =
      write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) && fsync(descriptor) == 0;
  const int error = errno;
  close(descriptor);
  errno = error;
  if (!written) fail(file);
}

void makeFolder(const fs::path& folder, mode_t mode) {
  if (mkdir(folder.c_str(), mode) != 0) fail(folder);
}

void pointTo(const fs::path& target, const fs::path& link) {
  if (symlink(target.c_str(), link.c_str()) != 0) fail(link);
}

/// A folder beside the one that it shall become, removed unless it does.
class Draft {
 public:
  explicit Draft(fs::path goal) : goal_(std::move(goal)) {
    std::string name = goal_.string() + ".XXXXXX";
    if (mkdtemp(name.data()) == nullptr) fail(goal_);
    path_ = name;
    chmod(path_.c_str(), kOpenFolder);
  }
  ~Draft() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  const fs::path& path() const { return path_; }
  /// Takes the place of an empty folder; throws hl::Error where anything else is.
  void keep() {
    if (std::rename(path_.c_str(), goal_.c_str()) != 0) fail(goal_);
    path_.clear();
  }

 private:
  fs::path goal_, path_;
};

Authority makeAuthority() {
  Authority authority{makeKey(), Certificate(nullptr, X509_free)};
  authority.certificate = makeAuthorityCertificate(*authority.key, "hlCA");
  return authority;
}

// Those that `ros2 security` asks for.
bool isKeystore(const fs::path& folder) {
  return fs::is_regular_file(folder / "public/identity_ca.cert.pem") &&
         fs::is_regular_file(folder / "public/permissions_ca.cert.pem") &&
         fs::is_regular_file(folder / "private/identity_ca.key.pem") &&
         fs::is_regular_file(folder / "private/permissions_ca.key.pem") &&
         fs::is_regular_file(folder / "enclaves/governance.p7s");
}

void makeKeystore(const fs::path& keystore) {
  Draft draft(keystore);
  const Authority authority = makeAuthority();
  makeFolder(draft.path() / "public", kOpenFolder);
  makeFolder(draft.path() / "private", kSecretFolder);
  makeFolder(draft.path() / "enclaves", kOpenFolder);
  writeNew(draft.path() / "public/ca.cert.pem", pemOf(*authority.certificate), kOpen);
  writeNew(draft.path() / "private/ca.key.pem", pemOf(*authority.key), kSecret);
  for (const std::string use : {"identity", "permissions"}) {
    pointTo("ca.cert.pem", draft.path() / "public" / (use + "_ca.cert.pem"));
    pointTo("ca.key.pem", draft.path() / "private" / (use + "_ca.key.pem"));
  }
  writeNew(draft.path() / "enclaves/governance.xml", governanceText(), kOpen);
  writeNew(draft.path() / "enclaves/governance.p7s", signedText(governanceText(), authority), kOpen);
  draft.keep();
}

Authority authorityOf(const fs::path& keystore, const std::string& use) {
  const fs::path key = keystore / "private" / (use + "_ca.key.pem");
  const fs::path certificate = keystore / "public" / (use + "_ca.cert.pem");
  Authority authority{keyOf(textOfKeyFile(key), key.string()),
                      certificateOf(textOfKeyFile(certificate), certificate.string())};
  if (X509_check_private_key(authority.certificate.get(), authority.key.get()) != 1)
    throw Error(key.string() + " is not the key of " + certificate.string());
  return authority;
}

// That of ros2 security is of one domain.
void requireGovernance(const fs::path& keystore, std::uint32_t domain) {
  const fs::path authority = keystore / "public/permissions_ca.cert.pem",
                 governance = keystore / "enclaves/governance.p7s";
  const Certificate certificate = certificateOf(textOfKeyFile(authority), authority.string());
  requireProtection(verifiedText(textOfKeyFile(governance), *certificate, governance.string()), domain,
                    governance.string());
}

void makeEnclave(const fs::path& keystore, const std::string& name, std::uint32_t domain) {
  const Authority identity = authorityOf(keystore, "identity"), permissions = authorityOf(keystore, "permissions");
  const fs::path goal = keystore / "enclaves" / name;
  fs::create_directories(goal.parent_path());
  Draft draft(goal);
  const Key key = makeKey();
  const std::string path = '/' + name;
  const Certificate certificate = makeCertificate(*key, path, identity);
  const std::string text = permissionsText(path, domain, beginOf(*certificate), endOf(*certificate));
  writeNew(draft.path() / "cert.pem", pemOf(*certificate), kOpen);
  writeNew(draft.path() / "key.pem", pemOf(*key), kSecret);
  writeNew(draft.path() / "permissions.xml", text, kOpen);
  writeNew(draft.path() / "permissions.p7s", signedText(text, permissions), kOpen);
  fs::path enclaves = "..", top = "../..";
  for (const char c : name) {
    if (c != '/') continue;
    enclaves /= "..";
    top /= "..";
  }
  pointTo(enclaves / "governance.p7s", draft.path() / "governance.p7s");
  for (const char* file : {"identity_ca.cert.pem", "permissions_ca.cert.pem"})
    pointTo(top / "public" / file, draft.path() / file);
  draft.keep();
}

// `folder` without a / at its end.
void makeAll(const fs::path& folder, const std::set<std::string>& names, std::uint32_t domain) {
  const bool fresh = !fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder));
  if (!fresh && !isKeystore(folder))
    throw Error(folder.string() + " is there and is no keystore: name a folder that is not there, or a keystore");
  for (const std::string& name : names) {
    const fs::path enclave = folder / "enclaves" / name;
    if (fs::exists(enclave))
      throw Error(enclave.string() + " is there already, and keys are not replaced: choose another name, or remove it");
  }
  if (fresh) makeKeystore(folder);
  requireGovernance(folder, domain);
  for (const std::string& name : names) makeEnclave(folder, name, domain);
}

}  // namespace

void makeEnclaves(const fs::path& keystore, const std::vector<std::string>& names, std::uint32_t domain) {
  const fs::path folder = keystore.has_filename() ? keystore : keystore.parent_path();
  try {
    makeAll(folder, {names.begin(), names.end()}, domain);
  } catch (const fs::filesystem_error& error) {
    throw Error(folder.string() + ": " + error.what());
  }
}

}  // namespace hl

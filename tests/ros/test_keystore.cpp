// Keystores of SROS2's layout, and what of an enclave is refused.
#include "ros/keystore.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <set>

#include "base/error.h"
#include "ros/enclave.h"
#include "ros/governance.h"
#include "ros/pem.h"
#include "temp_folder.h"

namespace hl::test_keystore {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kDomain = 7;

std::string reasonOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}
std::string refusalOf(const fs::path& folder, std::uint32_t domain = kDomain) {
  return reasonOf([&] { readEnclave(folder, domain); });
}
void expectIn(const std::string& part, const std::string& whole) {
  EXPECT_NE(whole.find(part), whole.npos) << whole;
  EXPECT_EQ(whole.find('\n'), whole.npos) << whole;
}

// Every file, link and folder, and what a link points to.
std::set<std::string> listOf(const fs::path& folder) {
  std::set<std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::string line = entry.path().lexically_relative(folder).string();
    if (entry.is_symlink()) line += " -> " + fs::read_symlink(entry.path()).string();
    all.insert(line);
  }
  return all;
}

std::string contentOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}
void replace(const fs::path& file, const std::string& content) {
  fs::remove(file);
  std::ofstream(file) << content;
}

/// A keystore with the enclave lab/hand.
class Keystore : public ::testing::Test {
 protected:
  Keystore() { makeEnclaves(folder_, {"lab/hand"}, kDomain); }
  ~Keystore() override { fs::remove_all(folder_); }

  // Its authority, as a thief of its key would have it.
  Authority authority() const {
    return {keyOf(contentOf(folder_ / "private/ca.key.pem"), "key"),
            certificateOf(contentOf(folder_ / "public/ca.cert.pem"), "certificate")};
  }
  // The governance with another text in one place.
  void changeGovernance(const std::string& from, const std::string& to) const {
    std::string text = governanceText();
    ASSERT_NE(text.find(from), text.npos);
    text.replace(text.find(from), from.size(), to);
    replace(enclave_ / "governance.p7s", signedText(text, authority()));
  }

  const fs::path folder_ = tempFolder() / "keys", enclave_ = folder_ / "enclaves/lab/hand";

  static const fs::path& tempFolder() { return test::tempFolder(); }
};

TEST_F(Keystore, ItsLayoutIsThatOfSros2) {
  const std::set<std::string> expected{"enclaves",
                                       "enclaves/governance.p7s",
                                       "enclaves/governance.xml",
                                       "enclaves/lab",
                                       "enclaves/lab/hand",
                                       "enclaves/lab/hand/cert.pem",
                                       "enclaves/lab/hand/governance.p7s -> ../../governance.p7s",
                                       "enclaves/lab/hand/identity_ca.cert.pem -> ../../../public/identity_ca.cert.pem",
                                       "enclaves/lab/hand/key.pem",
                                       "enclaves/lab/hand/permissions.p7s",
                                       "enclaves/lab/hand/permissions.xml",
                                       "enclaves/lab/hand/permissions_ca.cert.pem -> "
                                       "../../../public/permissions_ca.cert.pem",
                                       "private",
                                       "private/ca.key.pem",
                                       "private/identity_ca.key.pem -> ca.key.pem",
                                       "private/permissions_ca.key.pem -> ca.key.pem",
                                       "public",
                                       "public/ca.cert.pem",
                                       "public/identity_ca.cert.pem -> ca.cert.pem",
                                       "public/permissions_ca.cert.pem -> ca.cert.pem"};
  EXPECT_EQ(listOf(folder_), expected);
}

TEST_F(Keystore, PrivateFilesAreTheirOwnersAlone) {
  const auto modeOf = [](const fs::path& path) {
    struct stat status {};
    stat(path.c_str(), &status);
    return status.st_mode & 0777U;
  };
  EXPECT_EQ(modeOf(folder_ / "private"), 0700u);
  EXPECT_EQ(modeOf(folder_ / "private/ca.key.pem"), 0600u);
  EXPECT_EQ(modeOf(enclave_ / "key.pem"), 0600u);
}

TEST_F(Keystore, AnEnclaveOfItIsRead) {
  const Enclave enclave = readEnclave(enclave_, kDomain);
  EXPECT_EQ(enclave.identity_ca, contentOf(folder_ / "public/ca.cert.pem"));
  EXPECT_EQ(enclave.key, contentOf(enclave_ / "key.pem"));
  EXPECT_NE(enclave.permissions.find("<subject_name>CN=/lab/hand<"), enclave.permissions.npos);
}

TEST_F(Keystore, AnotherEnclaveIsOfTheSameAuthority) {
  makeEnclaves(folder_ / "", {"lab/other", "table"}, kDomain);
  EXPECT_EQ(readEnclave(folder_ / "enclaves/table", kDomain).identity_ca, readEnclave(enclave_, kDomain).identity_ca);
  EXPECT_NE(readEnclave(folder_ / "enclaves/lab/other", kDomain).key, readEnclave(enclave_, kDomain).key);
}

TEST_F(Keystore, NothingIsReplacedAndNothingElseMade) {
  const std::string key = contentOf(enclave_ / "key.pem");
  const std::set<std::string> before = listOf(folder_);
  expectIn("is there already", reasonOf([&] { makeEnclaves(folder_, {"new", "lab/hand"}, kDomain); }));
  EXPECT_EQ(listOf(folder_), before);
  EXPECT_EQ(contentOf(enclave_ / "key.pem"), key);
}

TEST_F(Keystore, AFolderThatIsNoneIsRefusedAndLeft) {
  const fs::path other = tempFolder() / "photos";
  fs::create_directory(other);
  makeEnclaves(other, {"a"}, kDomain);  // it was empty
  fs::remove_all(other / "public");
  expectIn("is no keystore", reasonOf([&] { makeEnclaves(other, {"b"}, kDomain); }));
  expectIn("cannot be made", reasonOf([&] { makeEnclaves(tempFolder() / "nowhere/keys", {"b"}, kDomain); }));
  EXPECT_FALSE(fs::exists(tempFolder() / "nowhere"));
  expectIn("is no keystore", reasonOf([&] { makeEnclaves(test::fileWith("file", "text"), {"b"}, kDomain); }));
}

TEST_F(Keystore, AKeystoreOfOneDomainMakesNoneForAnother) {
  std::string text = governanceText();
  const std::string all = "<id_range><min>0</min><max>230</max></id_range>";
  text.replace(text.find(all), all.size(), "<id>0</id>");
  replace(folder_ / "enclaves/governance.p7s", signedText(text, authority()));
  expectIn("says nothing of domain 7", reasonOf([&] { makeEnclaves(folder_, {"b"}, kDomain); }));
  EXPECT_FALSE(fs::exists(folder_ / "enclaves/b"));
  EXPECT_NO_THROW(makeEnclaves(folder_, {"b"}, 0));
}

TEST_F(Keystore, AnEnclaveWithoutAFileIsRefused) {
  for (const char* file : {"identity_ca.cert.pem", "cert.pem", "key.pem", "permissions_ca.cert.pem", "governance.p7s",
                           "permissions.p7s"}) {
    const std::string content = contentOf(enclave_ / file);
    fs::remove(enclave_ / file);
    expectIn(file, refusalOf(enclave_));
    for (const std::string& text : {std::string("nonsense"), std::string(), std::string(2U << 20U, 'a')}) {
      replace(enclave_ / file, text);
      expectIn(file, refusalOf(enclave_));
    }
    replace(enclave_ / file, content);
  }
  EXPECT_NO_THROW(readEnclave(enclave_, kDomain));
  expectIn("there is no file", refusalOf(folder_ / "nowhere"));
}

TEST_F(Keystore, ACertificateOfAnotherAuthorityIsRefused) {
  const fs::path other = tempFolder() / "others";
  makeEnclaves(other, {"lab/hand"}, kDomain);
  const fs::path foreign = other / "enclaves/lab/hand";
  replace(enclave_ / "cert.pem", contentOf(foreign / "cert.pem"));
  expectIn("is not the key of", refusalOf(enclave_));
  replace(enclave_ / "key.pem", contentOf(foreign / "key.pem"));
  expectIn("cert.pem is not made by", refusalOf(enclave_));
  makeEnclaves(folder_, {"b"}, kDomain);
  replace(folder_ / "enclaves/b/governance.p7s", contentOf(foreign / "governance.p7s"));
  expectIn("governance.p7s is not signed by", refusalOf(folder_ / "enclaves/b"));
  fs::remove_all(other);
}

// Of certificates made by hand, with other times.
Certificate certificateBetween(EVP_PKEY& key, const Authority& authority, long from_s, long to_s) {
  Certificate certificate = makeCertificate(key, "/lab/hand", authority);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), from_s);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), to_s);
  X509_sign(certificate.get(), authority.key.get(), EVP_sha256());
  return certificate;
}

TEST_F(Keystore, ACertificateOutOfItsTimeIsRefused) {
  const Key key = keyOf(contentOf(enclave_ / "key.pem"), "key");
  constexpr long kHour_s = 3600;
  const Certificate old = certificateBetween(*key, authority(), -2 * kHour_s, -kHour_s);
  replace(enclave_ / "cert.pem", pemOf(*old));
  expectIn("cert.pem has expired, on " + endOf(*old), refusalOf(enclave_));
  replace(enclave_ / "cert.pem", pemOf(*certificateBetween(*key, authority(), kHour_s, 2 * kHour_s)));
  expectIn("counts only from", refusalOf(enclave_));
}

TEST_F(Keystore, ASignedTextThatWasChangedIsRefused) {
  std::string text = contentOf(enclave_ / "governance.p7s");
  const std::size_t place = text.find("<allow_unauthenticated_participants>false");
  text.replace(place, 41, "<allow_unauthenticated_participants>true ");
  replace(enclave_ / "governance.p7s", text);
  expectIn("was changed since", refusalOf(enclave_));
}

TEST_F(Keystore, AGovernanceThatLeavesAnythingOpenIsRefused) {
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& reason) {
    changeGovernance(from, to);
    expectIn(reason, refusalOf(enclave_));
  };
  refused("participants>false", "participants>true", "allow_unauthenticated_participants");
  refused("join_access_control>true", "join_access_control>false", "enable_join_access_control");
  refused("read_access_control>true", "read_access_control>false", "enable_read_access_control");
  refused("write_access_control>true", "write_access_control>0", "enable_write_access_control");
  refused("<id_range><min>0</min>", "<id_range><min>8</min>", "says nothing of domain 7");
  refused("<max>230", "<max>6", "says nothing of domain 7");
  refused("<topic_rule>", "<no_rule>", "there is no topic_rule");
  refused("<topic_access_rules>", "<enable_join_access_control>false</enable_join_access_control><topic_access_rules>",
          "enable_join_access_control");
  const std::string open =
      "<metadata_protection_kind>SIGN</metadata_protection_kind>\n          <data_protection_kind>NONE";
  refused("<metadata_protection_kind>ENCRYPT</metadata_protection_kind>\n          <data_protection_kind>ENCRYPT", open,
          "is ENCRYPT for every topic");
  changeGovernance("<max>230", "<max>7");
  EXPECT_NO_THROW(readEnclave(enclave_, kDomain));
}

TEST(Governance, OneEncryptionIsEnoughAndTheFirstRuleOfADomainCounts) {
  std::string text = governanceText();
  const auto change = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  change("<data_protection_kind>ENCRYPT", "<data_protection_kind>NONE");
  EXPECT_NO_THROW(requireProtection(text, 0, "text"));
  change("<metadata_protection_kind>ENCRYPT", "<metadata_protection_kind>NONE");
  EXPECT_THROW(requireProtection(text, 0, "text"), Error);
  change("<rtps_protection_kind>SIGN", "<rtps_protection_kind>ENCRYPT_WITH_ORIGIN_AUTHENTICATION");
  EXPECT_NO_THROW(requireProtection(text, 0, "text"));
  const std::size_t begin = text.find("    <domain_rule>"), end = text.find("</domain_rule>") + 15;
  std::string before = text.substr(begin, end - begin);
  before.replace(before.find("participants>false"), 18, "participants>true");
  before.replace(before.find("<id_range>"), 47, "<id>3</id>");
  text.insert(begin, before);
  EXPECT_THROW(requireProtection(text, 3, "text"), Error);
  EXPECT_NO_THROW(requireProtection(text, 4, "text"));
}

TEST(Governance, WhatIsNoneIsRefused) {
  for (const char* text : {"", "nonsense", "<dds/>", "<dds><domain_access_rules/></dds>", "<dds>"})
    EXPECT_THROW(requireProtection(text, 0, "text"), Error) << text;
}

}  // namespace
}  // namespace hl::test_keystore

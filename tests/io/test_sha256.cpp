// SHA-256 against the vectors of FIPS 180-2, and files against text.
#include "io/sha256.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "temp_folder.h"

namespace hl::test_sha256 {
namespace {

TEST(Sha256Digest, HasTheVectorsOfItsStandard) {
  EXPECT_EQ(sha256Of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256Of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256Of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256Digest, OfAFileIsThatOfItsBytes) {
  const std::string bytes(3'000'000, 'x');  // several pieces
  EXPECT_EQ(sha256OfFile(test::fileWith("bytes", bytes)), sha256Of(bytes));
  EXPECT_THROW(sha256OfFile(test::tempFile("none")), Error);
}

}  // namespace
}  // namespace hl::test_sha256

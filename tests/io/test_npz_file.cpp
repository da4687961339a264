// NpzFile, with numpy and Python's zipfile as the judges.
#include "io/npz_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <limits>

#include "base/error.h"
#include "temp_folder.h"

namespace hl::test_npz_file {
namespace {

// What a program in Python prints; `f` is the opened file.
std::string judged(const std::string& path, const std::string& program) {
  const std::string script =
      test::fileWith("judge.py", "import sys, zipfile, numpy as np\nf = np.load(sys.argv[1])\n" +
                                     std::string("print(zipfile.ZipFile(sys.argv[1]).testzip())\n") + program);
  std::FILE* pipe = popen(("/usr/bin/python3 " + script + " " + path + " 2>&1").c_str(), "r");
  std::string output;
  std::array<char, 4096> buffer{};
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), got);
  pclose(pipe);
  return output;
}

TEST(NpzFiles, AreReadByNumpy) {
  const std::string path = test::tempFile("a.npz");
  NpzFile file(path);
  file.add("numbers", std::vector<double>{0.1, -1e300, std::numeric_limits<double>::quiet_NaN()});
  file.add("counts", std::vector<std::int64_t>{1, -2, 1LL << 62});
  file.add("texts", std::vector<std::string>{"a", "", "h\xC3\xB6he \xF0\x9F\x98\x80"});
  file.add("none", std::vector<double>{});
  file.add("no_texts", std::vector<std::string>{});
  file.begin("table", "<f8", {2, 3});
  const std::array<double, 6> table{1, 2, 3, 4, 5, 6};
  for (const double& number : table) file.write(&number, sizeof number);
  file.close();
  EXPECT_EQ(judged(path,
                   "print(f.files)\nprint(f['numbers'].tolist(), f['counts'].tolist(), ascii(f['texts'].tolist()))\n"
                   "print(f['none'].shape, f['none'].dtype, f['no_texts'].shape, f['table'].tolist())\n"),
            "None\n['numbers', 'counts', 'texts', 'none', 'no_texts', 'table']\n"
            "[0.1, -1e+300, nan] [1, -2, 4611686018427387904] ['a', '', 'h\\xf6he \\U0001f600']\n"
            "(0,) float64 (0,) [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]\n");
}

TEST(NpzFiles, OfTheSameContentAreTheSameBytes) {
  const auto written = [](const std::string& name) {
    NpzFile file(test::tempFile(name));
    file.add("numbers", std::vector<double>{1, 2});
    file.close();
    std::ifstream in(test::tempFile(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(written("b.npz"), written("c.npz"));
}

TEST(NpzFiles, ReportWhereTheyCannotBeWritten) {
  EXPECT_THROW(NpzFile("/nonexistent/a.npz"), Error);
  EXPECT_THROW(
      {
        NpzFile full("/dev/full");
        full.add("numbers", std::vector<double>(100'000));
        full.close();
      },
      Error);
}

}  // namespace
}  // namespace hl::test_npz_file

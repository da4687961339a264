#!/usr/bin/env python3
"""What an installed HL is to others: its library's symbols, a project that uses it, the programs, the Debian packages.

    test_install.py BUILD_DIR SOURCE_DIR [unittest's arguments]
"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import urllib.request
from pathlib import Path

BUILD, SOURCE = Path(sys.argv.pop(1)), Path(sys.argv.pop(1))
CONSUMER = SOURCE / "tests" / "consumer"
PATIENCE_S = 600


def run(*command, **options):
    """The command's output; the test fails with it when the command does."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=PATIENCE_S, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def cache(name):
    return re.search(rf"^{name}(?::\w+)?=(.*)$", (BUILD / "CMakeCache.txt").read_text(encoding="utf-8"), re.MULTILINE).group(1)


HAS_CAD = (BUILD / "bin" / "hl-cad").exists()
HAS_VDB = (BUILD / "bin" / "hl-vdb").exists()
HAS_ROS = (BUILD / "bin" / "hl-ros").exists()
HAS_PYTHON = "HL_BUILD_PYTHON:BOOL=ON" in (BUILD / "CMakeCache.txt").read_text(encoding="utf-8")


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        # Installed in one place and moved to another: nothing may remember where it was.
        first = Path(cls.temporary.name) / "first"
        run("cmake", "--install", BUILD, "--prefix", first)
        cls.prefix = first.rename(Path(cls.temporary.name) / "moved")
        cls.library = cls.prefix / cache("CMAKE_INSTALL_LIBDIR")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def folder(self, name):
        path = Path(self.temporary.name) / name
        path.mkdir()
        return path

    def test_only_the_calls_are_visible(self):
        declared = re.findall(r"^HL_API [\w* ]*?\b(hl[A-Z]\w*)\(", (SOURCE / "include/hl/hl.h").read_text(encoding="utf-8"),
                              re.MULTILINE)
        symbols = run("nm", "-D", "--defined-only", "--format=just-symbols", self.library / "libhl.so").split()
        self.assertEqual(sorted(symbols), sorted(declared))

    def test_only_the_batch_calls_are_visible(self):
        declared = re.findall(r"^HL_API [\w* ]*?\b(hl[A-Z]\w*)\(",
                              (SOURCE / "include/hl/hl_batch.h").read_text(encoding="utf-8"), re.MULTILINE)
        symbols = run("nm", "-D", "--defined-only", "--format=just-symbols", self.library / "libhlbatch.so").split()
        self.assertEqual(sorted(symbols), sorted(declared))

    def test_the_library_says_its_version(self):
        dynamic = run("readelf", "-d", self.library / "libhl.so")
        self.assertRegex(dynamic, r"SONAME.*\[libhl\.so\.\d+\.\d+\]")
        self.assertNotRegex(dynamic, r"R(UN)?PATH")

    def test_a_project_finds_it_with_cmake(self):
        build = self.folder("cmake")
        run("cmake", "-S", CONSUMER, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
            f"-DCMAKE_C_COMPILER={cache('CMAKE_C_COMPILER')}", f"-DCMAKE_CXX_COMPILER={cache('CMAKE_CXX_COMPILER')}")
        run("cmake", "--build", build)
        self.assertIn("shows 1 triangle", run(build / "consumer_c"))
        self.assertIn("1 triangle", run(build / "consumer_cpp"))

    def test_a_project_of_another_version_is_told(self):
        build = self.folder("other")
        (build / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.22)\nproject(other LANGUAGES NONE)\nfind_package(hl 99 REQUIRED)\n")
        with self.assertRaisesRegex(AssertionError, r"compatible\s+with requested"):
            run("cmake", "-S", build, "-B", build / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")

    def test_a_program_finds_it_with_pkg_config(self):
        folder = self.folder("pkg-config")
        environment = {**os.environ, "PKG_CONFIG_PATH": str(self.library / "pkgconfig"), "LD_LIBRARY_PATH": str(self.library)}
        flags = run("pkg-config", "--cflags", "--libs", "hl", env=environment).split()
        run(cache("CMAKE_C_COMPILER"), CONSUMER / "consumer.c", *flags, "-o", folder / "c")
        run(cache("CMAKE_CXX_COMPILER"), "-std=c++20", CONSUMER / "consumer.cpp", *flags, "-o", folder / "cpp")
        self.assertIn("shows 1 triangle", run(folder / "c", env=environment))
        self.assertIn("1 triangle", run(folder / "cpp", env=environment))

    def test_the_links_of_the_documents_lead_somewhere(self):
        readme = next(self.prefix.glob("share/doc/*/README.md"))
        documents = list(readme.parent.rglob("*.md"))
        self.assertIn(readme.parent / "docs/calls.md", documents)
        for document in documents:
            text = re.sub(r"^```.*?^```$", "", document.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
            for target in re.findall(r"\]\(([^)#\s]+)", text):
                self.assertTrue("://" in target or (document.parent / target).exists(), f"{document}: {target}")

    def test_the_examples_build_on_their_own(self):
        examples = next(self.prefix.glob("share/doc/*/examples"))
        build = self.folder("examples")
        run("cmake", "-S", examples, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", build, "--target", "example_01_sphere", "example_02_teapot_with_material")
        self.assertIn("force:", run(build / "bin/examples/01_sphere", "inproc:", "1.1"))

    def test_examples_without_the_messages_of_ros_leave_out_what_needs_them(self):
        examples = self.folder("some_examples")
        shutil.copytree(next(self.prefix.glob("share/doc/*/examples")), examples, dirs_exist_ok=True)
        (examples / "ros2.idl").unlink(missing_ok=True)
        build = self.folder("some")
        run("cmake", "-S", examples, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        targets = run("cmake", "--build", build, "--target", "help")
        self.assertIn("example_01_sphere", targets)
        self.assertNotIn("example_19_ros_circle", targets)

    def test_the_installed_server_finds_its_page(self):
        page = self.prefix / "share/hl/viewer/index.html"
        if not page.exists():  # the page is built by scripts/build, not by CMake
            page.parent.mkdir(parents=True)
            page.write_text("<title>a page</title>", encoding="utf-8")
        server = subprocess.Popen([self.prefix / "bin/hld", "--port", "0", "--log-format", "json"], stderr=subprocess.PIPE,
                                  text=True)
        with server.stderr:
            ready = next(json.loads(line) for line in server.stderr if '"ready"' in line)
            with urllib.request.urlopen(ready["address"], timeout=PATIENCE_S) as answer:
                self.assertEqual(answer.read().decode(), page.read_text(encoding="utf-8"))
            server.send_signal(signal.SIGTERM)
            self.assertEqual(server.wait(PATIENCE_S), 0)

    def test_what_an_operator_needs_is_there(self):
        self.assertRegex(run(self.prefix / "bin/hl", "--version"), r"^hl \d")
        for file in ["share/doc/hl-tools/hld.conf", "lib/systemd/system/hld.service"]:
            self.assertTrue((self.prefix / file).is_file(), file)


@unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "needs dpkg-dev")
class DebianPackages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        # What is packed quickly is unpacked as well.
        run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip")
        cls.packages = {file.name.split("_")[0]: file for file in cls.folder.glob("*.deb")}

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def field(self, package, name):
        return run("dpkg-deb", "--field", self.packages[package], name).strip()

    def content(self, package):
        return run("dpkg-deb", "--contents", self.packages[package])

    def test_there_is_one_for_each_purpose(self):
        self.assertEqual(sorted(self.packages), 
                         ["hl-cad"] * HAS_CAD + ["hl-ros", "hl-share"] * HAS_ROS + ["hl-tools"] + ["hl-vdb"] * HAS_VDB +
                         ["libhl", "libhl-dev", "libhlbatch"] + ["python3-hl"] * HAS_PYTHON)

    @unittest.skipUnless(HAS_PYTHON, "the Python package is not built")
    def test_python_finds_its_package_where_it_is_unpacked(self):
        self.assertRegex(self.field("python3-hl", "Depends"), r"libprotobuf32.*python3-numpy|python3-numpy.*libprotobuf32")
        run("dpkg-deb", "--extract", self.packages["python3-hl"], self.folder / "python-root")
        program = "import hl; print(hl.Scene('teapot').primitives > 1000, hl.__file__)"
        place = self.folder / "python-root/usr/lib/python3/dist-packages"
        self.assertIn(f"True {place}", run("/usr/bin/python3", "-c", program, env={**os.environ, "PYTHONPATH": str(place)}))

    def test_the_library_depends_on_what_it_is_linked_with(self):
        self.assertRegex(self.field("libhl", "Depends"), r"libprotobuf32.*libssl3|libssl3.*libprotobuf32")
        self.assertRegex(self.content("libhl"), r"\./usr/lib/\S*libhl\.so\.\d+\.\d+ -> libhl\.so\.\d+\.\d+\.\d+")
        self.assertNotRegex(self.content("libhl"), r"libhl\.so ->|hl\.h")

    def test_building_needs_the_same_version(self):
        self.assertEqual(self.field("libhl-dev", "Depends"), "libhl (= {0}), libhlbatch (= {0})".format(self.field("libhl", "Version")))
        for file in [r"libhl\.so -> ", "include/hl/hl.h", "hlConfig.cmake", "pkgconfig/hl.pc", "examples/01_sphere.c"]:
            self.assertRegex(self.content("libhl-dev"), file)

    def test_the_programs_are_there_and_run_where_they_are_unpacked(self):
        run("dpkg-deb", "--extract", self.packages["hl-tools"], self.folder / "root")
        self.assertRegex(run(self.folder / "root/usr/bin/hld", "--version"), r"^hld \d")
        self.assertIn("./usr/lib/systemd/system/hld.service", self.content("hl-tools").replace("//", "/"))


if __name__ == "__main__":
    unittest.main(verbosity=2)

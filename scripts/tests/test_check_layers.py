"""check_layers finds what it exists to find, in small trees made for the purpose, and passes a clean one."""
import sys
import unittest
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent.parent), str(Path(__file__).resolve().parent)]
import check_layers  # noqa: E402
from small_tree import SmallTree  # noqa: E402


class CheckLayers(SmallTree):
    def faults(self):
        return check_layers.check(self.root)

    def test_a_tree_that_only_looks_down_passes(self):
        self.write("src/base/vec.h", "#include <vector>\n")
        self.write("src/geometry/sweep.cpp", '#include "base/vec.h"\n#include "geometry/sweep.h"\n')
        self.write("src/io/load.cpp", '#include "scenes/teapot.h"\n#include "scene/model.h"\n#include "hl.pb.h"\n')
        self.write("src/io/CMakeLists.txt", "hl_library(hl_io SOURCES load.cpp LINK hl_scenes hl_proto hl_flags)\n")
        self.assertEqual(self.faults(), [])

    def test_an_include_upward_fails_and_names_its_line(self):
        self.write("src/base/vec.h", '\n#include "proxy/proxy.h"\n')
        self.assertEqual(len(self.faults()), 1)
        self.assertIn("src/base/vec.h:2: base (level 0) uses proxy (level 4)", self.faults()[0])

    def test_an_include_sideways_fails(self):
        self.write("src/geometry/a.cpp", '#include "device/device.h"\n')
        self.assertEqual(len(self.faults()), 1)

    def test_the_proxy_must_not_know_devices(self):
        self.write("src/proxy/a.cpp", '#include "device/device.h"\n')
        self.assertIn("proxy must know nothing of device", self.faults()[0])

    def test_a_generated_header_counts_as_its_folder(self):
        self.write("src/geometry/a.cpp", '#include "hl.pb.h"\n')
        self.assertEqual(len(self.faults()), 1)

    def test_an_include_through_the_parent_folder_fails(self):
        self.write("src/io/a.cpp", '#include "../scene/model.h"\n')
        self.assertEqual(len(self.faults()), 1)

    def test_a_link_upward_fails_in_both_spellings(self):
        self.write("src/scene/CMakeLists.txt", "hl_library(hl_scene SOURCES a.cpp\n  LINK hl_geometry hl_session)\n")
        self.write("src/base/CMakeLists.txt", "target_link_libraries(hl_base PUBLIC hl_proto)\n")
        self.assertEqual(len(self.faults()), 2)

    def test_a_commented_link_is_no_link(self):
        self.write("src/base/CMakeLists.txt", "# target_link_libraries(hl_base PUBLIC hl_proto)\n")
        self.assertEqual(self.faults(), [])

    def test_a_file_over_the_limit_fails(self):
        self.write("src/base/long.h", "//\n" * (check_layers.MAX_LINES + 1))
        self.assertEqual(len(self.faults()), 1)

    def test_units_of_a_folder_that_use_each_other_fail(self):
        self.write("src/proxy/a.h", "")
        self.write("src/proxy/a.cpp", '#include "proxy/a.h"\n#include "proxy/b.h"\n')
        self.write("src/proxy/b.h", '#include "proxy/c.h"\n')
        self.write("src/proxy/c.h", "")
        self.assertEqual(self.faults(), [])
        self.write("src/proxy/c.cpp", '#include "proxy/a.h"\n')
        self.assertEqual(self.faults(), ["a cycle of includes: proxy/a -> proxy/b -> proxy/c -> proxy/a"])

    def test_the_program_ends_with_code_1_on_a_fault(self):
        self.write("src/base/vec.h", '#include "apps/options.h"\n')
        self.assertEqual(check_layers.main([str(self.root)]), 1)


if __name__ == "__main__":
    unittest.main()

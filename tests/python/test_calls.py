"""hl.calls beside hl.h, and whose a connection is: of one process, one thread at a time, and as the server has it."""
import os
import re
import subprocess
import sys
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import hl
from hl import calls

SOURCE = Path(os.environ["HL_SOURCE"])
BOX = (np.array([[x, y, z] for x in (-0.01, 0.01) for y in (-0.01, 0.01) for z in (-0.01, 0.01)]),
       np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]))
BODY, HINGE = 6, 1
PATIENCE_S = 20.0


class Connected(unittest.TestCase):
    def setUp(self):
        self.touch = self.enterContext(hl.connect(name="test"))

    def wait_until(self, condition):
        ends = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), ends)
            self.touch.state()
            time.sleep(0.01)

    def hang_a_body(self):
        with self.touch.frame():
            with self.touch.define(BODY):
                self.touch.body("box", mass=0.1)
                self.touch.draw(*BOX, mode=calls.HL_QUADS)
            self.touch.place(BODY, [[1, 0, 0, 0], [0, 1, 0, 0.2], [0, 0, 1, 0], [0, 0, 0, 1]])
            self.touch.join(HINGE, BODY, kind="hinge", axis=(0, 0, 1), anchor=(0, 0.2, 0))
        self.wait_until(lambda: len(self.touch.bodies()) == 1 and len(self.touch.joints()) == 1)


class Calls(Connected):
    def test_every_call_of_the_header_is_there_or_named_among_those_that_are_not(self):
        header = (SOURCE / "include/hl/hl.h").read_text(encoding="utf-8")
        declared = set(re.findall(r"^HL_API [^;(]*?(\w+)\(", header, re.MULTILINE))
        self.assertGreater(len(declared), 100)
        page = (SOURCE / "docs/python.md").read_text(encoding="utf-8")
        exceptions = page[page.index("In place of `hlCreateContext`"):page.index("No other call is missing")]
        self.assertEqual({name for name in declared if not hasattr(calls, name)}, set(re.findall(r"`(hl\w+)`", exceptions)))

    def test_what_a_body_and_a_joint_do_can_be_asked_one_by_one(self):
        self.hang_a_body()
        self.assertEqual(len(calls.hlGetBodydv(BODY, calls.HL_BODY_MATRIX)), 16)
        self.assertEqual(len(calls.hlGetBodydv(BODY, calls.HL_BODY_SPIN)), 3)
        self.assertAlmostEqual(calls.hlGetBodydv(BODY, calls.HL_BODY_POSITION)[1], 0.2)
        self.assertAlmostEqual(calls.hlGetJointdv(HINGE, calls.HL_JOINT_COORDINATE), 0)
        self.assertEqual(len(calls.hlGetJointdv(HINGE, calls.HL_JOINT_HOLD)), 3)
        self.assertIsNone(calls.hlGetBodydv(9, calls.HL_BODY_POSITION))
        self.assertIsNone(calls.hlGetJointdv(9, calls.HL_JOINT_FORCE))
        self.assertRaises(hl.InvalidValueError, lambda: calls.hlGetBodydv(BODY, calls.HL_JOINT_HOLD))


class Refusals(Connected):
    def test_after_a_deletion_that_is_refused_the_object_is_there_still(self):
        self.hang_a_body()
        with self.assertRaisesRegex(hl.RefusedError, "draw one, or the world without the joint"):
            with self.touch.frame():
                self.touch.delete(BODY)
        self.assertTrue(calls.hlIsObject(BODY))
        with self.touch.frame():
            self.touch.clear()
            self.touch.delete(BODY)
        self.assertFalse(calls.hlIsObject(BODY))
        self.wait_until(lambda: len(self.touch.bodies()) + len(self.touch.joints()) == 0)

    def test_after_a_redefinition_that_is_refused_the_mesh_before_can_be_bent(self):
        with self.touch.frame():
            with self.touch.define(9):
                self.touch.draw(*BOX, mode=calls.HL_QUADS)
            self.touch.place(9, np.eye(4))
        with self.assertRaises(hl.RefusedError):
            with self.touch.frame():
                with self.touch.define(9):
                    self.touch.body("hull", mass=0.1)
                    self.touch.draw(BOX[0][:3])
        with self.touch.frame():
            self.touch.update_vertices(9, BOX[0] * 2)


class Bodies(Connected):
    def test_one_without_an_extent_is_refused(self):
        for fixed in (False, True):
            with self.assertRaisesRegex(hl.RefusedError, "object 6.body: .*extent"):
                with self.touch.frame():
                    with self.touch.define(BODY):
                        self.touch.body("box", fixed=fixed)
                        self.touch.draw(0 * BOX[0], *BOX[1:], mode=calls.HL_QUADS)
                    self.touch.place(BODY)

    def test_a_mass_and_a_density_are_one_too_many(self):
        with self.touch.define():
            with self.assertRaisesRegex(hl.InvalidValueError, "mass or density"):
                self.touch.body(mass=1, density=0.5)
            self.touch.body(mass=1)
            self.touch.draw(*BOX, mode=calls.HL_QUADS)


class Owners(Connected):
    def test_a_forked_child_leaves_the_connection_to_its_parent(self):
        child = os.fork()
        if child == 0:
            try:
                self.touch.state()
                os._exit(1)
            except hl.InvalidOperationError as error:
                self.touch.close()
                os._exit(0 if "forked" in str(error) else 2)
        self.assertEqual(os.waitpid(child, 0)[1], 0)
        self.touch.state()

    def test_a_forked_child_ends_without_a_crash(self):
        script = "import hl, os\nhere = hl.connect()\nif os.fork() == 0: raise SystemExit(0)\nprint(os.wait()[1])"
        run = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
        self.assertEqual(run.stdout, "0\n")

    def test_another_thread_can_take_it_over_as_soon_as_the_last_one_is_joined(self):
        with hl.connect(name="second") as second:
            for _ in range(300):
                self.touch.make_current()  # this thread lets go of the other one
                thread = threading.Thread(target=second.state)
                thread.start()
                thread.join()
                second.state()


if __name__ == "__main__":
    unittest.main()

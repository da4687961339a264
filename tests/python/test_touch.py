"""hl.connect: frames, what is felt, events, errors; against a server in the process and one beside it."""
import asyncio
import gc
import json
import os
import re
import signal
import subprocess
import threading
import time
import unittest
import weakref
from pathlib import Path

import numpy as np

import hl

SOURCE = Path(os.environ["HL_SOURCE"])
HLD = os.environ["HLD_PROGRAM"]
PATIENCE_S = 20.0
FLOOR = (np.array([[-0.1, 0, -0.1], [0.1, 0, -0.1], [0.1, 0, 0.1], [-0.1, 0, 0.1]]), np.array([[0, 1, 2], [0, 2, 3]]))

BLOCK = (np.array([[x, y, z] for x in (-0.01, 0.01) for y in (-0.01, 0.01) for z in (-0.01, 0.01)]),
         np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]))


def wait_for(what, condition):
    """The first true value of `condition()`; the test fails when it never comes."""
    ends = time.monotonic() + PATIENCE_S
    while time.monotonic() < ends:
        found = condition()
        if found:
            return found
        time.sleep(0.01)
    raise AssertionError(f"waited in vain for {what}")


class Touching(unittest.TestCase):
    def setUp(self):
        self.touch = self.enterContext(hl.connect(name="test"))

    def show_floor(self, **surface):
        with self.touch.frame():
            with self.touch.name(7), self.touch.surface(**surface):
                self.touch.draw(*FLOOR)
        self.touch.hand_goal([0, -0.01, 0])

    def test_a_bezier_patch_is_felt(self):
        x, z = np.meshgrid(np.linspace(-0.1, 0.1, 4), np.linspace(-0.1, 0.1, 4))
        points = np.stack([x, np.zeros_like(x), z], axis=2)
        with self.touch.frame():
            hl.calls.hlNurbsSurface(points)
            self.assertRaises(hl.InvalidValueError, lambda: hl.calls.hlNurbsSurface(points, order_u=3))
            self.assertRaises(hl.InvalidValueError, lambda: hl.calls.hlNurbsSurface(points, knots_u=[0, 0, 0, 0, 1, 1, 1]))
        self.touch.hand_goal([0, -0.01, 0])
        (state,) = wait_for("a touch", lambda: [s for s in [self.touch.state()] if s.force[1] > 0.3 and s.safety == "on"])
        self.assertGreater(state.proxy[1], 0)

    def test_surfaces_that_are_no_meshes_are_felt(self):
        _, y, _ = np.meshgrid(*3 * [np.linspace(-1, 1, 9)], indexing="ij")
        steps = np.arange(-20, 21) * 0.001
        down = np.array([[1, 0, 0, 0], [0, 0, 1, 0.5], [0, -1, 0, 0], [0, 0, 0, 1]])  # a camera that looks along -y
        draws = [
            (lambda touch: touch.implicit({"expression": {"sphere": {"radius": 0.01}}}), None),
            (lambda touch: touch.volume(y.astype(np.float32), 0.0, 0.005, below=True), None),
            (lambda touch: touch.points([[a, 0, b] for a in steps for b in steps], surfels=True,
                                        colors=np.full((41 * 41, 3), 200, np.uint8)), None),
            (lambda touch: touch.volume((-y).astype(np.float32), 0.0, 0.005, matter=[(-1, 0, 0), (1, 0.1, 2)]), None),
            (lambda touch: touch.depth_frame(np.full((32, 32), 500, np.uint16), (32, 32, 15.5, 15.5)), down),
        ]
        self.touch.workspace([0, 0, 0], 1.0)  # it is not fitted to what is drawn
        self.touch.proxy_radius(0.002)
        for number, (draw, pose) in enumerate(draws):
            with self.subTest(number):
                self.touch.hand_goal([0, 0.03, 0])
                wait_for("the hand above", lambda: self.touch.state().finger[1] > 0.025)
                with self.touch.frame():
                    with self.touch.define(1):
                        draw(self.touch)
                    self.touch.place(1, pose)
                self.touch.hand_goal([0, -0.002, 0])
                wait_for("a touch", lambda: self.touch.state().force[1] > 0.3)

    def test_what_is_drawn_is_felt(self):
        self.show_floor()
        (state,) = wait_for("a touch", lambda: [s for s in [self.touch.state()] if s.force[1] > 0.3 and s.safety == "on"])
        self.assertTrue(state.touching)
        self.assertEqual(state.touched_name, 7)
        self.assertGreater(state.proxy[1], 0)
        spring = self.touch.get(hl.calls.HL_SPRING_STIFFNESS)
        np.testing.assert_allclose(state.force, spring * (state.proxy - state.finger), atol=1.0)
        contact = self.touch.contacts()[0]
        np.testing.assert_allclose(contact["normal"], [0, 1, 0], atol=1e-9)
        self.assertEqual(contact["name"], 7)

    def test_a_snap_holds_the_hand_and_a_field_draws_it(self):
        with self.touch.frame():
            with self.touch.define() as guide:
                self.touch.snap([9, 9, 9], 0.001, 1)
                self.touch.snap([[0, 0.02, 0], [0.05, 0.02, 0]], 0.004, 2)
                self.touch.snap([0, 5, 0], 0.001, 1, normal=[0, 1, 0])
                self.touch.field("magnet", [0, 0.06, 0], 0.01, 0.2)
                self.touch.field("drag", [0, 5, 0], 0.01, 2, normal=[0, 1, 0])
                self.touch.push_field([5, 5, 5], 0.01, [1, 0, 0])
                for call in (lambda: self.touch.snap([1, 2], 0.1, 1), lambda: self.touch.field("glue", [0, 0, 0], 1, 1),
                             lambda: self.touch.snap([[0, 0, 0], [1, 0, 0]], 0.1, 1, normal=[1, 0, 0]),
                             lambda: self.touch.field("spring", [0, 0, 0], 1, -1)):
                    self.assertRaises(hl.InvalidValueError, call)
            with self.touch.name(4):
                self.touch.place(guide)
        self.touch.hand_goal([0.01, 0.0205, 0])
        wait_for("the line", lambda: self.touch.state().snapped_object == guide)
        self.assertEqual((self.touch.state().snapped_name, self.touch.state().snap_number), (4, 1))
        self.touch.hand_goal([0, 0.057, 0])
        wait_for("the magnet", lambda: self.touch.state().snapped_object == 0 and self.touch.state().force[1] > 0.1)

    def test_a_spring_holds_a_body_and_tells_its_force(self):
        with self.touch.frame():
            with self.touch.define() as block:
                self.touch.body("box", mass=0.1)
                self.touch.draw(*BLOCK, mode=hl.calls.HL_QUADS)
            with self.touch.matrix([[1, 0, 0, 0.5], [0, 1, 0, 0.3], [0, 0, 1, 0], [0, 0, 0, 1]]):
                self.touch.place(block)
                self.touch.join(4, block, kind="slider", axis=[0, 1, 0], spring=200, damping=5,
                                table=([0, 1], [0.2, 0.2]))

        def joint():
            joints = self.touch.joints()
            return joints[0] if len(joints) == 1 else None

        sag = (0.1 * 9.81 - 0.2) / 200
        wait_for("rest", lambda: joint() is not None and abs(joint()["coordinate"] + sag) < 1e-6)
        self.assertEqual(joint()["joint"], 4)
        self.assertAlmostEqual(joint()["force"], 0.981, 2)

    def test_joints_that_make_no_sense_are_errors(self):
        with self.assertRaisesRegex(ValueError, "a joint has no 'stiffness': low, high"):
            self.touch.join(1, 2, stiffness=3)
        with self.assertRaisesRegex(ValueError, "there is no kind of joint 'door'"):
            self.touch.join(1, 2, kind="door")
        with self.assertRaisesRegex(ValueError, "as many forces as positions"):
            self.touch.join(1, 2, kind="slider", axis=[1, 0, 0], table=([0, 1], [2]))
        with self.assertRaisesRegex(ValueError, "not defined"):
            self.touch.join(1, 2)

    def test_a_body_falls_onto_the_floor_and_can_be_pushed(self):
        impacts = []
        self.touch.on("impact", impacts.append)
        pose = np.eye(4)
        pose[:3, 3] = 0.05, 0.03, 0.05
        with self.touch.frame():
            with self.touch.define() as block:
                self.touch.body("box", mass=0.1, restitution=0)
                self.touch.draw(*BLOCK, mode=hl.calls.HL_QUADS)
            self.touch.draw(*FLOOR)
            with self.touch.name(3):
                self.touch.place(block, pose)

        def body():
            bodies = self.touch.bodies()
            return bodies[0] if len(bodies) == 1 else None

        wait_for("rest", lambda: body() is not None and abs(body()["position"][1] - 0.01) < 1e-6)
        self.assertEqual((body()["object"], body()["name"]), (block, 3))
        wait_for("an impact", lambda: self.touch.poll() >= 0 and impacts)
        self.assertEqual((impacts[0].object, impacts[0].name), (block, 3))
        self.assertAlmostEqual(impacts[0].impulse, 0.1 * (2 * 9.81 * 0.02) ** 0.5, 2)
        with self.touch.name(3):
            self.touch.push(block, [0, 0.2, 0], body()["position"])
        wait_for("a jump", lambda: body()["position"][1] > 0.02)
        with self.assertRaises(hl.InvalidValueError):
            with self.touch.frame(), self.touch.define():
                self.touch.body(weight=1)

    def test_events_come_to_functions_on_this_thread(self):
        events = []
        self.touch.on("touch", lambda event: events.append((event.name, event.position[1], threading.get_ident())))
        self.show_floor()
        wait_for("an event", lambda: self.touch.poll() and events)
        self.assertEqual((events[0][0], events[0][2]), (7, threading.get_ident()))
        self.touch.on("touch", None)

    def test_a_hand_that_moves_on_is_an_event(self):
        events = []
        self.touch.on("motion", events.append)
        self.touch.hand_goal([0.03, 0, 0])
        wait_for("a motion", lambda: self.touch.poll() and events)
        self.assertEqual(events[0].kind, hl.calls.HL_EVENT_MOTION)

    def test_what_a_callback_raises_comes_out_of_poll(self):
        def fail(event):
            raise KeyError(event.name)

        self.touch.on("touch", fail)
        self.show_floor()

        def poll():
            try:
                self.touch.poll()
            except KeyError as error:
                return error
            return None

        self.assertEqual(wait_for("the exception", poll).args, (7,))

    def test_it_is_not_closed_by_a_callback(self):
        refused = []

        def close(event):
            with self.assertRaisesRegex(hl.InvalidOperationError, "close it afterwards"):
                self.touch.close()
            refused.append(event)

        self.touch.on("touch", close)
        self.show_floor()
        wait_for("a refusal", lambda: self.touch.poll() and refused)
        self.assertIsNotNone(self.touch.state(), "it is open as before")
        with self.touch.frame():
            self.touch.draw([(0, 0, 0), (1, 0, 0), (0, 1, 0)])

    def test_samples_are_a_structured_array(self):
        self.touch.keep_samples(500)
        (samples,) = wait_for("samples", lambda: [s for s in [self.touch.samples()] if len(s) > 10])
        np.testing.assert_allclose(np.diff(samples["time"]), 1e-3, atol=5e-3)
        self.assertEqual(samples["position"].shape, (len(samples), 3))

    def test_the_stylus_is_turned_and_told_in_states_and_samples(self):
        self.touch.keep_samples(1000)
        self.touch.hand_turn([0, 3, 0, -3])
        half = np.sqrt(0.5)
        state = wait_for("the turn", lambda: [s for s in [self.touch.state()] if abs(s.rotation[1] * s.rotation[3]) > 0.499])
        self.assertAlmostEqual(abs(state[0].rotation[1]), half, delta=0.05)
        self.assertEqual((state[0].gripper, state[0].grip_force), (0, 0))  # this device has none
        samples = self.touch.samples()
        np.testing.assert_allclose(np.linalg.norm(samples["rotation"], axis=1), 1, atol=1e-12)
        near = np.abs(samples["rotation"] @ state[0].rotation)
        self.assertGreater(near.max(), 1 - 1e-9)
        self.assertGreater(np.abs(samples["spin"]).max(), 0.1)

    def test_objects_are_placed_bent_and_forgotten(self):
        with self.touch.frame():
            with self.touch.define() as floor:
                self.touch.draw(*FLOOR)
            self.touch.place(floor)
        low = np.eye(4)
        low[1, 3] = -0.02
        with self.touch.frame():
            self.touch.place(floor, low)
        with self.touch.frame():
            self.touch.update_vertices(floor, FLOOR[0] + [0, 0.001, 0])
        self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), 2)
        with self.touch.frame():
            self.touch.delete(floor)
        self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), 0)

    def test_a_texture_changes_what_is_felt(self):
        soft = self.touch.make_texture(np.zeros((2, 2)))
        self.touch.make_texture(np.full((2, 3), 255, dtype=np.uint8))
        with self.touch.frame():
            with self.touch.texture(soft, "stiffness", 0.25, 1.0):
                self.touch.draw(*FLOOR, texcoords=np.zeros((4, 2)))
        self.touch.hand_goal([0, -0.01, 0])
        wait_for("a soft contact", lambda: len(c := self.touch.contacts()) > 0 and abs(c[0]["stiffness"] - 0.25) < 1e-6)

    def test_the_device_is_set(self):
        self.touch.spring(300.0)
        self.touch.workspace([0, 0.01, 0], 2.0)
        self.touch.proxy_radius(0.003)
        self.touch.ledger("strict")
        self.touch.hand_grip("firm")
        wait_for("the settings", lambda: self.touch.poll() >= 0 and self.touch.get(hl.calls.HL_WORKSPACE_SCALE) == 2.0)
        self.assertEqual(self.touch.get(hl.calls.HL_PROXY_RADIUS), 0.003)
        self.assertEqual(self.touch.get(hl.calls.HL_SPRING_STIFFNESS), 300.0)
        self.assertTrue(self.touch.is_master)
        self.assertIn("simulated", self.touch.device_name)

    def test_a_frame_that_fails_is_not_sent(self):
        self.show_floor()
        with self.assertRaises(ZeroDivisionError), self.touch.frame():
            self.touch.draw(*FLOOR)
            self.touch.draw(*FLOOR)
            raise ZeroDivisionError
        self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), 2)
        with self.touch.frame():
            self.touch.draw(*FLOOR)
        self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), 2)

    def test_a_frame_that_fails_has_not_been(self):
        with self.touch.define() as block:
            self.touch.draw(*BLOCK, mode=hl.calls.HL_QUADS)
        with self.touch.frame():
            self.touch.place(block)
            self.touch.draw(*FLOOR)
        primitives = 12 + len(FLOOR[1])

        def redefine():
            with self.touch.define(block):
                self.touch.draw(*FLOOR)

        for change in (lambda: self.touch.draw(*FLOOR), redefine, lambda: hl.calls.hlDeleteObjects([block]),
                       lambda: hl.calls.hlNewObject(block), self.touch.clear):
            with self.assertRaises(ZeroDivisionError), self.touch.frame():
                change()
                raise ZeroDivisionError
            with self.touch.frame():
                pass
            self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), primitives)
            with self.touch.frame():
                self.touch.place(block)
                self.touch.draw(*FLOOR)
            self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), primitives)

    def test_what_a_frame_leaves_open_is_refused_with_it_and_not_open_in_the_next(self):
        self.show_floor()
        for opened in (lambda: hl.calls.hlNewObject(7), lambda: hl.calls.hlBegin(hl.calls.HL_TRIANGLES)):
            for wait in (True, False):
                with self.assertRaises(hl.InvalidOperationError), self.touch.frame(wait=wait):
                    opened()
                with self.touch.frame():
                    self.touch.draw(*FLOOR)
                self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), 2)

    def test_a_definition_that_fails_leaves_the_object_as_it_was(self):
        with self.touch.frame(), self.touch.define() as block:
            self.touch.body("box", mass=0.1)
            self.touch.draw(*BLOCK, mode=hl.calls.HL_QUADS)
        with self.assertRaises(hl.InvalidValueError), self.touch.frame():
            with self.touch.define(block):
                self.touch.body("box", mass=0)
            self.touch.place(block)
        with self.assertRaises(hl.InvalidValueError), self.touch.frame():
            with self.touch.define() as other:
                self.touch.body("box", mass=0)
        with self.touch.frame():
            self.touch.place(block)
        self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), 12)
        with self.assertRaises(hl.InvalidValueError):
            self.touch.place(other)

    def test_errors_are_exceptions_with_one_line(self):
        wrong = [
            (hl.InvalidValueError, "HL_STIFFNESS must be 0 to 1", lambda: self.touch.material(stiffness=2)),
            (hl.InvalidValueError, "no quantity 'softness'", lambda: self.touch.material(softness=2)),
            (hl.InvalidValueError, "below the number of vertices", lambda: self.touch.draw(FLOOR[0], [[0, 1, 4]])),
            (hl.InvalidValueError, "rows of 4, but a primitive of this mode has 3", lambda: self.touch.draw(*BLOCK)),
            (hl.InvalidValueError, "shape (n, 3)", lambda: self.touch.draw([[0, 0]])),
            (hl.InvalidValueError, "must be integers", lambda: self.touch.draw(FLOOR[0], [[0, 1, 2.5]])),
            (hl.InvalidValueError, "shape (4, 4)", lambda: self.touch.place(1, np.eye(3))),
            (hl.InvalidValueError, "three numbers", lambda: self.touch.hand_goal([1, 2])),
            (hl.InvalidValueError, "no event", lambda: self.touch.on("tuch", print)),
            (hl.InvalidValueError, "", lambda: self.touch.hand_goal([np.nan, 0, 0])),
            (hl.InvalidValueError, "must be numbers", lambda: self.touch.hand_goal("abc")),
            (hl.InvalidValueError, "radius must be a number, and is 'a'", lambda: self.touch.proxy_radius("a")),
            (hl.InvalidValueError, "stiffness must be a number", lambda: self.touch.material(stiffness="x")),
            (hl.InvalidValueError, "a name must be a whole number", lambda: self.touch.name("box").__enter__()),
            (hl.InvalidValueError, "a name must not be negative", lambda: self.touch.name(-1).__enter__()),
            (hl.InvalidValueError, "the object's number must be", lambda: self.touch.place("x")),
            (hl.InvalidValueError, "a pose must be numbers", lambda: self.touch.place(1, "pose")),
            (hl.InvalidValueError, "vertices must be numbers", lambda: self.touch.draw([[0, 0, 0], [1]])),
            (hl.InvalidValueError, "indices must be integers", lambda: self.touch.draw(FLOOR[0], [[0, 1], [2]])),
            (hl.InvalidValueError, "shape (n, 3)", lambda: self.touch.draw(None, [[0]])),
            (hl.InvalidValueError, "mode must be", lambda: self.touch.draw(FLOOR[0], mode="triangles")),
            (hl.InvalidValueError, "uint8, or floats", lambda: self.touch.make_texture([[0, 255]])),
            (hl.InvalidValueError, "floats must be 0..1", lambda: self.touch.make_texture([[0.0, 255.0]])),
            (hl.InvalidValueError, "can be called", lambda: self.touch.on("touch", 3)),
            (hl.InvalidValueError, "no shading", lambda: self.touch.shade(["flat"])),
            (hl.InvalidValueError, "a query must be", lambda: self.touch.get("HL_FORCE")),
            (hl.InvalidOperationError, "", lambda: hl.calls.hlPopMatrix()),
            (hl.InvalidOperationError, "", lambda: hl.calls.hlEnd()),
        ]
        self.touch.make_current()
        for kind, text, call in wrong:
            with self.subTest(text), self.assertRaisesRegex(kind, re.escape(text)):
                call()
        hl.calls.hlBegin(hl.calls.HL_TRIANGLES)
        with self.assertRaises(hl.InvalidOperationError):
            hl.calls.hlPushMatrix()
        hl.calls.hlEnd()

    def test_a_frame_within_a_frame_is_refused(self):
        with self.touch.frame():
            self.touch.draw(*FLOOR)
            with self.assertRaisesRegex(hl.InvalidOperationError, "within another"):
                with self.touch.frame():
                    pass
        self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), 2)

    def test_what_keeps_its_touch_and_is_called_by_it_is_freed(self):
        class Experiment:
            def __init__(self):
                self.touch = hl.connect(name="freed")
                self.touch.on("touch", self.hear)

            def hear(self, event):
                pass

        gone = weakref.ref(Experiment())
        gc.collect()
        self.assertIsNone(gone())

    def test_states_may_be_compared(self):
        state = self.touch.state()
        self.assertTrue(state == state and state != self.touch.state())

    def test_closed_is_closed(self):
        self.touch.close()
        self.touch.close()
        with self.assertRaises(hl.InvalidOperationError):
            self.touch.state()
        with self.assertRaises(hl.InvalidOperationError):
            hl.calls.hlFlush()

    def test_one_context_is_used_by_one_thread_at_a_time(self):
        failed = []

        def use():
            try:
                self.touch.state()
            except hl.InvalidOperationError as error:
                failed.append(error)

        self.touch.make_current()
        other = threading.Thread(target=use)
        other.start()
        other.join()
        self.assertEqual(len(failed), 1)

    def test_two_contexts_take_turns(self):
        with hl.connect(name="second") as second:
            with second.frame():
                second.draw(*FLOOR)
            with self.touch.frame():
                self.touch.draw(FLOOR[0][:3])
            self.assertEqual(second.get(hl.calls.HL_FRAME_PRIMITIVES), 2)
            self.assertEqual(self.touch.get(hl.calls.HL_FRAME_PRIMITIVES), 1)

    def test_states_come_as_an_async_stream(self):
        async def take(count):
            times = []
            async for state in self.touch.states(200):
                times.append(state.time)
                if len(times) == count:
                    return times

        times = asyncio.run(asyncio.wait_for(take(20), PATIENCE_S))
        self.assertTrue(np.all(np.diff(times) > 0))


class AServerBesideIt(unittest.TestCase):
    def test_a_hand_is_chosen_by_its_name(self):
        server = subprocess.Popen([HLD, "--port", "0", "--log-format", "json", "--device", "sim:touch",
                                   "--device", "pen=sim:premium1.5"], stderr=subprocess.PIPE, text=True)
        with server.stderr:
            address = next(json.loads(line) for line in server.stderr if '"ready"' in line)["address"]
            url = "hl://" + address.split("//")[1].rstrip("/")
            try:
                with hl.connect(url, device="pen") as pen, hl.connect(url, device=0) as left:
                    self.assertEqual(pen.devices, ["left", "pen"])
                    self.assertEqual((pen.device_label, left.device_label), ("pen", "left"))
                    self.assertIn("Premium 1.5", pen.device_name)
                    self.assertEqual((pen.get(hl.calls.HL_DEVICE), left.get(hl.calls.HL_DEVICE)), (1, 0))
                    self.assertTrue(pen.is_master and left.is_master)
                with self.assertRaisesRegex(hl.ConnectError, "no device 'right'; the server has 2: 0 .left., 1 .pen."):
                    hl.connect(url, device="right")
            finally:
                server.send_signal(signal.SIGTERM)
                server.wait()

    def test_it_is_reached_by_its_address_and_its_end_is_told(self):
        server = subprocess.Popen([HLD, "--port", "0", "--log-format", "json"], stderr=subprocess.PIPE, text=True)
        with server.stderr:
            address = next(json.loads(line) for line in server.stderr if '"ready"' in line)["address"]
            with hl.connect("hl://" + address.split("//")[1].rstrip("/"), name="far", state_rate=100) as touch:
                with touch.frame():
                    touch.draw(*FLOOR)
                self.assertEqual(touch.get(hl.calls.HL_FRAME_PRIMITIVES), 2)
                self.assertEqual(touch.server_version, hl.__version__)
                server.send_signal(signal.SIGTERM)
                server.wait()
                with self.assertRaises(hl.ConnectionLostError):
                    wait_for("the end", touch.poll)
                for call in (touch.state, touch.poll, touch.samples, touch.frame().__enter__, hl.calls.hlFinish,
                             lambda: touch.hand_goal([0, 0, 0])):
                    with self.assertRaises(hl.ConnectionLostError):
                        call()  # not once alone
                with self.assertRaises(hl.ConnectionLostError):
                    asyncio.run(touch.states().__anext__())

    def test_a_signal_is_heard_while_a_frame_waits_for_a_server_that_is_stuck(self):
        class Heard(Exception):
            pass

        def hear(_number, _frame):
            raise Heard

        server = subprocess.Popen([HLD, "--port", "0", "--log-format", "json"], stderr=subprocess.PIPE, text=True)
        before = signal.signal(signal.SIGALRM, hear)
        try:
            address = next(json.loads(line) for line in server.stderr if '"ready"' in line)["address"]
            with hl.connect("hl://" + address.split("//")[1].rstrip("/")) as touch:
                server.send_signal(signal.SIGSTOP)
                signal.setitimer(signal.ITIMER_REAL, 0.1)
                with self.assertRaises(Heard), touch.frame():
                    touch.draw(*FLOOR)
                server.send_signal(signal.SIGCONT)
                with touch.frame():
                    touch.draw(*FLOOR)
                self.assertEqual(touch.get(hl.calls.HL_FRAME_PRIMITIVES), 2)
        finally:
            signal.signal(signal.SIGALRM, before)
            server.kill()
            server.communicate()

    def test_nobody_there_is_told(self):
        with self.assertRaisesRegex(hl.ConnectError, "refused the connection"):
            hl.connect("hl://127.0.0.1:9")
        with self.assertRaisesRegex(hl.ConnectError, "speed"):
            hl.connect("inproc:", speed=3)


class Constants(unittest.TestCase):
    def test_those_of_hl_types_h_are_there(self):
        types = (SOURCE / "include/hl/hl_types.h").read_text(encoding="utf-8")
        for name, value in re.findall(r"\b(HL_\w+) = (\w+)", types):
            self.assertEqual(getattr(hl.calls, name), int(value, 0), name)

    def test_queries_have_as_many_values_as_hl_types_says(self):
        with hl.connect():
            self.assertEqual(len(hl.calls.hlGetDoublev(hl.calls.HL_MODELVIEW_MATRIX)), 16)
            self.assertEqual(len(hl.calls.hlGetFloatv(hl.calls.HL_FORCE)), 3)
            self.assertEqual(hl.calls.hlGetIntegerv(hl.calls.HL_MATRIX_MODE), hl.calls.HL_MODELVIEW)
            self.assertEqual(hl.calls.hlGetString(hl.calls.HL_VENDOR), "HL")


if __name__ == "__main__":
    unittest.main()

"""hl.gym and hl.lerobot, against what they use of those packages (fakes)."""
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "fakes"))

import gymnasium
import numpy as np

import hl
import hl.lerobot


class Press(unittest.TestCase):
    def test_one_who_presses_along_the_normal_is_rewarded(self):
        env = gymnasium.make("hl.gym:hl/Press-v0", scene="sphere:5000", size=0.1)
        observed, _ = env.reset(seed=3)
        self.assertTrue(env.observation_space.contains(observed))
        rewards = []
        for _ in range(200):
            to_place, normal = observed[:3], observed[6:9]
            # Towards the place, and 1 mm behind it: 1 N at 1000 N/m.
            goal = 0.1 * (to_place - observed[3:6]) - 0.001 * normal
            observed, reward, terminated, truncated, info = env.step(goal / 0.002)
            rewards.append(reward)
            self.assertFalse(terminated or truncated)
        self.assertLess(rewards[0], -1.0)
        self.assertGreater(rewards[-1], -0.1)
        self.assertAlmostEqual(np.linalg.norm(info["force"]), 1.0, delta=0.05)

    def test_the_same_seed_gives_the_same_bits(self):
        env = gymnasium.make("hl.gym:hl/Press-v0")
        first = [env.reset(seed=5)[0].tobytes()] + [env.step([0.1, -0.2, 0.3])[0].tobytes() for _ in range(20)]
        again = [env.reset(seed=5)[0].tobytes()] + [env.step([0.1, -0.2, 0.3])[0].tobytes() for _ in range(20)]
        self.assertEqual(first, again)


class Teleoperation(unittest.TestCase):
    def setUp(self):
        self.device = hl.lerobot.HLTeleoperator(hl.lerobot.HLTeleoperatorConfig(scale=2.0))
        self.device.connect()
        self.addCleanup(self.device.disconnect)

    def feel(self, force, seconds):
        """Sends a force at 50 Hz; the mean of what is felt in the last half."""
        felt = []
        for i in range(int(50 * seconds)):
            self.device.send_feedback({"force.x": force[0], "force.y": force[1], "force.z": force[2]})
            time.sleep(0.02)
            self.device.get_action()
            if i > 25 * seconds:
                felt.append(self.device._touch.state().force)
        return np.mean(felt, axis=0)

    def test_it_is_registered(self):
        from lerobot.teleoperators import TeleoperatorConfig

        self.assertIs(TeleoperatorConfig.known["hl"], hl.lerobot.HLTeleoperatorConfig)
        self.assertTrue(self.device.is_connected and self.device.is_calibrated)

    def test_a_force_is_felt_in_its_direction_and_about_its_size(self):
        for force in [(0.0, 1.0, 0.0), (0.0, 0.0, -0.6), (0.5, 0.5, 0.0)]:
            felt = self.feel(force, 2.0)
            np.testing.assert_allclose(felt, force, atol=0.25)

    def test_a_force_that_is_not_renewed_ends(self):
        self.feel((0.0, 1.0, 0.0), 1.0)
        time.sleep(0.2)
        self.device.get_action()
        time.sleep(0.3)
        self.device.get_action()
        self.assertLess(np.linalg.norm(self.device._touch.state().force), 1e-6)

    def test_the_tip_is_told_in_metres_of_the_robot(self):
        self.device._touch.hand_goal(self.device._origin + [0.01, 0.0, 0.0])
        time.sleep(1.5)
        action = self.device.get_action()
        self.assertAlmostEqual(action["tip.x"], 0.02, delta=0.002)
        self.assertEqual(set(action), set(self.device.action_features))

    def test_what_is_not_finite_is_refused(self):
        with self.assertRaises(ValueError):
            self.device.send_feedback({"force.x": float("nan"), "force.y": 0, "force.z": 0})


if __name__ == "__main__":
    unittest.main()

"""Small scenes, finger paths, and hl trace on them, all in a temporary folder."""
import csv
import json
import math
import subprocess

RATE_HZ = 1000.0
HALF_WIDTH_M = 0.05   # scenes are drawn in the plane z = 0 and stand this far to both sides of it


class Bench:
    def __init__(self, hl, folder):
        self.hl, self.folder, self.count = hl, folder, 0

    def new_file(self, ending):
        self.count += 1
        return self.folder / f"{self.count}{ending}"

    def obj(self, faces):
        """A model file; a face is a list of corners, a corner (x, y, z) or (x, y, z, normal)."""
        lines, number = [], 0
        for face in faces:
            with_normals = len(face[0]) > 3
            for corner in face:
                lines.append("v " + " ".join(map(repr, corner[:3])))
                normal = corner[3] if with_normals else (0, 0, 0)
                lines.append("vn " + " ".join(map(repr, normal)))
            numbers = range(number + 1, number + len(face) + 1)
            lines.append("f " + " ".join(f"{i}//{i}" if with_normals else str(i) for i in numbers))
            number += len(face)
        file = self.new_file(".obj")
        file.write_text("\n".join(lines) + "\n")
        return file

    def scene(self, objects, textures=()):
        """A scene file, for what model files cannot say: materials and textures."""
        file = self.new_file(".hl.json")
        file.write_text(json.dumps({"textures": list(textures), "objects": objects}))
        return file

    def trace(self, scene, points, *options, rate_Hz=RATE_HZ):
        """Rows of the trace as dictionaries of numbers, one for each point of the finger's path."""
        path, out = self.new_file(".csv"), self.new_file(".csv")
        with path.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["t", "x", "y", "z"])
            writer.writerows([i / rate_Hz, *p] for i, p in enumerate(points))
        command = [self.hl, "trace", str(scene), "--path", str(path), "--out", str(out), *map(str, options)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"figures: {' '.join(command)}\n{done.stderr}")
        with out.open() as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def wall(a, b):
    """A rectangle that stands on the line from a to b."""
    (ax, ay), (bx, by) = a, b
    return [(ax, ay, HALF_WIDTH_M), (bx, by, HALF_WIDTH_M), (bx, by, -HALF_WIDTH_M), (ax, ay, -HALF_WIDTH_M)]


def loop(corners):
    """Walls around a polygon."""
    return [wall(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]


def corners_of(sides, radius):
    """Of a regular polygon whose face 0 looks along +x."""
    angles = [math.pi / sides * (2 * i - 1) for i in range(sides)]
    return [(radius * math.cos(a), radius * math.sin(a)) for a in angles]


def prism(sides, radius):
    """A regular prism about z with radial vertex normals."""
    faces = []
    corners = corners_of(sides, radius)
    for a, b in zip(corners, corners[1:] + corners[:1]):
        normal_of = {p: (p[0] / radius, p[1] / radius, 0.0) for p in (a, b)}
        faces.append([(*corner, normal_of[corner[:2]]) for corner in wall(a, b)])
    return faces


def straight(*stops, speed):
    """Points from stop to stop in the plane z = 0, one a tick."""
    points = [(*stops[0], 0.0)]
    for (ax, ay), (bx, by) in zip(stops, stops[1:]):
        n = max(1, round(math.hypot(bx - ax, by - ay) * RATE_HZ / speed))
        points += [(ax + (bx - ax) * i / n, ay + (by - ay) * i / n, 0.0) for i in range(1, n + 1)]
    return points


def around(radius, speed, turn=2 * math.pi):
    """Points on a circle about the origin, from the x axis on, without the first."""
    n = round(turn * radius * RATE_HZ / speed)
    return [(radius * math.cos(turn * i / n), radius * math.sin(turn * i / n), 0.0) for i in range(1, n + 1)]

"""Plain judges in numpy for what hl returns: every triangle is looked at, and nothing is remembered.

Triangles are (m, 3, 3), points (n, 3), in m. Degenerate triangles must be left out before.
"""
import numpy as np


def triangles_of(vertices, indices):
    """(m, 3, 3), and the numbers of those that have an area."""
    corners = np.asarray(vertices, dtype=float)[indices]
    sides = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    longest = np.max(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2), axis=1)
    kept = np.flatnonzero(areas > 1e-9 * longest**2)
    return corners[kept], kept


def _on_segment(points, begin, end):
    """Of each point the nearest of each segment: (n, m, 3)."""
    along = end - begin
    share = np.einsum("nmi,mi->nm", points[:, None] - begin, along) / np.einsum("mi,mi->m", along, along)
    return begin + np.clip(share, 0, 1)[..., None] * along


def nearest_points(points, triangles):
    """Of each point the nearest of each triangle: (n, m, 3)."""
    a, b, c = (triangles[:, i] for i in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    height = np.einsum("nmi,mi->nm", points[:, None] - a, normal)
    foot = points[:, None] - height[..., None] * normal
    inside = np.ones(height.shape, dtype=bool)
    for begin, end in ((a, b), (b, c), (c, a)):
        inside &= np.einsum("nmi,mi->nm", foot - begin, np.cross(normal, end - begin)) >= 0
    candidates = np.stack([foot, *(_on_segment(points, *side) for side in ((a, b), (b, c), (c, a)))])
    far = np.linalg.norm(points[:, None] - candidates, axis=3)
    far[0][~inside] = np.inf
    return np.take_along_axis(candidates, np.argmin(far, axis=0)[None, ..., None], axis=0)[0]


def distances(points, triangles):
    """(n, m)."""
    return np.linalg.norm(points[:, None] - nearest_points(points, triangles), axis=2)


def winding(points, triangles):
    """How often a closed surface goes around each point (van Oosterom and Strackee 1983): 0 is outside."""
    a, b, c = (triangles[None, :, i] - points[:, None] for i in range(3))
    la, lb, lc = (np.linalg.norm(v, axis=2) for v in (a, b, c))
    over = np.einsum("nmi,nmi->nm", a, np.cross(b, c))
    under = la * lb * lc + sum(np.einsum("nmi,nmi->nm", u, v) * w for u, v, w in ((a, b, lc), (b, c, la), (c, a, lb)))
    return np.sum(2 * np.arctan2(over, under), axis=1) / (4 * np.pi)


def way_is_clear(begin, end, triangles, radius, pieces=64):
    """Whether a sphere certainly can go straight from one place to another: between samples it is told by the distance
    that a sample has left, so that False may be wrong, and True is not."""
    samples = begin + np.linspace(0, 1, pieces + 1)[:, None] * (end - begin)
    slack = np.min(distances(samples, triangles), axis=1) - radius
    return bool(np.all(slack > np.linalg.norm(end - begin) / pieces / 2 + 1e-9 * radius))


def unresisted(pull, normals):
    """The part of a pull that contacts with these normals, (k, 3), do not resist: |pull + sum(shares * normals)|, the
    least with shares >= 0; by Lawson and Hanson."""
    shares, active = np.zeros(len(normals)), np.zeros(len(normals), dtype=bool)
    rest = np.array(pull, dtype=float)
    for _ in range(10 * len(normals) + 10):
        gain = -(normals @ rest)
        gain[active] = -np.inf
        if len(normals) == 0 or np.max(gain) <= 1e-13 * np.linalg.norm(pull):
            break
        active[np.argmax(gain)] = True
        shares = _with_active(pull, normals, shares, active)
        rest = pull + shares @ normals
    return float(np.linalg.norm(rest))


def _with_active(pull, normals, shares, active):
    """Least squares over the active normals; those whose share would be negative stop being active."""
    while np.any(active):
        wanted = np.zeros(len(normals))
        wanted[active] = np.linalg.lstsq(normals[active].T, -pull, rcond=None)[0]
        if np.all(wanted[active] > 0):
            return wanted
        falling = active & (wanted <= 0)
        part = np.min(shares[falling] / np.maximum(shares[falling] - wanted[falling], 1e-300))
        shares = shares + part * (wanted - shares)
        active &= shares > 0
        active[falling & (shares <= 1e-300)] = False
    return np.zeros(len(normals))

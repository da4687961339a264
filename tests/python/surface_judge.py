"""Plain judges of surfaces that are no meshes, from the docs alone: numpy only, nothing of hl.

Triangles are (n, 3, 3) arrays, points (m, 3).
"""
import itertools
import numpy as np


def point_triangle(points, tris, chunk=2_000_000):
    """Distance (m,) and nearest point (m, 3) of each point to a soup of triangles; points of a segment or point too."""
    points = np.asarray(points, float)
    best = np.full(len(points), np.inf)
    where = np.full(points.shape, np.nan)
    if len(tris) == 0:
        return best, where
    a, b, c = tris[:, 0], tris[:, 1], tris[:, 2]
    rows = max(1, chunk // len(tris))
    for first in range(0, len(points), rows):
        p = points[first:first + rows, None, :]
        near = _closest(p, a[None], b[None], c[None])
        d = np.linalg.norm(p - near, axis=2)
        k = np.argmin(d, axis=1)
        i = np.arange(len(k))
        best[first:first + rows] = d[i, k]
        where[first:first + rows] = near[i, k]
    return best, where


def _segment(p, a, b):
    ab = b - a
    t = ((p - a) * ab).sum(-1) / np.maximum((ab * ab).sum(-1), 1e-300)
    return a + np.clip(t, 0, 1)[..., None] * ab


def _closest(p, a, b, c):
    ab, ac = b - a, c - a
    n = np.cross(ab, ac)
    nn = np.maximum((n * n).sum(-1), 1e-300)
    q = p - (((p - a) * n).sum(-1) / nn)[..., None] * n
    inside = ((np.cross(ab, q - a) * n).sum(-1) >= 0) & ((np.cross(c - b, q - b) * n).sum(-1) >= 0) \
        & ((np.cross(a - c, q - c) * n).sum(-1) >= 0) & ((n * n).sum(-1) > 0)
    best = np.where(inside[..., None], q, np.inf)
    dist = np.where(inside, ((q - p) ** 2).sum(-1), np.inf)
    for s, t in ((a, b), (b, c), (c, a)):
        e = _segment(p, s, t)
        d = ((e - p) ** 2).sum(-1)
        better = d < dist
        best = np.where(better[..., None], e, best)
        dist = np.where(better, d, dist)
    return best


def height_triangles(h, dx, dz, scale=1.0, missing=None):
    """The triangles of docs/heights.md: the diagonal goes from a cell's first corner to the one opposite."""
    h = np.asarray(h)
    bad = ~np.isfinite(h.astype(float))
    if missing is not None:
        bad |= h == missing
    rows, cols = h.shape
    x = (np.arange(cols) - (cols - 1) / 2) * dx
    z = (np.arange(rows) - (rows - 1) / 2) * dz
    X, Z = np.meshgrid(x, z)
    v = np.stack([X, h.astype(float) * scale, Z], -1)
    ok = ~(bad[:-1, :-1] | bad[1:, :-1] | bad[:-1, 1:] | bad[1:, 1:])
    v00, v01, v10, v11 = v[:-1, :-1][ok], v[:-1, 1:][ok], v[1:, :-1][ok], v[1:, 1:][ok]
    return np.concatenate([np.stack([v00, v01, v11], 1), np.stack([v00, v11, v10], 1)])


def edge_vertices(vol, iso, spacing, missing=None):
    """Where docs/volumes.md has vertices: on each grid edge whose ends are on different sides. Also the samples."""
    v = np.asarray(vol).astype(float)
    if missing is not None:
        v = np.where(np.asarray(vol) == missing, np.nan, v)
    nz, ny, nx = v.shape
    axes = [(np.arange(n) - (n - 1) / 2) * s for n, s in zip((nx, ny, nz), spacing)]
    Z, Y, X = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    pos = np.stack([X, Y, Z], -1)
    # a cell counts where all of its eight samples are numbers
    okc = np.ones((nz - 1, ny - 1, nx - 1), bool)
    for i, j, k in itertools.product((0, 1), repeat=3):
        okc &= np.isfinite(v[i:nz - 1 + i, j:ny - 1 + j, k:nx - 1 + k])
    out = []
    for axis in range(3):
        lo = [slice(None)] * 3
        hi = [slice(None)] * 3
        lo[axis], hi[axis] = slice(None, -1), slice(1, None)
        lo, hi = tuple(lo), tuple(hi)
        a, b = v[lo], v[hi]
        pad = [(0, 0) if k == axis else (1, 1) for k in range(3)]
        cells = np.pad(okc, pad)
        use = np.zeros(a.shape, bool)
        others = [k for k in range(3) if k != axis]
        for s, t in itertools.product((0, 1), repeat=2):
            ix = [slice(None)] * 3
            ix[others[0]] = slice(s, s + a.shape[others[0]])
            ix[others[1]] = slice(t, t + a.shape[others[1]])
            use |= cells[tuple(ix)]
        cross = use & ((a >= iso) != (b >= iso))
        t = (iso - a[cross]) / (b[cross] - a[cross])
        out.append(pos[lo][cross] + t[:, None] * (pos[hi][cross] - pos[lo][cross]))
    return np.concatenate(out), pos.reshape(-1, 3), v.reshape(-1)


def cone_residual(normals, pull):
    """The part of `pull` that no contact resists: distance of -pull from the cone of the normals, exhaustively."""
    best = np.linalg.norm(pull)
    if not len(normals):
        return best
    N = np.unique(np.round(normals, 12), axis=0)
    if len(N) > 24:
        N = N[np.argsort(N @ pull)[:24]]
    for k in (1, 2, 3):
        for ix in itertools.combinations(range(len(N)), k):
            A = N[list(ix)].T
            w, *_ = np.linalg.lstsq(A, -pull, rcond=None)
            if (w >= -1e-12).all():
                best = min(best, np.linalg.norm(pull + A @ np.maximum(w, 0)))
    return best


def contacts(p, r, tris, skin):
    """Normals of what a ball touches."""
    near = _closest(p[None], tris[:, 0], tris[:, 1], tris[:, 2])
    d = p - near
    length = np.linalg.norm(d, axis=1)
    k = length <= r * (1 + skin)
    return d[k] / length[k, None]


def crossings(p, q, tris):
    """Which straight ways p -> q (m, 3) cut the triangles an odd number of times: the way over a crest cuts it twice."""
    a = tris[:, 0]
    e1, e2 = tris[:, 1] - a, tris[:, 2] - a
    hit = np.zeros(len(p), bool)
    for i in range(len(p)):
        d = q[i] - p[i]
        if not d.any():
            continue
        h = np.cross(d, e2)
        det = (e1 * h).sum(-1)
        with np.errstate(all="ignore"):
            s = p[i] - a
            u = (s * h).sum(-1) / det
            g = np.cross(s, e1)
            v = (g @ d) / det
            t = (e2 * g).sum(-1) / det
            hit[i] = ((u > 0) & (v > 0) & (u + v < 1) & (t > 0) & (t < 1)).sum() % 2
    return hit


def boundary(tris):
    """Edges that one triangle alone has, as triangles without area."""
    e = np.concatenate([tris[:, [0, 1]], tris[:, [1, 2]], tris[:, [2, 0]]])
    a, b = e[:, 0], e[:, 1]
    first = np.array([tuple(x) <= tuple(y) for x, y in zip(a, b)], bool)
    key = np.where(first[:, None], np.concatenate([a, b], 1), np.concatenate([b, a], 1))
    u, count = np.unique(key, axis=0, return_counts=True)
    u = u[count == 1].reshape(-1, 2, 3)
    return np.concatenate([u, u[:, 1:]], 1)


def judge_trace(path, proxy, force, r, k, tris, minimal=40, tol=1e-6, resid=2e-5):
    """What is wrong, as texts: all of docs/trace.md that can be told from outside."""
    wrong = []
    f = path[:, 1:4]
    size = max(np.abs(tris).max() if len(tris) else 0, np.abs(proxy).max())
    eps = 1e-15 * size * 20
    d, _ = point_triangle(proxy, tris)
    low = d < r * (1 - tol) - eps
    if low.any():
        i = int(np.argmin(d))
        wrong.append(f"inside: {low.sum()} rows, worst row {i}: d/r = {d[i] / r:.9g} (eps {eps / r:.2g} r)")
    e = np.abs(force - k * (proxy - f)).max() / max(1e-30, np.abs(force).max())
    if e > 1e-9:
        wrong.append(f"force is not K (proxy - finger): {e:.3g}")
    cut = np.flatnonzero(crossings(proxy[:-1], proxy[1:], tris))
    if len(cut):
        # the way of a tick only comes nearer to the finger: it may go around what has an edge in that ball
        rim = boundary(tris)
        far = np.linalg.norm(f[cut + 1] - proxy[cut], axis=1)
        open_ = point_triangle(f[cut + 1], rim)[0] if len(rim) else np.full(len(cut), np.inf)
        cut = cut[open_ > far * (1 + 1e-9) + eps]
    if len(cut):
        wrong.append(f"passed through the surface in rows {cut[:5] + 1}")
    pull = np.linalg.norm(f - proxy, axis=1)
    rows = np.flatnonzero(pull > 1e-6 * r)
    if len(rows) > minimal:
        rows = rows[np.linspace(0, len(rows) - 1, minimal).astype(int)]
    for i in rows:
        n = contacts(proxy[i], r, tris, 1e-6 + 4e-13 * size / r)
        res = cone_residual(n, f[i] - proxy[i]) / pull[i]
        if res > resid:
            wrong.append(f"not a local minimum: row {i}, residual {res:.3g} of the pull, {len(n)} contacts")
            break
    return wrong

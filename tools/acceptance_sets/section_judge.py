# SPDX-License-Identifier: Apache-2.0
"""Plane sections of NURBS surfaces judged without the program: B-splines by the recurrence of Cox and
de Boor in numpy, branches counted by the signs on a grid of parameters. """
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


def local_basis(degree, knots, at):
    """First control point of each place of the parameter, and the values of the degree + 1 B-splines there."""
    knots, at = np.asarray(knots, float), np.asarray(at, float)
    last = len(knots) - degree - 2
    span = np.clip(np.searchsorted(knots, at, side="right") - 1, degree, last)
    values = np.zeros((len(at), degree + 1))
    values[:, 0] = 1.0
    for p in range(1, degree + 1):
        before = values.copy()
        values[:, :p + 1] = 0.0
        for r in range(p):
            left, right = knots[span - p + 1 + r], knots[span + 1 + r]
            share = (at - left) / (right - left)
            values[:, r] += (1.0 - share) * before[:, r]
            values[:, r + 1] += share * before[:, r]
    return span - degree, values


def basis(degree, knots, at):
    """The same as rows over all control points; (places, control points)."""
    first, values = local_basis(degree, knots, at)
    rows = np.zeros((len(first), len(knots) - degree - 1))
    for r in range(degree + 1):
        rows[np.arange(len(first)), first + r] = values[:, r]
    return rows


class Patch:
    def __init__(self, told):
        self.knots = [np.array(told["knots_u"]), np.array(told["knots_v"])]
        self.degree = [told["degree_u"], told["degree_v"]]
        n, m = (len(k) - d - 1 for k, d in zip(self.knots, self.degree))
        points = np.array(told["points"], float).reshape(m, n, 3)
        weights = np.array(told.get("weights") or np.ones(m * n), float).reshape(m, n, 1)
        self.net = np.concatenate([points * weights, weights], axis=2)

    def domain(self, axis):
        return self.knots[axis][0], self.knots[axis][-1]

    def grid(self, us, vs):
        """Points, (v, u, 3)."""
        rows = np.tensordot(basis(self.degree[1], self.knots[1], vs), self.net, axes=(1, 0))
        out = np.einsum("ui,vix->vux", basis(self.degree[0], self.knots[0], us), rows)
        return out[..., :3] / out[..., 3:]

    def points(self, uv):
        """At pairs of parameters, (places, 3)."""
        i, a = local_basis(self.degree[0], self.knots[0], uv[:, 0])
        j, b = local_basis(self.degree[1], self.knots[1], uv[:, 1])
        out = np.zeros((len(uv), 4))
        for q in range(self.degree[1] + 1):
            for p in range(self.degree[0] + 1):
                out += (a[:, p] * b[:, q])[:, None] * self.net[j + q, i + p]
        return out[:, :3] / out[:, 3:]

    def places(self, axis, count):
        """Knots and places between them, `count` or more in all."""
        ends = np.unique(self.knots[axis])
        each = max(2, -(-count // (len(ends) - 1)))
        return np.concatenate([np.linspace(a, b, each, endpoint=False) for a, b in zip(ends, ends[1:])] + [ends[-1:]])


def components(patch, normal, offset, count):
    """Branches of a section in one patch by signs on a grid: (crossings n x 3, label of each, ends per label as
    crossings on the border)."""
    us, vs = patch.places(0, count), patch.places(1, count)
    points = patch.grid(us, vs)
    height = points @ normal - offset
    sign = height >= 0.0
    along = sign[:, 1:] != sign[:, :-1]  # edges along u, (v, u - 1)
    across = sign[1:, :] != sign[:-1, :]
    number = -np.ones(along.size + across.size, int)
    where = np.concatenate([np.flatnonzero(along), along.size + np.flatnonzero(across)])
    number[where] = np.arange(len(where))
    if not len(where):
        return np.zeros((0, 3)), np.zeros(0, int), np.zeros(0, bool)
    a = number[:along.size].reshape(along.shape)
    b = number[along.size:].reshape(across.shape)
    sides = np.stack([a[:-1], b[:, 1:], a[1:], b[:, :-1]], axis=-1)  # bottom, right, top, left of each cell
    crossed = (sides >= 0).sum(axis=-1)
    pairs = [np.sort(sides[crossed == 2], axis=-1)[:, 2:]]
    for j, i in zip(*np.nonzero(crossed == 4)):
        middle = patch.grid([(us[i] + us[i + 1]) / 2], [(vs[j] + vs[j + 1]) / 2])[0, 0] @ normal - offset >= 0.0
        bottom, right, top, left = sides[j, i]
        pairs.append(np.array([[bottom, right], [top, left]] if middle == sign[j, i] else [[bottom, left], [top, right]]))
    pairs = np.concatenate(pairs)
    links = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(where),) * 2)
    label = connected_components(links, directed=False)[1]
    # crossings by regula falsi on the surface itself
    def uv_of(share):
        rows, columns = np.nonzero(along)
        first = np.stack([us[columns] + share[:len(rows)] * (us[columns + 1] - us[columns]), vs[rows]], axis=1)
        other, here = np.nonzero(across)
        second = np.stack([us[here], vs[other] + share[len(rows):] * (vs[other + 1] - vs[other])], axis=1)
        return np.concatenate([first, second])
    low, high = np.zeros(len(where)), np.ones(len(where))
    rising = np.concatenate([sign[:, 1:][along], sign[1:, :][across]])
    for _ in range(30):
        middle = (low + high) / 2
        up = (patch.points(uv_of(middle)) @ normal - offset >= 0.0) == rising
        high, low = np.where(up, middle, high), np.where(up, low, middle)
    rows, columns = np.nonzero(along)
    other, here = np.nonzero(across)
    border = np.concatenate([(rows == 0) | (rows == len(vs) - 1), (here == 0) | (here == len(us) - 1)])
    return patch.points(uv_of((low + high) / 2)), label, border


def branches(patches, normal, offset, count, size):
    """(branches, closed ones, crossings n x 3) of a section of a model; ends of patches meet within 1e-6 of the
    size."""
    places, labels, borders, first = [], [], [], 0
    for patch in patches:
        found, label, border = components(patch, normal, offset, count)
        places.append(found)
        labels.append(label + first)
        borders.append(border)
        first += label.max() + 1 if len(label) else 0
    places, labels, borders = np.concatenate(places), np.concatenate(labels), np.concatenate(borders)
    if not len(places):
        return 0, 0, places
    ends, of = places[borders], labels[borders]
    far = np.linalg.norm(ends[:, None] - ends[None], axis=2) + 10 * size * np.eye(len(ends))
    mate, order = -np.ones(len(ends), int), np.argsort(far, axis=None)
    for k in order:
        i, j = divmod(int(k), len(ends))
        if far[i, j] > 1e-6 * size:
            break
        if mate[i] < 0 and mate[j] < 0:
            mate[i], mate[j] = j, i
    links = [(of[i], of[mate[i]]) for i in range(len(ends)) if mate[i] >= 0]
    graph = coo_matrix((np.ones(len(links)), tuple(np.array(links).T) if links else ([], [])), shape=(first,) * 2)
    count, joined = connected_components(graph, directed=False)
    open_ones = {joined[of[i]] for i in range(len(ends)) if mate[i] < 0}
    return count, count - len(open_ones), places


def from_polylines(places, lines):
    """Distance of each place from the nearest of polylines (lists of points, closed ones with the first again)."""
    best = np.full(len(places), np.inf)
    for line in lines:
        a, b = line[:-1], line[1:]
        chord = b - a
        square = np.maximum((chord ** 2).sum(axis=1), 1e-300)
        for k in range(0, len(places), 400):
            part = places[k:k + 400]
            way = part[:, None] - a[None]
            t = np.clip((way * chord).sum(axis=2) / square, 0.0, 1.0)
            best[k:k + 400] = np.minimum(best[k:k + 400], np.linalg.norm(way - t[..., None] * chord, axis=2).min(axis=1))
    return best

"""Compiled arithmetic of DBSCAN: which points are neighbours, in two ways, and what clusters they make."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Pairs = NDArray[np.int32]

# Windows and cells are larger by this share than reckoned, so that rounding loses no neighbour.
_SLACK = 1e-9


@njit(cache=True)
def within(points: Floats, most: float) -> bool:
    """Whether all coordinates (N, 2) are numbers that are not further from 0 than `most`."""
    inside = True
    for x, y in points:
        inside = inside and abs(x) <= most and abs(y) <= most
    return inside


@njit(cache=True)
def clusters(points: Floats, eps: float, min_points: int, centre: tuple[float, float], has_centre: bool) -> Ints:
    """As `dbscan` of points that are `within` reason; in one call, for a scan is clustered in little more."""
    if has_centre:
        rays, turned, far, ordered = bearings(points, centre[0], centre[1], eps)
        if ordered:
            return labels(len(points), scan_pairs(points, rays, turned, far, eps), min_points)
    return labels(len(points), grid_pairs(points, eps), min_points)


@njit(cache=True)
def bearings(points: Floats, centre_x: float, centre_y: float, nearest: float) -> tuple[Floats, Floats, Floats, bool]:
    """Rays (2, N) from the centre, their bearings (N,), unwound to rise, and lengths (N,); whether they are of one
    turn at most.

    A scan that turns to the right falls and is given mirrored. Points not further than `nearest` from the centre tell
    no window: then False, as for bearings that go to and fro.
    """
    n = len(points)
    rays, turned, far = np.empty((2, n)), np.empty(n), np.empty(n)
    for i in range(n):
        x, y = points[i, 0] - centre_x, points[i, 1] - centre_y
        rays[0, i], rays[1, i] = x, y
        far[i] = math.sqrt(x * x + y * y)
        turned[i] = math.atan2(y, x)
        if not far[i] > nearest * (1.0 + _SLACK):
            return rays, turned, far, False
    if _turns_back(turned):
        turned[:], rays[1] = -turned, -rays[1]
    return rays, turned, far, _unwind(turned)


@njit(cache=True)
def _turn(angle: float) -> float:
    """From one bearing to another, the short way; `angle` is less than a whole turn."""
    if angle > math.pi:
        return angle - math.tau
    return angle + math.tau if angle < -math.pi else angle


@njit(cache=True)
def _turns_back(turned: Floats) -> bool:
    """Whether bearings fall on the whole."""
    back = 0.0
    for i in range(1, len(turned)):
        back += _turn(turned[i] - turned[i - 1])
    return back < 0.0


@njit(cache=True)
def _unwind(turned: Floats) -> bool:
    """Make bearings of one turn rise; False if they do not go one way, or further than once around."""
    n = len(turned)
    last = turned[0] if n else 0.0
    for i in range(1, n):
        step = _turn(turned[i] - last)
        if step < 0.0:
            return False
        last, turned[i] = turned[i], turned[i - 1] + step
    return n == 0 or turned[n - 1] - turned[0] < math.tau


@njit(cache=True)
def scan_pairs(points: Floats, rays: Floats, turned: Floats, far: Floats, eps: float) -> Pairs:
    """Pairs (M, 2) of points within eps, for rays whose bearings rise.

    Seen from the centre, which is further away than eps, a neighbour of a point at distance r lies within
    asin(eps / r) of its bearing. After the last ray comes the first one again.
    """
    n, count, x, y = len(points), 0, points[:, 0].copy(), points[:, 1].copy()
    u, v = rays[0], rays[1]
    pairs, widest = np.empty((16 * n, 2), np.int32), (eps * (1.0 + _SLACK)) * far
    for i in range(n):
        pairs = _roomy(pairs, count, n)
        j = i + 1
        while j < n and u[i] * v[j] - v[i] * u[j] <= widest[j]:
            count += _pair(pairs, count, x, y, i, j, eps)
            j += 1
        if j == n:
            j, quarter = 0, turned[i] + 0.5 * math.pi - math.tau
            while j < i and turned[j] <= quarter and u[i] * v[j] - v[i] * u[j] <= widest[j]:
                count += _pair(pairs, count, x, y, i, j, eps)
                j += 1
    return pairs[:count]


@njit(cache=True)
def _roomy(pairs: Pairs, count: int, more: int) -> Pairs:
    """The same pairs with room for so many more."""
    if count + more <= len(pairs):
        return pairs
    grown = np.empty((2 * len(pairs) + more, 2), np.int32)
    grown[:count] = pairs[:count]
    return grown


@njit(cache=True)
def _pair(pairs: Pairs, count: int, x: Floats, y: Floats, i: int, j: int, eps: float) -> int:
    """Put (i, j) behind the first `count` pairs; 1 if they are within eps, else 0 and it will be written over."""
    dx, dy = x[i] - x[j], y[i] - y[j]
    pairs[count, 0], pairs[count, 1] = i, j
    return 1 if dx * dx + dy * dy <= eps * eps else 0


@njit(cache=True)
def grid_pairs(points: Floats, eps: float) -> Pairs:
    """Pairs (M, 2) of points within eps, in any order: a neighbour is in the same cell of a grid or in one beside it.

    Cells are numbered column by column, so the cell above comes next, and the three to the right are one run of
    numbers, which moves on with the point.
    """
    keys, column = _cells(points, eps)
    order = np.argsort(keys, kind="mergesort")
    key, x, y = keys[order], points[order, 0], points[order, 1]
    n, count, right = len(points), 0, 0
    pairs = np.empty((16 * n, 2), np.int32)
    for a in range(n):
        pairs = _roomy(pairs, count, n)
        b = a + 1
        while b < n and key[b] <= key[a] + 1:
            count += _pair(pairs, count, x, y, a, b, eps)
            b += 1
        while right < n and key[right] < key[a] + column - 1:
            right += 1
        b = right
        while b < n and key[b] <= key[a] + column + 1:
            count += _pair(pairs, count, x, y, a, b, eps)
            b += 1
    for k in range(count):
        pairs[k, 0], pairs[k, 1] = order[pairs[k, 0]], order[pairs[k, 1]]
    return pairs[:count]


@njit(cache=True)
def _cells(points: Floats, eps: float) -> tuple[Ints, int]:
    """Number (N,) of each point's cell, and by how much the cell to the right is numbered higher."""
    n, size = len(points), eps * (1.0 + _SLACK)
    keys = np.empty(n, np.int64)
    if n == 0:
        return keys, 3
    x0, y0 = points[:, 0].min(), points[:, 1].min()
    column = int((points[:, 1].max() - y0) / size) + 3
    for i in range(n):
        keys[i] = int((points[i, 0] - x0) / size) * column + int((points[i, 1] - y0) / size)
    return keys, column


@njit(cache=True)
def labels(n: int, pairs: Pairs, min_points: int) -> Ints:
    """Cluster (n,) of each point from all pairs of neighbours, -1 for noise.

    Clusters are numbered by their first core point. A border point between two clusters goes to the lower number.
    """
    near = np.ones(n, np.int32)
    for k in range(len(pairs)):
        near[pairs[k, 0]] += 1
        near[pairs[k, 1]] += 1
    core = near >= min_points
    found = _connected(core, pairs)
    for k in range(len(pairs)):
        i, j = pairs[k, 0], pairs[k, 1]
        if core[i] != core[j]:
            inner, outer = (i, j) if core[i] else (j, i)
            if found[outer] < 0 or found[inner] < found[outer]:
                found[outer] = found[inner]
    return found


@njit(cache=True)
def _connected(core: NDArray[np.bool_], pairs: Pairs) -> Ints:
    """Number (N,) of the group of core points that each core point belongs to, -1 for the others."""
    parent = np.arange(len(core))
    for k in range(len(pairs)):
        i, j = pairs[k, 0], pairs[k, 1]
        if core[i] and core[j] and parent[i] != parent[j]:
            a, b = _root(parent, i), _root(parent, j)
            parent[max(a, b)] = min(a, b)
    number, count = np.full(len(core), -1, np.int64), 0
    for i in range(len(core)):
        if core[i]:
            root = _root(parent, i)
            if root == i:
                number[i] = count
                count += 1
            number[i] = number[root]
    return number


@njit(cache=True)
def _root(parent: Ints, i: int) -> int:
    while parent[i] != i:
        parent[i] = parent[parent[i]]
        i = parent[i]
    return i

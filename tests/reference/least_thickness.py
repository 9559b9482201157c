#!/usr/bin/env python3
"""Least thickness of arches and of a hemisphere of plane-faced voussoirs, for tests/verification/references.yaml.

Independent of the programs: the standard library and, for the hemisphere, scipy (Debian: python3-scipy; run with /usr/bin/python3).

Arch: the profile is the middle line. Its right half is divided into joints normal to it, at equal lengths of the whole line. With
the horizontal thrust H and its moment M = H z about the origin at the crown, the force through the joint from a (inner) to b
(outer) crosses the line z H - M - X + x W = 0; W is the weight between crown and joint, X its moment about the z axis. It passes
between a and b if

    z_a H - X + x_a W  <=  M  <=  z_b H - X + x_b W.

A pair (H, M) exists if the convex function  max over joints of the left side - min over joints of the right side  is nowhere
positive for all H. Friction is unlimited.

Hemisphere of radius 1, closed at the crown: one lune of joints aligned on meridians, divided into rings by cones. Each ring may push
against the neighbouring lunes, with a force whose outward part Q >= 0 acts anywhere in their contact, but not pull. The thrust through the
joint below ring k is the sum of Q over the rings above, so that the same bounds are a linear programme in Q and its moments P.

Usage: least_thickness.py [arch | hemisphere]
"""

import math
import sys


# --- profiles: the right half of the middle line from the crown (parameter 0) downwards ------------------------------------

def equal_lengths(curve, end, num):
    """Parameters of num + 1 points at equal lengths of a curve."""
    steps = 200000
    lengths, before = [0.0], curve(0.0)
    for i in range(1, steps + 1):
        here = curve(end * i / steps)
        lengths.append(lengths[-1] + math.dist(before, here))
        before = here
    places, i = [], 0
    for k in range(num + 1):
        target = lengths[-1] * k / num
        while i + 1 < steps and lengths[i + 1] < target:
            i += 1
        places.append(end * (i + (target - lengths[i]) / (lengths[i + 1] - lengths[i])) / steps)
    return places


def circle(radius, height=0.0, offset=0.0):
    """By the angle from the vertical; the centre lies at x = -offset, z = height."""
    start = math.asin(offset / radius)
    return (lambda s: (radius * math.sin(start + s) - offset, radius * math.cos(start + s) + height),
            lambda s: (math.sin(start + s), math.cos(start + s)))


def profile(name, span, rise):
    """(curve, outward normal, parameter of the springing)."""
    a = span / 2
    if name == "semicircle":
        return *circle(a), math.pi / 2
    if name == "segmental":
        R = (a * a + rise * rise) / (2 * rise)
        return *circle(R, rise - R), math.asin(a / R)
    if name == "pointed":  # rise means radius over span
        R = rise * span
        return *circle(R, 0.0, R - a), math.pi / 2 - math.asin((R - a) / R)
    if name == "ellipse":
        def normal(s):
            n = (math.sin(s) / a, math.cos(s) / rise)
            return n[0] / math.hypot(*n), n[1] / math.hypot(*n)
        return lambda s: (a * math.sin(s), rise * math.cos(s)), normal, math.pi / 2
    if name == "parabola":
        def normal(s):
            n = (2 * rise * s / a ** 2, 1.0)
            return n[0] / math.hypot(*n), n[1] / math.hypot(*n)
        return lambda s: (s, rise * (1 - (s / a) ** 2)), normal, a
    if name == "catenary":
        low, high = 1e-3 * a, 1e3 * a
        for _ in range(200):
            c = 0.5 * (low + high)
            low, high = (c, high) if c * (math.cosh(min(a / c, 700.0)) - 1) > rise else (low, c)
        return (lambda s: (s, rise - c * (math.cosh(s / c) - 1)),
                lambda s: (math.tanh(s / c), 1 / math.cosh(s / c)), a)
    raise SystemExit("no profile " + name)


# --- arch ---------------------------------------------------------------------------------------------------------------

def polygon(points):
    """Area and first moment about x = 0."""
    area = moment = 0.0
    for (x, z), (p, q) in zip(points, points[1:] + points[:1]):
        cross = x * q - p * z
        area += cross / 2
        moment += cross * (x + p) / 6
    return area, moment


def stands(joints, normals, thickness, crown_is_joint, kink=None):
    """Whether a line of thrust lies in the arch; joints from the crown (or the axis of its keystone) to the springing. At a kink the
    crown joint is vertical and ends on the parallels of the middle line: `kink` gives their height at a distance from it."""
    half = thickness / 2
    inner = [(x - half * n[0], z - half * n[1]) for (x, z), n in zip(joints, normals)]
    outer = [(x + half * n[0], z + half * n[1]) for (x, z), n in zip(joints, normals)]
    if kink:
        inner[0], outer[0] = (0.0, kink(-half)), (0.0, kink(half))
    lower, upper = [], []  # (slope, constant) of bounds on M
    if crown_is_joint:
        lower.append((inner[0][1], 0.0))
        upper.append((outer[0][1], 0.0))
    W = X = 0.0
    for k in range(1, len(joints)):
        if k == 1 and not crown_is_joint:  # the right half of the keystone, whose faces join the joints on both sides
            quad = [(0.0, inner[1][1]), inner[1], outer[1], (0.0, outer[1][1])]
        else:
            quad = [inner[k - 1], inner[k], outer[k], outer[k - 1]]
        area, moment = polygon(quad)
        W, X = W + abs(area), X + abs(moment)
        lower.append((inner[k][1], inner[k][0] * W - X))
        upper.append((outer[k][1], outer[k][0] * W - X))

    def gap(H):
        return max(a * H + c for a, c in lower) - min(a * H + c for a, c in upper)

    low, high = 0.0, 100.0 * W
    for _ in range(200):
        third = (high - low) / 3
        if gap(low + third) < gap(high - third):
            high -= third
        else:
            low += third
    return gap(low) <= 0.0


def least_thickness(name, span, rise, voussoirs):
    curve, normal, end = profile(name, span, rise)
    if voussoirs % 2 == 0:
        places = equal_lengths(curve, end, voussoirs // 2)
    else:  # the keystone is halved by the axis
        halves = equal_lengths(curve, end, voussoirs)
        places = [0.0] + halves[1::2]
    joints = [curve(s) for s in places]
    normals = [normal(s) for s in places]
    offset = rise * span - span / 2
    kink = (lambda h: math.sqrt((rise * span + h) ** 2 - offset ** 2)) if name == "pointed" else None
    low, high = 0.0, span
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if stands(joints, normals, middle, voussoirs % 2 == 0, kink) else (middle, high)
    return high


# --- hemisphere ---------------------------------------------------------------------------------------------------------

def hemisphere_stands(thickness, rings):
    """Lengths over the radius, weights over that of the lune per unit of its width at r = 1."""
    import numpy as np
    from scipy.optimize import linprog

    inner, outer = 1 - thickness / 2, 1 + thickness / 2
    rows, right = [], []
    W = X = 0.0  # weight above the joint, and its moment about the axis
    for k in range(rings):
        (s, c), (t, d) = ((math.sin(a), math.cos(a)) for a in (math.pi / 2 * k / rings, math.pi / 2 * (k + 1) / rings))
        quad = [(inner * s, inner * c), (inner * t, inner * d), (outer * t, outer * d), (outer * s, outer * c)]
        weight = moment = 0.0  # a lune is as wide as its distance from the axis
        for (x, z), (p, q) in zip(quad, quad[1:] + quad[:1]):
            cross = x * q - p * z
            weight += cross * (x + p) / 6
            moment += cross * (x * x + x * p + p * p) / 12
        W, X = W + abs(weight), X + abs(moment)

        def row(entries, limit):
            rows.append(np.zeros(2 * rings))
            for i, value in entries:
                rows[-1][i] = value
            right.append(limit)

        # Q at a height z of the section: P = Q z between its least and its greatest.
        row([(2 * k, min(z for _, z in quad)), (2 * k + 1, -1)], 0.0)
        row([(2 * k, -max(z for _, z in quad)), (2 * k + 1, 1)], 0.0)
        for sign, radius in ((1, inner), (-1, outer)):  # the joint below the ring, as in an arch
            row([(2 * i, sign * radius * d) for i in range(k + 1)] + [(2 * i + 1, -sign) for i in range(k + 1)],
                sign * (X - radius * t * W))
    limits = [(0, None), (None, None)] * rings
    return linprog(np.zeros(2 * rings), A_ub=np.array(rows), b_ub=np.array(right), bounds=limits, method="highs").status == 0


def least_hemisphere(rings):
    low, high = 0.02, 0.08
    for _ in range(20):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if hemisphere_stands(middle, rings) else (middle, high)
    return high


def main():
    if sys.argv[1:] == ["hemisphere"]:
        for rings in (20, 40, 80, 160):
            print(f"hemisphere, {rings} rings: {least_hemisphere(rings):.6f} of the radius")
        return
    for voussoirs in (50, 51, 100, 1000, 4000):
        print(f"semicircle, {voussoirs} voussoirs: {least_thickness('semicircle', 2.0, 1.0, voussoirs):.6f} of the radius")
    for name, rise in (("semicircle", 6), ("segmental", 3), ("pointed", 0.8), ("ellipse", 4), ("parabola", 4), ("catenary", 6)):
        for voussoirs in (20, 32) if name == "pointed" else (20, 31, 32):  # a kink is a joint
            print(f"{name}, span 12, {'radius ratio' if name == 'pointed' else 'rise'} {rise}, {voussoirs} voussoirs: "
                  f"{least_thickness(name, 12.0, rise, voussoirs):.6f}")


main()

#!/usr/bin/env python3
"""Spread at which a semicircular arch of rigid voussoirs collapses between supports that move apart, for tests/solver/analysis/causes_test.cpp.

Independent of the programs, standard library only. No tension, no sliding, symmetric. The half arch x > 0 has the joints 0 (crown) to
n (springing). While the supports spread it hinges at the outer edge of the crown and at the inner edge of one joint k: voussoirs
beyond k move with the support, those between turn about the hinge until the crown is on the axis again. The thrust follows from
moments about the hinge in the moved geometry. The state is an equilibrium if the resultant crosses every joint between its edges;
the arch collapses where no joint k gives such a state.

Usage: spreading_arch.py [voussoirs of the half arch] [thickness over radius]
"""

import cmath
import math
import sys


def joint(angle, t):
    """Inner and outer edge, as x + i z."""
    d = complex(math.sin(angle), math.cos(angle))
    return (1 - t / 2) * d, (1 + t / 2) * d


def voussoir(a, b, t):
    """Area and centroid of the quadrilateral between two joints."""
    p = [*joint(a, t), *reversed(joint(b, t))]
    area, moment = 0.0, 0.0
    for u, v in zip(p, p[1:] + p[:1]):
        cross = (u.conjugate() * v).imag
        area += cross / 2
        moment += (u + v) * cross / 6
    return abs(area), moment / area


def state(n, t, k, s):
    """Positions of the resultant in the joints, 0 at the inner and 1 at the outer edge, the thrust over the weight of the half arch, and the
    rotation, rad; None if the voussoirs are too short for the spread."""
    joints = [joint(math.pi / 2 * j / n, t) for j in range(n + 1)]
    blocks = [voussoir(math.pi / 2 * j / n, math.pi / 2 * (j + 1) / n, t) for j in range(n)]
    hinge, crown = joints[k][0], joints[0][1]
    arm, x = crown - hinge, -(hinge.real + s)
    if abs(x) >= abs(arm):
        return None
    turned = complex(x, math.sqrt(abs(arm) ** 2 - x * x))
    turn = turned / arm

    def place(p, with_support):
        return p + s if with_support else hinge + s + turn * (p - hinge)

    centres = [(a, place(g, i >= k)) for i, (a, g) in enumerate(blocks)]
    weight = sum(a for a, _ in blocks)
    thrust = sum(a * (hinge.real + s - g.real) for a, g in centres[:k]) / turned.imag
    start = place(crown, False)
    positions = []
    for j, edges in enumerate(joints):
        load = sum(a for a, _ in centres[:j])
        first = sum(a * g.real for a, g in centres[:j])
        # moment of thrust and loads about a point of the joint
        f = [thrust * (start.imag - p.imag) - (load * p.real - first) for p in (place(e, j > k) for e in edges)]
        positions.append(f[0] / (f[0] - f[1]))
    return positions, thrust / weight, abs(cmath.phase(turn))


def stands(n, t, k, s):
    result = state(n, t, k, s)
    return result is not None and all(-1e-12 <= q <= 1 + 1e-12 for q in result[0])


if __name__ == "__main__":
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    t = float(sys.argv[2]) if len(sys.argv) > 2 else 0.15
    k = next(k for k in range(1, n + 1) if stands(n, t, k, 0.0))
    s, step = 0.0, 1e-3
    while step > 1e-13:
        while stands(n, t, k, s + step):
            s += step
        step /= 2
    print(f"hinge at joint {k}, collapse at a spread of each support of {s:.9f} radii, rotation {state(n, t, k, s)[2]:.3f} rad")
    for share in (0, 0.25, 0.5, 0.75, 1):
        print(f"thrust over the weight of the half arch at a spread of {share * s:.9f}: {state(n, t, k, share * s)[1]:.9f}")

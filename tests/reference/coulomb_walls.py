#!/usr/bin/env python3
"""Collapse loads of walls 1 and 2 of Ferris and Tin-Loi (2001) under Coulomb's law, without the solvers of this project.

  coulomb_walls.py COURSES LOAD ...      6 or 10 courses; horizontal loads over the weight, each started from the last

Rigid blocks make one step from rest: M v = h (D g + w), where g lies in the friction cone of each contact point, complementary to its normal
velocity, and slip opposes friction without dilatancy. Nonlinear Gauss-Seidel sweeps solve it in the plane. Speeds fall linearly with the
load; where they reach zero, forces in equilibrium and a mechanism belong to each other, and the wall can collapse. That load is extrapolated
from the last two that move. It depends on the start, because Coulomb's law does not fix the forces.

  coulomb_walls.py 6 0.65 0.642 0.641 0.6405     0.6396, seconds
  coulomb_walls.py 10 0.59 0.563 0.561           0.5600, a quarter of an hour
"""

import sys

MU, LENGTH, HEIGHT = 0.65, 0.4, 0.175


class Block:
    def __init__(self, low, high, course):
        width = high - low
        self.low, self.high, self.course = low, high, course
        self.centre = (0.5 * (low + high), (course + 0.5) * HEIGHT)
        mass = width * HEIGHT
        self.inverse = (1 / mass, 1 / mass, 12 / (mass * (width**2 + HEIGHT**2)))
        self.v = [0.0, 0.0, 0.0]  # over g h


def wall(courses):
    blocks = []
    for course in range(courses):
        shift = 0.0 if course % 2 else 0.5
        for j in range(5 if course % 2 else 6):
            blocks.append(Block(max(0.0, (j - shift) * LENGTH), min(5 * LENGTH, (j + 1 - shift) * LENGTH), course))
    return blocks


class Contact:
    """A point between block a (None: ground) and b; n from a to b, t across."""

    def __init__(self, a, b, bed, x, z):
        n, t = ((0.0, 1.0), (1.0, 0.0)) if bed else ((1.0, 0.0), (0.0, 1.0))
        self.rows = []  # block, row of n, row of t, inverse masses
        for block, sign in ((a, -1.0), (b, 1.0)):
            if block is None:
                continue
            r = (x - block.centre[0], z - block.centre[1])
            self.rows.append((block.v, *[(sign * d[0], sign * d[1], sign * (r[0] * d[1] - r[1] * d[0])) for d in (n, t)], block.inverse))
        product = lambda i, j: sum(sum(p * q * w for p, q, w in zip(row[i], row[j], row[3])) for row in self.rows)
        self.nn, self.nt, self.tt = product(1, 1), product(1, 2), product(2, 2)
        self.g = (0.0, 0.0)

    def velocity(self):
        return [sum(sum(d * v for d, v in zip(row[i], row[0])) for row in self.rows) for i in (1, 2)]

    def add(self, dn, dt):
        for v, n, t, inverse in self.rows:
            for k in range(3):
                v[k] += inverse[k] * (n[k] * dn + t[k] * dt)

    def solve(self):
        """The impulse that obeys the law if all others stay. Returns its change."""
        (un, ut), (gn, gt) = self.velocity(), self.g
        qn, qt = un - self.nn * gn - self.nt * gt, ut - self.nt * gn - self.tt * gt
        new = (0.0, 0.0)
        if qn < 0.0:
            det = self.nn * self.tt - self.nt**2
            new = ((qt * self.nt - qn * self.tt) / det, (qn * self.nt - qt * self.nn) / det)
            if not abs(new[1]) <= MU * new[0]:
                new = self.g
                for side in (-1.0, 1.0):  # slides against the friction
                    g = -qn / (self.nn + side * MU * self.nt)
                    if g >= 0.0 and side * (qt + (self.nt + side * MU * self.tt) * g) <= 1e-15:
                        new = (g, side * MU * g)
        change = (new[0] - gn, new[1] - gt)
        self.g = new
        self.add(*change)
        return max(abs(change[0]), abs(change[1]))


def contacts_of(blocks):
    contacts = []
    for a in blocks:
        if a.course == 0:
            contacts += [Contact(None, a, True, x, 0.0) for x in (a.low, a.high)]
        for b in blocks:
            low, high, z = max(a.low, b.low), min(a.high, b.high), b.course * HEIGHT
            if b.course == a.course + 1 and high - low > 1e-9:
                contacts += [Contact(a, b, True, x, z) for x in (low, high)]
            if b.course == a.course and abs(a.high - b.low) < 1e-9:
                contacts += [Contact(a, b, False, a.high, z), Contact(a, b, False, a.high, z + HEIGHT)]
    return contacts


def largest_speed(blocks, contacts, load):
    for block in blocks:
        block.v[:] = [load, -1.0, 0.0]
    for contact in contacts:
        contact.add(*contact.g)
    for sweep in range(1000000):
        if max(contact.solve() for contact in (contacts if sweep % 2 == 0 else reversed(contacts))) < 1e-10:
            break
    else:
        sys.exit(f"load {load}: not converged")
    return max(abs(v) for block in blocks for v in block.v[:2])


blocks = wall(int(sys.argv[1]))
contacts = contacts_of(blocks)
points = []
for load in map(float, sys.argv[2:]):
    points.append((load, largest_speed(blocks, contacts, load)))
    print(f"load {load:g}: largest speed over g h {points[-1][1]:.3e}", flush=True)
(x0, v0), (x1, v1) = points[-2:]
print(f"collapses from {x1 - v1 * (x1 - x0) / (v1 - v0):.4f} on")

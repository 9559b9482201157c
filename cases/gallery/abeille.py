#!/usr/bin/env python3
"""Writes abeille.obj: the flat vault that Joseph Abeille patented in 1699, n x n stones in a fixed frame.

The stones are squares of `side` on the soffit. Two opposite sides of each lean outwards with the height and the other two inwards, by
turns, as on a chess-board, so that each stone rests on two neighbours and carries the other two. The sides of neighbours lie in one
plane. Pyramids between four stones stay open on the back, as in Abeille's drawing (Frezier, La theorie et la pratique de la coupe des
pierres, volume 2, 1738, plate 31).

Usage: abeille.py > abeille.obj
"""
SIDE, HEIGHT, LEAN = 0.5, 0.25, 0.35  # m, m, m outwards or inwards per m of height
N = 9  # stones in a row; odd, so that the frame is symmetric
FRAME = 0.5  # m, its width


def box(corners_below, corners_above):
    """Faces of a hexahedron whose corners are given counter-clockwise from above."""
    return corners_below + corners_above, [(3, 2, 1, 0), (4, 5, 6, 7)] + [(i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i) for i in range(4)]


def rectangle(x0, x1, y0, y1, z):
    return [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]


def stone(i, j):
    dx = LEAN * HEIGHT * (1 if (i + j) % 2 == 0 else -1)
    half = N / 2
    x0, y0 = (i - half) * SIDE, (j - half) * SIDE
    return box(rectangle(x0, x0 + SIDE, y0, y0 + SIDE, 0.0), rectangle(x0 - dx, x0 + SIDE + dx, y0 + dx, y0 + SIDE - dx, HEIGHT))


def bearing(i, j, x, y):
    """The piece of the frame beside a stone at the edge, in the direction (x, y). Its face lies in the plane of the stone's side."""
    dx = LEAN * HEIGHT * (1 if (i + j) % 2 == 0 else -1)
    out = dx if x else -dx  # of the stone's side, with the height
    half = N / 2
    x0, y0 = (i - half) * SIDE, (j - half) * SIDE
    if x:
        a = x0 + SIDE if x > 0 else x0 - FRAME
        below = rectangle(a, a + FRAME, y0, y0 + SIDE, 0.0)
        a0, a1 = (a + out, a + FRAME) if x > 0 else (a, a + FRAME - out)
        above = rectangle(a0, a1, y0, y0 + SIDE, HEIGHT)
    else:
        a = y0 + SIDE if y > 0 else y0 - FRAME
        below = rectangle(x0, x0 + SIDE, a, a + FRAME, 0.0)
        a0, a1 = (a + out, a + FRAME) if y > 0 else (a, a + FRAME - out)
        above = rectangle(x0, x0 + SIDE, a0, a1, HEIGHT)
    return box(below, above)


def main():
    blocks = [(f"stone_{i}_{j}", stone(i, j)) for i in range(N) for j in range(N)]
    for k in range(N):
        for name, i, j, x, y in (("west", 0, k, -1, 0), ("east", N - 1, k, 1, 0), ("south", k, 0, 0, -1), ("north", k, N - 1, 0, 1)):
            blocks.append((f"frame_{name}_{k}", bearing(i, j, x, y)))
    first = 1
    for name, (points, faces) in blocks:
        print("o", name)
        for p in points:
            print("v %.9g %.9g %.9g" % p)
        for face in faces:
            print("f", *(first + v for v in face))
        first += len(points)


if __name__ == "__main__":
    main()

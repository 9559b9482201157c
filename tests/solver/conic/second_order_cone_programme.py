"""Solves a second-order cone programme with cvxopt: an independent check of solver/conic.

Reads from standard input: nb nc, then w (6 nb), then c (3 nc), then mu (nc), then the rows of D (6 nb lines of 3 nc
numbers). Prints the least c . gamma subject to D gamma + w = 0 and |gamma_t| <= mu gamma_n.
"""

import sys

import numpy as np
from cvxopt import matrix, solvers


def main():
    numbers = np.array(sys.stdin.read().split(), dtype=float)
    nb, nc = int(numbers[0]), int(numbers[1])
    w, c, mu, d = np.split(numbers[2:], np.cumsum([6 * nb, 3 * nc, nc]))
    d = d.reshape(6 * nb, 3 * nc)
    # cvxopt needs independent equations: the left singular vectors span them.
    u, s, vt = np.linalg.svd(d, full_matrices=False)
    rank = int((s > 1e-10 * s[0]).sum())
    scale = np.abs(w).max()
    g = np.zeros((3 * nc, 3 * nc))
    for i in range(nc):
        g[3 * i, 3 * i] = -mu[i]
        g[3 * i + 1, 3 * i + 1] = g[3 * i + 2, 3 * i + 2] = -1.0
    solvers.options.update(show_progress=False, abstol=1e-8, reltol=1e-8, feastol=1e-8)
    found = solvers.conelp(matrix(c), matrix(g), matrix(np.zeros(3 * nc)), {"l": 0, "q": [3] * nc, "s": []},
                           matrix(vt[:rank]), matrix(-(u[:, :rank].T @ w) / s[:rank] / scale))
    print(found["status"], f"{found['primal objective'] * scale:.15g}" if found["status"] == "optimal" else "")


main()

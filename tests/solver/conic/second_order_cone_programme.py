"""Solves a second-order cone programme with cvxopt: an independent check of solver/conic.

Reads from standard input: nb nc, then w (6 nb), then c (3 nc), then mu (nc), then tension, cohesion and compression of
each contact (3 nc; inf: unlimited), then the rows of D (6 nb lines of 3 nc numbers). Prints the least c . gamma subject
to D gamma + w = 0, |gamma_t| <= cohesion + mu gamma_n and -tension <= gamma_n <= compression.
"""

import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # before numpy is imported; threads wait for each other on a busy machine

import numpy as np
from cvxopt import matrix, solvers


def main():
    numbers = np.array(sys.stdin.read().split(), dtype=float)
    nb, nc = int(numbers[0]), int(numbers[1])
    w, c, mu, strength, d = np.split(numbers[2:], np.cumsum([6 * nb, 3 * nc, nc, 3 * nc]))
    tension, cohesion, compression = strength.reshape(nc, 3).T
    d = d.reshape(6 * nb, 3 * nc)
#cvxopt needs independent equations : the left singular vectors span them.
    u, s, vt = np.linalg.svd(d, full_matrices=False)
    rank = int((s > 1e-10 * s[0]).sum())
    scale = np.abs(w).max()
    crushing = np.isfinite(compression)
    normal = np.eye(3 * nc)[::3]
    g = np.zeros((3 * nc, 3 * nc))
    h = np.zeros(3 * nc)
    h[::3] = cohesion / scale
    for i in range(nc):
        g[3 * i, 3 * i] = -mu[i]
        g[3 * i + 1, 3 * i + 1] = g[3 * i + 2, 3 * i + 2] = -1.0
    solvers.options.update(show_progress=False, abstol=1e-8, reltol=1e-8, feastol=1e-8)
    limits = np.vstack([-normal, normal[crushing]])
    right = np.concatenate([tension, compression[crushing]]) / scale
    found = solvers.conelp(matrix(c), matrix(np.vstack([limits, g])), matrix(np.concatenate([right, h])),
                           {"l": len(right), "q": [3] * nc, "s": []},
                           matrix(vt[:rank]), matrix(-(u[:, :rank].T @ w) / s[:rank] / scale))
    print(found["status"], f"{found['primal objective'] * scale:.15g}" if found["status"] == "optimal" else "")


main()

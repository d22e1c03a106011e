"""The same fit in SciPy: 500 poses, more than 60 unknowns, scipy.optimize.least_squares.

    pip install numpy scipy pyyaml
    python benches/peer/least_squares.py

The peer of the bench `identification/identify_500_poses_60_unknowns`. It has an easier life: an ideal parallelogram, load
torques taken once at the nominal arm, no search for gross errors, no estimate of the noise, all poses in one array operation.
"""

import csv
import pathlib
import time

import numpy as np
import yaml
from scipy.optimize import least_squares

FOLDER = pathlib.Path(__file__).parents[2] / "calibration/recordings/hh800-class"
ROBOT = yaml.safe_load((FOLDER / "robot.yaml").read_text())
with open(FOLDER / "recording.csv", newline="") as file:
    ROWS = list(csv.DictReader(file))
Q = np.radians([[float(row[f"q{j}_deg"]) for j in range(1, 7)] for row in ROWS])
SENSE = np.array([[float(row[f"dir{j}"]) for j in range(1, 7)] for row in ROWS])
MEASURED = np.array([[float(row[f"{axis}_mm"]) for axis in "xyz"] for row in ROWS]) / 1e3
JOINTS = [[np.radians(j["theta_deg"]), j["d_mm"] / 1e3, j["a_mm"] / 1e3, np.radians(j["alpha_deg"])] for j in ROBOT["joints"]]
MASS = np.array([link["mass_kg"] for link in ROBOT["links"]])
COM = np.array([link["com_mm"] for link in ROBOT["links"]]) / 1e3
LOAD_KG, LOAD_COM = ROBOT["payload"]["mass_kg"], np.array(ROBOT["payload"]["com_mm"]) / 1e3
TOOL = np.array(ROBOT["tool"]["xyz_mm"]) / 1e3
G = np.array(ROBOT["gravity_m_s2"])


def axis_turn(axis, angle):
    """Rotation matrices about x, y or z, one for each angle: n x 3 x 3."""
    angle = np.atleast_1d(angle)
    turn = np.zeros((angle.size, 3, 3))
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    turn[:, axis, axis] = 1
    turn[:, i, i] = turn[:, j, j] = np.cos(angle)
    turn[:, j, i] = np.sin(angle)
    turn[:, i, j] = -np.sin(angle)
    return turn


def serial(q):
    """Angles of the open chain: the parallelogram keeps the forearm's angle when joint 2 moves."""
    angles = q.copy()
    angles[:, 2] -= q[:, 1]
    return angles


def chain(q, rows):
    """base_R_link and base_p_link after every row: rows is 6 x 5 of errors in theta, d, a, alpha, beta."""
    turn, place = np.tile(np.eye(3), (len(q), 1, 1)), np.zeros((len(q), 3))
    angles = serial(q)
    for joint, (theta, d, a, alpha) in enumerate(JOINTS):
        e = rows[joint]
        turn = turn @ axis_turn(2, angles[:, joint] + theta + e[0])
        place = place + turn @ np.array([a + e[2], 0, d + e[1]])
        turn = turn @ axis_turn(0, alpha + e[3]) @ axis_turn(1, e[4])
        yield turn, place


def torques():
    """Load torques at the actuators, by differences of the potential energy of the nominal arm."""

    def energy(q):
        frames = list(chain(q, np.zeros((6, 5))))
        whole = sum(m * ((place + turn @ com) @ -G) for (turn, place), m, com in zip(frames, MASS, COM))
        turn, place = frames[-1]
        return whole + LOAD_KG * ((place + turn @ LOAD_COM) @ -G)

    step = 1e-6
    return np.stack([(energy(Q - step * e) - energy(Q + step * e)) / (2 * step) for e in np.eye(6)], axis=1)


TORQUE = torques()
# Hayati's beta stands for d where the axis is parallel to the next: row 2.
ROW_ERRORS = [(joint, k) for joint in range(6) for k in range(5) if k != (1 if joint == 1 else 4)]
GEOMETRY = len(ROW_ERRORS)
# Base 6, tool 3, then for each joint compliance, play, gear ratio, waves twice and three times a turn.
UNKNOWNS = GEOMETRY + 9 + 6 * 7
PRIOR = np.concatenate([
    [[5e-3, 1e-3, 1e-3, 1e-3, 1e-3][k] for _, k in ROW_ERRORS], [1e-2] * 9, [1e-6, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3] * 6,
])


def positions(x):
    rows = np.zeros((6, 5))
    for value, (joint, k) in zip(x, ROW_ERRORS):
        rows[joint, k] = value
    base, tool, joint = x[GEOMETRY:GEOMETRY + 6], x[GEOMETRY + 6:GEOMETRY + 9], x[GEOMETRY + 9:].reshape(6, 7)
    q = Q + TORQUE * joint[:, 0] + SENSE * joint[:, 1] + Q * joint[:, 2]
    for order, first in ((2, 3), (3, 5)):
        q = q + np.sin(order * Q) * joint[:, first] + np.cos(order * Q) * joint[:, first + 1]
    *_, (turn, place) = chain(q, rows)
    point = place + turn @ (TOOL + tool)
    return point @ (axis_turn(2, base[5]) @ axis_turn(1, base[4]) @ axis_turn(0, base[3]))[0].T + base[:3]


def residuals(scaled):
    left = (positions(scaled * PRIOR) - MEASURED).ravel() / 1e-4
    return np.concatenate([left, scaled])


def main():
    print(f"{len(Q)} poses, {UNKNOWNS} unknowns")
    for method, jac in (("trf", "2-point"), ("lm", "2-point"), ("trf", "3-point")):
        taken = []
        for _ in range(5):
            start = time.perf_counter()
            fit = least_squares(residuals, np.zeros(UNKNOWNS), jac=jac, method=method, xtol=1e-10, ftol=1e-10, gtol=1e-10)
            taken.append(time.perf_counter() - start)
        left = np.linalg.norm(positions(fit.x * PRIOR) - MEASURED, axis=1)
        print(f"{method} {jac}: {np.median(taken):.2f} s, {fit.nfev} evaluations, mean of what is left {1e3 * left.mean():.4f} mm")


if __name__ == "__main__":
    main()

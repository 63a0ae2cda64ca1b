"""Calibrates a two-link arm by touching a workpiece: Gauss-Newton on a residual of one's own.

    python gauss_newton.py
    python gauss_newton.py --touches 40 --noise 0.001

The tip of the arm touches the border of a known rotated box, and the encoders give two angles for every touch. Six numbers are
unknown: the lengths of both links, the place of the base and the offsets of both encoders. The residual is the signed
distance of the tip from the box, a verb of the library inside a plain function, recorded once. Its Jacobian needs no formula.
"""

import argparse
import pathlib
import tempfile

import numpy as np

import geograd

NAMES = ("upper link", "lower link", "base x", "base y", "shoulder offset", "elbow offset")


@geograd.function
def tip(arm: 6, angles: 2):
    """The tip of the arm in metres."""
    upper, lower, x, y, shoulder, elbow = arm
    first = angles[0] + shoulder
    second = first + angles[1] + elbow
    return geograd.Vec2(
        x + upper * np.cos(first) + lower * np.cos(second), y + upper * np.sin(first) + lower * np.sin(second)
    )


@geograd.function
def miss(arm: 6, angles: 2, workpiece: geograd.Obb2):
    """The distance of the tip from the border of the workpiece in metres, negative inside."""
    return geograd.signed_distance(tip(arm, angles), workpiece)


def touches(rng, arm, workpiece, count, noise):
    """The angles that encoders report for touches on all four sides."""
    side, along = np.arange(count) % 4, rng.uniform(-0.45, 0.45, count)
    x = np.where(side < 2, along, np.where(side == 2, -0.5, 0.5)) * workpiece[2]
    y = np.where(side >= 2, along, np.where(side == 0, -0.5, 0.5)) * workpiece[3]
    cos, sin = np.cos(workpiece[4]), np.sin(workpiece[4])
    upper, lower, base_x, base_y, shoulder, elbow = arm
    dx, dy = workpiece[0] + cos * x - sin * y - base_x, workpiece[1] + sin * x + cos * y - base_y
    # Either side for the elbow.
    bend = np.arccos((dx**2 + dy**2 - upper**2 - lower**2) / (2 * upper * lower))
    bend *= np.where(np.arange(count) // 4 % 2, 1, -1)
    first = np.arctan2(dy, dx) - np.arctan2(lower * np.sin(bend), upper + lower * np.cos(bend))
    exact = np.stack([first - shoulder, bend - elbow], axis=-1)
    return exact + rng.normal(0, noise, exact.shape)


def solve(arm, angles, workpiece, steps):
    """The arm with the least sum of squared misses, its normal matrix, and the misses of every step (root mean square)."""
    history = []
    for _ in range(steps):
        residual = miss(arm, angles, workpiece)
        jacobian = miss.jacobian(arm, angles, workpiece)[:, :6]  # by the numbers of the arm, which come first
        history.append(np.sqrt(np.mean(residual**2)))
        normal = jacobian.T @ jacobian
        step = np.linalg.solve(normal, -jacobian.T @ residual)
        arm = arm + step
        if np.abs(step).max() < 1e-12:
            break
    return arm, normal, history


def draw(path, angles, workpiece, before, after, history):
    """The touches as the arm places them before and after, and the misses of every step."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.patches import Polygon

    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
    corners = geograd.corners(geograd.Obb2(workpiece)).array.reshape(4, 2)
    left.add_patch(Polygon(corners, fill=False, linewidth=2, edgecolor="0.4", label="workpiece"))
    for arm, label, color in [(before, "nominal arm", "tab:orange"), (after, "calibrated arm", "tab:blue")]:
        left.plot(*tip(arm, angles).array.T, ".", color=color, label=f"touches by the {label}")
    left.set_aspect("equal")
    left.set(xlabel="x (m)", ylabel="y (m)")
    left.margins(0.1)
    left.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), frameon=False, fontsize=8)
    right.semilogy(history, "o-")
    right.set(xlabel="step of Gauss-Newton", ylabel="root mean square miss (m)")
    right.xaxis.get_major_locator().set_params(integer=True)
    figure.savefig(path, dpi=110, bbox_inches="tight")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--touches", type=int, default=60, help="how many touches (default 60)")
    parser.add_argument("--noise", type=float, default=2e-4, help="deviation of the encoders (rad, default 0.0002)")
    parser.add_argument("--steps", type=int, default=30, help="steps of Gauss-Newton at most (default 30)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, help="a folder for the picture (default: a temporary one)")
    options = parser.parse_args(arguments)
    if options.touches < 12:
        parser.error("--touches: six unknowns need at least 12")
    out = options.out or pathlib.Path(tempfile.mkdtemp(prefix="gauss_newton_"))
    out.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(options.seed)

    truth = np.array([0.500, 0.400, 0.020, -0.010, 0.030, -0.020])
    nominal = np.array([0.520, 0.385, 0.000, 0.000, 0.000, 0.000])
    workpiece = np.array([0.45, 0.35, 0.30, 0.20, 0.4])
    angles = touches(rng, truth, workpiece, options.touches, options.noise)

    # Differences of the residual are an independent Jacobian.
    jacobian = miss.jacobian(nominal, angles, workpiece)[:, :6]
    beside = lambda h: (miss(nominal + h, angles, workpiece) - miss(nominal - h, angles, workpiece)) / 2e-6
    differences = np.stack([beside(h) for h in 1e-6 * np.eye(6)], axis=-1)
    print(f"Jacobian against differences: {np.abs(jacobian - differences).max():.1e} at most")

    arm, normal, history = solve(nominal, angles, workpiece, options.steps)
    residual = miss(arm, angles, workpiece)
    variance = residual @ residual / (len(angles) - 6)
    deviations = np.sqrt(np.diag(variance * np.linalg.inv(normal)))
    print(f"root mean square miss: {history[0]:.2e} m before, {history[-1]:.2e} m after {len(history) - 1} steps")
    print(f"{'':16} {'nominal':>9} {'found':>9} {'true':>9} {'error':>10} {'expected':>9}")
    for row in zip(NAMES, nominal, arm, truth, arm - truth, deviations):
        print("{:16} {:9.5f} {:9.5f} {:9.5f} {:10.1e} {:9.1e}".format(*row))
    draw(out / "calibration.png", angles, workpiece, nominal, arm, history)
    print(f"picture in {out}")
    if options.noise > 0 and np.abs((arm - truth) / deviations).max() > 5:
        raise SystemExit("an error is beyond five expected deviations")


if __name__ == "__main__":
    main()

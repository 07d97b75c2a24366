"""What each law keeps and costs: the table of the manual, with --impacts 10000."""

import argparse
import time

import numpy as np

import saltus

LAWS = ("discrete_energy", "nodal_energy", "shadow_energy", "compensated")
ARM = saltus.Pose((0, 0, -1))


def two_pendulums():
    """Two balls that touch at rest, of 1 and 2 kg."""
    builder = saltus.ModelBuilder("two unequal pendulums")
    for i, mass in enumerate((1.0, 2.0)):
        ball = saltus.solid_sphere(mass, 0.05)
        bob = saltus.BodyInertia(mass, (0, 0, -1), ball.I_J)
        builder.add_link(f"ball_{i}", bob).add_shape(f"ball_{i}", saltus.Sphere(0.05), ARM)
        pivot = saltus.Pose((0.1 * i, 0, 0))
        builder.add_joint(f"swing_{i}", saltus.JointType.revolute, parent="world",
                          child=f"ball_{i}", X_PJ=pivot, axis=(0, 1, 0))  # fmt: skip
    model = builder.build()
    return model, model.state(q={"swing_0": 0.3})


def double_pendulum():
    """Two arms of half a metre that swing between walls."""
    builder = saltus.ModelBuilder("double pendulum between walls")
    end = saltus.Pose((0, 0, -0.5))
    bob = saltus.BodyInertia(1.0, (0, 0, -0.5), saltus.solid_sphere(1.0, 0.05).I_J)
    for i, parent in enumerate(("world", "arm_0")):
        builder.add_link(f"arm_{i}", bob).add_shape(f"arm_{i}", saltus.Sphere(0.05), end)
        builder.add_joint(f"turn_{i}", saltus.JointType.revolute, parent=parent, child=f"arm_{i}",
                          X_PJ=end if i else saltus.Pose(), axis=(0, 1, 0))  # fmt: skip
    builder.add_half_space("left", (1, 0, 0), -0.2).add_half_space("right", (-1, 0, 0), -0.2)
    model = builder.build()
    return model, model.state(v=(1.5, -1.0))


def step_with_impact(model, start, h):
    """Return a state from which a step has one impact, near its middle."""
    stepper, state = saltus.Stepper(model, h), start
    for _ in range(100_000):
        after = stepper.advance(state)
        times = [(impact.t - state.t) / h for impact in stepper.report.impacts]
        if len(times) == 1 and 0.4 < times[0] < 0.6:
            return state
        state = after
    raise RuntimeError(f"no step of {model.name} has one impact near its middle")


def symplectic_defect(model, start, law, h=0.04):
    """|D' J D - J| of one step with an impact, D by central differences of order 8."""
    stepper = saltus.Stepper(model, h, law)
    n, delta = model.n_q, 1e-3
    x = np.concatenate([start.q, start.p])
    D = np.zeros((2 * n, 2 * n))
    for i, unit in enumerate(np.eye(2 * n)):
        for k, weight in enumerate((4 / 5, -1 / 5, 4 / 105, -1 / 280), start=1):
            for sign in (1, -1):
                y = x + sign * k * delta * unit
                after = stepper.advance(saltus.State(0.0, y[:n], y[n:]))
                if len(stepper.report.impacts) != 1:
                    return np.nan  # the differences reach beyond this step
                D[:, i] += sign * weight / delta * np.concatenate([after.q, after.p])
    J = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    return np.abs(D.T @ J @ D - J).max()


def long_run(model, state, law, h, impacts):
    """Greatest |H - H(0)| and |shadow - shadow(0)| [J] until there were so many impacts."""
    done, total, shadow, first = 0, 0.0, 0.0, None
    while done < impacts:
        run = saltus.simulate(model, state=state, duration=20.0, h=h, law=law, record_every=10)
        state, done = run.state(-1), done + len(run.impacts)
        if not len(run.impacts):
            raise RuntimeError(f"{model.name} has no impact in 20 s from {run.t[0]:g} s")
        first = first or (run.total[0], run.shadow[0])
        total = max(total, np.abs(run.total - first[0]).max())
        shadow = max(shadow, np.abs(run.shadow - first[1]).max())
    return total, shadow


def microseconds(model, start, law, h=0.01):
    """Return what a step with an impact takes."""
    stepper = saltus.Stepper(model, h, law)
    times = []
    for _ in range(200):
        begin = time.perf_counter()
        stepper.advance(start)
        times.append(time.perf_counter() - begin)
    return 1e6 * min(times)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--impacts", type=int, default=100)
    impacts = parser.parse_args().impacts
    for model, start in (two_pendulums(), double_pendulum()):
        print(f"\n{model.name}: energy errors [J] after {impacts} impacts\n")
        print("| law | symplectic defect | h = 0.02 | h = 0.01 | h = 0.005 | step with impact |")
        print("|---|---|---|---|---|---|")
        for law in LAWS:
            errors = [long_run(model, start, law, h, impacts) for h in (0.02, 0.01, 0.005)]
            cells = " | ".join(f"{H:.1e} ({shadow:.1e})" for H, shadow in errors)
            defect = symplectic_defect(model, step_with_impact(model, start, 0.04), law)
            cost = microseconds(model, step_with_impact(model, start, 0.01), law)
            print(f"| {law} | {defect:.0e} | {cells} | {cost:.0f} µs |")


if __name__ == "__main__":
    main()

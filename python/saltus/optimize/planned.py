"""Steps whose impacts are planned: the instants are inputs, and gaps there are outputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from saltus._core import ImpactLaw, Model, ModelError, State, StepError, StepOptions
from saltus.optimize.system import Array, System, cross_matrix

# An arc of this part of a step is taken for one of no duration: its end is the start, to rounding.
SHORTEST_ARC = 1e-12
# An impact within this part of a step is at its end; this part from an end another plan begins.
EDGE, FAR = 1e-3, 0.05
# Names that a message lists.
MANY = 12


@dataclass(frozen=True)
class Hit:
    """A planned impact: which gap closes in which step."""

    pair: int
    step: int


@dataclass(frozen=True)
class PlannedStep:
    """The end of a step and the gaps at its planned impacts, with their derivatives.

    Columns are the step's inputs, one after the other: q and p of its start, the controls and the
    durations of the arcs before each impact.
    """

    end: State
    by: Array  # (2 n_v, 2 n_v + n_u + impacts)
    gaps: Array  # (impacts,)
    gaps_by: Array  # (impacts, 2 n_v + n_u + impacts)


class Planner(System):
    """Steps of a model that pass through everything but do the impacts that are planned.

    Parameters are those of `System`.

    Raises
    ------
    ModelError
        On an impact law other than that whose planned impacts have a closed form.
    """

    def __init__(self, model: Model, h: float, options: Mapping[str, object]) -> None:
        law = StepOptions(h, **options).law  # type: ignore[arg-type]
        if law != ImpactLaw.nodal_energy:
            raise ModelError(
                f"law is {law.name}; planned impacts are those of nodal_energy. ilqr and shoot "
                "take the others"
            )
        super().__init__(model, h, {**options, "collisions": False})

    def arc(self, x: State, u: Array, tau: float) -> tuple[State, Array, Array, Array]:
        """Return the end of an arc without impact, and A, B and the derivative by tau."""
        if tau == self.h:
            stepper = self.stepper
        else:
            least = SHORTEST_ARC * self.h
            stepper = System(self.model, max(tau, least), self.options).stepper
        end = stepper.advance(x, control=u if len(u) else None)
        d = stepper.derivative()
        return end, d.A, d.B, d.h

    def kick(self, x: State, pair: int) -> tuple[State, Array, float, Array]:
        """Return the state after an impact, its derivative, the gap and its derivative by q.

        The impulse conserves energy at the node, or leaves the part e of the approach.
        """
        gaps = self.model.gaps(x.q)
        n, n_q = np.asarray(gaps.phi_q[pair]), np.array(gaps.phi_qq[pair])
        for block in self.balls:  # phi_qq is symmetric; what n does while a ball turns is not
            n_q[block, block] -= 0.5 * cross_matrix(n[block])
        e = self.model.contact_properties(pair).restitution
        v = self.model.velocity(x)
        M = np.array(self.model.lagrangian(x.q, v).L_vv)
        w = np.linalg.solve(M, n)
        G = float(n @ w)
        if not G > 0:
            raise ModelError(f"no joint moves {self.model.pair_name(pair)}: it closes by nothing")
        size = -(1 + e) * float(n @ v) / G
        middle = v + size / (1 + e) * w  # at full compression
        L_vq = self.model.lagrangian(x.q, middle).L_vq
        m = len(n)
        by = np.zeros(2 * m)
        by[:m] = -(1 + e) / G * ((2 * middle - v) @ n_q - w @ L_vq)
        by[m:] = -(1 + e) / G * w
        K = np.eye(2 * m)
        K[m:] += np.outer(n, by)
        K[m:, :m] += size * n_q
        return State(x.t, x.q, x.p + size * n), K, float(gaps.phi[pair]), n

    def step(self, x: State, u: Array, hits: Sequence[Hit], taus: Array) -> PlannedStep:
        """Return a step: arcs of durations taus, each ended by an impact, and what is left of h.

        Raises
        ------
        ModelError, StepError
            Where an arc has no end or no derivative.
        """
        m, count = len(x.p), len(hits)
        by = np.zeros((2 * m, 2 * m + len(u) + count))
        by[:, : 2 * m] = np.eye(2 * m)
        of_u, of_tau = slice(2 * m, 2 * m + len(u)), 2 * m + len(u)
        gaps, gaps_by = np.zeros(count), np.zeros((count, by.shape[1]))
        for i, hit in enumerate(hits):
            x, A, B, b = self.arc(x, u, float(taus[i]))
            by = A @ by
            by[:, of_u] += B
            by[:, of_tau + i] += told(b)
            x, K, gaps[i], n = self.kick(x, hit.pair)
            gaps_by[i] = n @ by[:m]
            by = K @ by
        x, A, B, b = self.arc(x, u, self.h - float(np.sum(taus)) if count else self.h)
        by = A @ by
        by[:, of_u] += B
        if count:
            by[:, of_tau:] -= told(b)[:, None]
        return PlannedStep(x, by, gaps, gaps_by)


def told(by_h: Array) -> Array:
    """Return the derivative by a duration, or raise ModelError where nobody tells it."""
    if len(by_h) == 0:
        raise ModelError(
            "forces are functions, whose derivative by time is not told: a step with a planned "
            "impact needs it"
        )
    return by_h


def planned_steps(
    planner: Planner, start: State, control: Array, hits: Sequence[Hit], taus: Array
) -> list[State]:
    """Return the states of a guess, whose gaps may be open where it is to hit."""
    states = [start]
    for k, u in enumerate(control):
        here = [i for i, hit in enumerate(hits) if hit.step == k]
        try:
            step = planner.step(states[-1], u, [hits[i] for i in here], taus[here])
        except (ModelError, StepError) as error:
            raise type(error)(f"step {k}, at t = {states[-1].t:g} s: {error}") from error
        states.append(State(start.t + (k + 1) * planner.h, step.end.q, step.end.p))
    return states


def plan_of(
    planner: Planner, start: State, N: int, impacts: Sequence[tuple[str, float]]
) -> tuple[list[Hit], Array]:
    """Return impacts, names and times, as steps and durations of arcs, or raise ModelError."""
    model, h = planner.model, planner.h
    names = model.gaps(start.q).names
    hits, taus, before = [], list[float](), start.t
    for name, t in impacts:
        if name not in names:
            more = ", ..." if len(names) > MANY else ""
            known = f"pairs are {', '.join(names[:MANY])}{more}" if names else "the model has none"
            raise ModelError(f"no pair is named {name!r}; {known}")
        friction = model.contact_properties(names.index(name)).friction
        if friction > 0:
            raise ModelError(
                f"{name} has friction {friction:g}; planned impacts have none. ilqr and shoot take "
                "friction"
            )
        if not start.t <= t < start.t + N * h or t < before:
            raise ModelError(
                f"an impact of {name} is planned at {t:g} s, after one at {before:g} s; times "
                f"ascend from {start.t:g} s, and end before {start.t + N * h:g} s"
            )
        step = min(int((t - start.t) / h), N - 1)
        taus.append(t - max(before, start.t + step * h))
        hits.append(Hit(names.index(name), step))
        before = t
    return hits, np.array(taus)


def instants(start: State, h: float, hits: Sequence[Hit], taus: Array) -> list[float]:
    """Return the times of planned impacts."""
    times, step, at = [], -1, 0.0
    for hit, tau in zip(hits, taus, strict=True):
        at = start.t + hit.step * h if hit.step != step else at
        step, at = hit.step, at + float(tau)
        times.append(at)
    return times


def neighbours(hits: Sequence[Hit], taus: Array, N: int, h: float) -> list[tuple[list[Hit], Array]]:
    """Return plans with an impact that is at an end of its step in the steps beside it.

    Within a step an impact can be anywhere, but it cannot leave it: there the problem changes. The
    cost has kinks at the ends, so an impact may stay at one though another is better. It begins at
    the far end of the step beyond, or at the near end of the step behind.
    """
    steps, found = [hit.step for hit in hits], []
    for i, k in enumerate(steps):
        own = [j for j, step in enumerate(steps) if step == k]
        is_early = i == own[0] and taus[i] < EDGE * h
        is_late = i == own[-1] and float(sum(taus[own])) > (1 - EDGE) * h
        for step, part in (
            (k - 1, FAR if is_early else 1 - FAR),
            (k + 1, FAR if is_early else 1 - FAR),
        ):
            is_first_or_last = i == (own[0] if step < k else own[-1])
            if (is_early or is_late) and is_first_or_last and 0 <= step < N:
                moved = placed(steps, taus, i, step, part, h)
                if moved is not None:
                    plan = list(hits)
                    plan[i] = Hit(hits[i].pair, step)
                    found.append((plan, moved))
    return found


def placed(
    steps: Sequence[int], taus: Array, i: int, step: int, part: float, h: float
) -> Array | None:
    """Return durations where impact i goes to a step beside its own, None where is no room."""
    out = taus.copy()
    there = [j for j, each in enumerate(steps) if each == step]
    if step < steps[i]:
        room = h - float(sum(taus[there]))
        if i + 1 < len(steps) and steps[i + 1] == steps[i]:
            out[i + 1] += taus[i]
    else:
        room = float(taus[there[0]]) if there else h
        if there:
            out[there[0]] -= part * room
    out[i] = part * room
    return out if room > EDGE * h else None

"""What of a model the page draws: bodies, their shapes, frames, threads to their pivots."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus._core import HalfSpace, JointType, Model
from saltus.records.tables import Array
from saltus.view.arrays import packed
from saltus.view.shapes import Geometries, bounding_radius

WORLD = -1  # the body that stands still
ALL_BODIES = 400  # larger models have only those with shapes; their massless links are not told
MOST_MATRICES = 100_000  # at once: 13 MB
FAR = 1000.0  # sizes of the scene from the world's origin; further away single precision is seen
TURNING = (JointType.revolute, JointType.continuous, JointType.spherical, JointType.helical)


class Parts:
    """The rigid bodies of a model, and what is fixed to them.

    Links that fixed joints connect are one body; so the page has few numbers to store.

    Parameters
    ----------
    model : Model
    q : numpy.ndarray, shape (n_q,)
        Coordinates at the start, by which the origin is chosen.

    Attributes
    ----------
    origin : numpy.ndarray, shape (3,)
        [m] in the world: what all places on the page are relative to. The page draws in single
        precision, so far away it is amid the bodies; elsewhere it is 0.
    bodies : list of int
        A link of each body; its frame is the body's.
    body_of : list of int
        Body of each link; `WORLD` of those that stand still, None of those left out.
    """

    def __init__(self, model: Model, q: Array) -> None:
        self.model = model
        self.origin = np.zeros(3)
        self.geometries = Geometries()
        # Asked once: each time the model makes these lists anew.
        self.links, self.shapes, self.joints = model.links, model.shapes, model.joints
        self._rest = model.neutral()[np.newaxis]
        self._links = model.all_poses(self._rest)[0]
        self._placed = model.all_shape_poses(self._rest)[0]
        self._joint_of = {joint.child: joint for joint in self.joints}
        owner = self._owners()
        shaped = {owner[s.link] for s in self.shapes} - {WORLD}
        shaped |= {owner[model.link(v.link)] for v in model.visuals} - {WORLD}
        moving = [i for i in range(len(owner)) if owner[i] == i]
        few = len(moving) <= ALL_BODIES or not shaped
        self.bodies = moving if few else [i for i in moving if i in shaped]
        numbers = {link: number for number, link in enumerate(self.bodies)}
        self.body_of = [WORLD if o == WORLD else numbers.get(o) for o in owner]
        self.origin = self._amid(self.poses(np.asarray(q)[np.newaxis])[0, :, :3])

    def _amid(self, at: Array) -> Array:
        """Return the middle of bodies at these places, where it is far away, else 0."""
        if not len(at):
            return np.zeros(3)
        solid = (s.shape for s in self.shapes if not isinstance(s.shape, HalfSpace))
        middle: Array = np.median(at, axis=0)
        size = max(np.abs(at - middle).max(), *map(bounding_radius, solid), 0.0)
        return middle if np.abs(middle).max() > FAR * size > 0 else np.zeros(3)

    def _owners(self) -> list[int]:
        """Return for each link the link whose frame moves it: the first of its rigid body."""
        index = {link.name: i for i, link in enumerate(self.links)}
        owner: list[int | None] = [None] * len(index)

        def find(i: int) -> int:
            chain = [i]
            while owner[chain[-1]] is None:
                joint = self._joint_of.get(self.links[chain[-1]].name)
                if joint is None:
                    owner[chain[-1]] = WORLD
                elif joint.type is not JointType.fixed:
                    owner[chain[-1]] = chain[-1]
                else:
                    chain.append(index[joint.parent])
            found = owner[chain[-1]]
            assert found is not None
            for link in chain:
                owner[link] = found
            return found

        return [find(i) for i in range(len(index))]

    def poses(self, q: Array) -> Array:
        """Return position from the origin and quaternion x y z w, shape (rows, bodies, 7)."""
        poses = np.empty((len(q), len(self.bodies), 7))
        rows = max(1, MOST_MATRICES // max(1, len(self.links)))
        for first in range(0, len(q), rows):
            part = self.model.all_poses(q[first : first + rows])[:, self.bodies]
            sevens = seven(part.reshape(-1, 4, 4))
            poses[first : first + rows] = sevens.reshape(len(part), -1, 7)
        poses[:, :, :3] -= self.origin
        return poses

    def described(self) -> dict[str, Any]:
        """Return the parts for the page."""
        names = [self.links[link].name for link in self.bodies]
        items = [*self._shapes(), *self._visuals()]
        return {
            "origin": self.origin.tolist(),
            "bodies": names,
            "items": items,
            "geometries": self.geometries.stored,
            "threads": packed(self._threads()),
            "frames": self._frames(),
        }

    def _in_body(self, link: int, X_WS: Array) -> tuple[int | None, Array]:
        """Return the body of a link, and a pose that is fixed to it in the body's frame.

        Of what stands still it is the pose from the origin.
        """
        body = self.body_of[link]
        if body is None or body == WORLD:
            moved = X_WS.copy()
            moved[:3, 3] -= self.origin
            return body, moved
        return body, np.linalg.solve(self._links[self.bodies[body]], X_WS)

    def _shapes(self) -> list[dict[str, Any]]:
        items = []
        for i, placed in enumerate(self.shapes):
            body, X_BS = self._in_body(placed.link, self._placed[i])
            geometry, scale = self.geometries.add(placed.shape)
            items.append(
                {
                    "name": placed.name,
                    "link": self.links[placed.link].name,
                    "body": body,
                    "kind": "collision",
                    "geometry": geometry,
                    "pose": seven(X_BS[np.newaxis])[0].tolist(),
                    "scale": scale,
                }
            )
        return items

    def _visuals(self) -> list[dict[str, Any]]:
        items = []
        for number, visual in enumerate(self.model.visuals):
            link = self.model.link(visual.link).index
            body, X_BG = self._in_body(link, self._links[link] @ visual.X_LG.matrix())
            geometry, scale = self.geometries.add(visual.shape)
            *colour, alpha = visual.rgba
            items.append(
                {
                    "name": visual.name or f"{visual.link} (visual {number})",
                    "link": visual.link,
                    "body": body,
                    "kind": "visual",
                    "geometry": geometry,
                    "pose": seven(X_BG[np.newaxis])[0].tolist(),
                    "scale": scale,
                    "colour": "#" + "".join(f"{round(255 * c):02x}" for c in colour),
                    "alpha": alpha,
                }
            )
        return items

    def _frames(self) -> list[dict[str, Any]]:
        frames = []
        for i, link in enumerate(self.links):
            body, X_BL = self._in_body(i, self._links[i])
            if body is not None:
                pose = seven(X_BL[np.newaxis])[0].tolist()
                frames.append({"name": link.name, "body": body, "pose": pose})
        return frames

    def _threads(self) -> Array:
        """Return lines fixed to bodies, rows of body and two points in its frame, shape (n, 7).

        They go from the pivot of a turning joint to the shapes that hang on it, and in bodies
        without shapes on to the next joints, or to the centre of mass where there are none: so that
        a pendulum and an arm can be seen.
        """
        rows: list[list[float]] = []
        shaped = set()
        for i, placed in enumerate(self.shapes):
            body, X_BS = self._in_body(placed.link, self._placed[i])
            if body is None or body == WORLD or isinstance(placed.shape, HalfSpace):
                continue
            shaped.add(body)
            if self._turns(self.bodies[body]):
                far = np.linalg.norm(X_BS[:3, 3]) > 1.05 * bounding_radius(placed.shape)
                if far:
                    rows.append([body, 0.0, 0.0, 0.0, *X_BS[:3, 3]])
        for joint in self.joints:
            body, X_BJ = self._in_body(
                self.model.link(joint.parent).index,
                self._links[self.model.link(joint.child).index],
            )
            slides = joint.type in (JointType.floating, JointType.planar, JointType.prismatic)
            if body is None or body == WORLD or body in shaped or slides:
                continue
            if np.linalg.norm(X_BJ[:3, 3]) > 1e-9:
                rows.append([body, 0.0, 0.0, 0.0, *X_BJ[:3, 3]])
        drawn = shaped | {int(row[0]) for row in rows}
        rows += [[body, 0.0, 0.0, 0.0, *p] for body, p in self._masses() if body not in drawn]
        return np.array(rows, float).reshape(-1, 7)

    def _masses(self) -> list[tuple[int, Array]]:
        """Return the bodies that turn, and the middle of the mass of each away from its pivot."""
        mass = np.zeros(len(self.bodies))
        moment = np.zeros((len(self.bodies), 3))
        for i, link in enumerate(self.links):
            body, X_BL = self._in_body(i, self._links[i])
            if body is not None and body != WORLD:
                mass[body] += link.mass
                moment[body] += link.mass * (X_BL[:3, :3] @ link.inertia.c_J + X_BL[:3, 3])
        turning = [b for b in np.flatnonzero(mass) if self._turns(self.bodies[b])]
        middles = [(int(b), moment[b] / mass[b]) for b in turning]
        return [(b, p) for b, p in middles if np.linalg.norm(p) > 1e-9]

    def _turns(self, link: int) -> bool:
        """Whether the joint that carries a link turns it about the origin of its frame."""
        return self._joint_of[self.links[link].name].type in TURNING


def shapeless(model: Model) -> str:
    """Return what a viewer must know of a model without shapes, "" of others."""
    if model.shapes:
        return ""
    if model.visuals:
        return "This model has visuals but no collision shapes: nothing can touch."
    return "This model has no shapes: its joints and frames are drawn."


def seven(X: Array) -> Array:
    """Return positions and unit quaternions x y z w of homogeneous matrices, shape (n, 7)."""
    R = X[:, :3, :3]
    trace = np.trace(R, axis1=1, axis2=2)
    # Of the four ways to a quaternion the one whose divisor is largest loses no digits.
    diagonal = np.concatenate([np.diagonal(R, axis1=1, axis2=2), trace[:, None]], axis=1)
    largest = diagonal.argmax(axis=1)
    x = np.empty((len(X), 4))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        at = largest == i
        x[at, i] = 1 - trace[at] + 2 * R[at, i, i]
        x[at, j] = R[at, j, i] + R[at, i, j]
        x[at, k] = R[at, k, i] + R[at, i, k]
        x[at, 3] = R[at, k, j] - R[at, j, k]
    at = largest == 3
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        x[at, i] = R[at, k, j] - R[at, j, k]
    x[at, 3] = 1 + trace[at]
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    return np.concatenate([X[:, :3, 3], x], axis=1)

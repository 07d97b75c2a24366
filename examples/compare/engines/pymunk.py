"""pymunk: the scenes are plane, and so is Chipmunk; elasticity 1, sequential impulses."""

from __future__ import annotations

import numpy as np
import pymunk

from compare.scene import LENGTH, Scene

NAME, VERSION = "pymunk", pymunk.version
STEP = 1e-4  # [s]
ITERATIONS = 100
SETTING = "step 0.1 ms, elasticity 1, 100 iterations"


class Balls:
    """Pendulums swing in the plane of x and z, other balls move in that of x and y."""

    def __init__(self, scene: Scene, step: float = STEP, iterations: int = ITERATIONS) -> None:
        self.step, self.scene = step, scene
        self.space = pymunk.Space()
        self.space.gravity = (0, -scene.gravity)
        self.space.iterations = iterations
        self.space.collision_slop = 0.0
        self.balls = [self._add(i) for i in range(len(scene.masses))]

    def _add(self, i: int) -> pymunk.Body:
        scene = self.scene
        (x, y), mass = scene.places[i], scene.masses[i]
        ball = pymunk.Body(mass, scene.inertias[i])
        shape = pymunk.Circle(ball, scene.radius)
        shape.elasticity, shape.friction = 1.0, 0.0
        self.space.add(ball, shape)
        if scene.kind == "cradle":
            angle, rate = scene.q[i], scene.v[i]
            down = np.array([np.sin(angle), np.cos(angle)]) * LENGTH
            ball.position = (x - down[0], LENGTH - down[1])
            ball.angle, ball.angular_velocity = -angle, -rate
            ball.velocity = (-rate * down[1], rate * down[0])
            pivot = (x, LENGTH)
            joint = pymunk.PivotJoint(self.space.static_body, ball, pivot, (0, LENGTH))
            self.space.add(joint)
        elif scene.kind == "line":
            ball.position, ball.velocity = (x + scene.q[i], y), (scene.v[i], 0)
        else:
            ball.position = (x + scene.q[2 * i], y + scene.q[2 * i + 1])
            ball.velocity = (scene.v[2 * i], scene.v[2 * i + 1])
        return ball

    def advance(self, steps: int) -> None:
        for _ in range(steps):
            self.space.step(self.step)

    def coordinates(self) -> tuple[np.ndarray, np.ndarray]:
        if self.scene.kind == "cradle":
            angles = [-ball.angle for ball in self.balls]
            return np.array(angles), np.array([-ball.angular_velocity for ball in self.balls])
        axes = 1 if self.scene.kind == "line" else 2
        at = np.array([tuple(ball.position)[:axes] for ball in self.balls])
        moves = np.array([tuple(ball.velocity)[:axes] for ball in self.balls])
        return (at - np.array(self.scene.places)[:, :axes]).ravel(), moves.ravel()


load = Balls

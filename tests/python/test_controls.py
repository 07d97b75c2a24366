"""Controls and forces as users give them: files, batches, pickles, mistakes."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.python.test_forces import H, arm, servo_arm

import saltus
from saltus import ModelError


def test_a_run_with_controls_is_saved_and_loaded(tmp_path: Path) -> None:
    model = servo_arm()
    run = saltus.simulate(model, duration=0.1, h=H, control={"shoulder": 0.2})
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5", model=model)
    np.testing.assert_array_equal(run.control, again.control)
    assert again.work.keys() == run.work.keys()
    np.testing.assert_array_equal(run.work["elbow"], again.work["elbow"])


def test_batches_take_controls_of_each_run() -> None:
    model = servo_arm()
    control = np.array([[0.1, 0.2], [0.3, -0.4]])
    batch = saltus.simulate_batch(
        model, q=np.zeros((2, 2)), duration=0.1, h=H, control=control, progress=False
    )
    for k in range(2):
        run = saltus.simulate(model, duration=0.1, h=H, control=control[k])
        np.testing.assert_array_equal(batch[k].q, run.q)
        np.testing.assert_array_equal(batch[k].control, run.control)


def test_a_model_with_motors_has_a_pickle() -> None:
    import pickle

    model = servo_arm()
    again = pickle.loads(pickle.dumps(model))
    assert again.control_names == ["shoulder", "elbow"]
    run = saltus.simulate(model, duration=0.1, h=H, control=[0.1, 0.2])
    same = saltus.simulate(again, duration=0.1, h=H, control=[0.1, 0.2])
    np.testing.assert_array_equal(run.q, same.q)


@pytest.mark.parametrize(
    ("control", "message"),
    [
        ({"sholder": 1.0}, 'no actuator "sholder"; there are shoulder, elbow'),
        ({"elbow": "much"}, "control\\[\"elbow\"\\] = 'much' is no number"),
        ({"elbow": math.nan}, 'control\\["elbow"\\] = nan is not finite'),
        ([1.0], "one number for each of the 2 actuators"),
        ("x", "it is a mapping of actuators' names"),
    ],
)
def test_controls_that_are_none_are_named(control: object, message: str) -> None:
    with pytest.raises(ModelError, match=message):
        saltus.simulate(servo_arm(), duration=0.1, h=H, control=control)  # type: ignore[arg-type]


def test_forces_that_are_none_are_named() -> None:
    model = servo_arm()
    stepper = saltus.Stepper(model)
    state = model.state()
    with pytest.raises(ModelError, match="no link"):
        stepper.advance(state, forces={"hand": saltus.Wrench((1, 0, 0))})
    with pytest.raises(ModelError, match="fixed to the world"):
        stepper.advance(state, forces={"world": saltus.Wrench((1, 0, 0))})
    with pytest.raises(ModelError, match="frame"):
        saltus.Wrench((1, 0, 0), frame="link")
    with pytest.raises(ModelError, match="qfrc"):
        stepper.advance(state, qfrc=[1.0])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda b: b.add_motor("m", joint="elbw"), 'no joint "elbw"; joints are shoulder, elbow'),
        (lambda b: b.add_motor("m", joint="elbow", effort=-1), "effort -1; it is positive"),
        (
            lambda b: b.add_motor("m", joint="elbow").add_motor("m", joint="elbow"),
            'two actuators are named "m"',
        ),
        (lambda b: b.set_damping("elbow", -1.0), "damping -1; it is finite and at least 0"),
        (lambda b: b.set_limit("elbow", 1.0, -1.0), "lower limit 1 and upper limit -1"),
        (lambda b: b.set_limit("elbow", -1.0, 1.0, restitution=2), "restitution 2"),
    ],
)
def test_builders_refuse_what_no_joint_can_have(make, message: str) -> None:
    with pytest.raises(ModelError, match=message):
        make(arm())


def test_forces_of_a_wrong_kind_are_named() -> None:
    model = servo_arm()
    with pytest.raises(TypeError, match=r'forces\["upper"\] is 3; it is a saltus\.Wrench'):
        saltus.simulate(model, duration=0.1, forces={"upper": 3})  # type: ignore[dict-item]


def test_sources_of_work_are_no_names_of_actuators() -> None:
    for name in ("damping", "friction", "applied"):
        with pytest.raises(ModelError, match=f'"{name}" has a name that work has already'):
            arm().add_motor(name, joint="elbow")


@pytest.mark.parametrize("gain", ["kp", "kd"])
def test_gains_of_servos_are_not_negative(gain: str) -> None:
    gains = {"kp": 1.0, gain: -2.0}
    with pytest.raises(ModelError, match=f'servo "s" has {gain} = -2; '):
        arm().add_position_servo("s", joint="elbow", **gains)
    with pytest.raises(ModelError, match='servo "s" has kv = -2; '):
        arm().add_velocity_servo("s", joint="elbow", kv=-2)


def test_the_first_control_of_a_policy_is_recorded() -> None:
    run = saltus.simulate(
        servo_arm(), duration=0.05, h=H, control=lambda now: [0.1 + now.t, 0.2], progress=False
    )
    np.testing.assert_allclose(run.control[:5, 0], 0.1 + H * np.arange(5), rtol=0, atol=1e-15)
    assert run.control[5, 0] == run.control[4, 0]  # no step starts at the last row

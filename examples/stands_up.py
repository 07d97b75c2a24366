"""A quadruped crouches, stands up on its servos, and is pushed; it stays on its feet.

Four feet bear 12 kg and the parcel of 2 kg on it: 137.34 N. The trunk stands 0.42 m high.
"""

import numpy as np

import saltus

text = (saltus.urdf_dir() / "quadruped.urdf").read_text()  # hips and knees are fixed in it
builder = saltus.read_urdf(text.replace('type="fixed"', 'type="continuous"'))
builder.set_default_contact(restitution=0, friction=0.8)
legs = [f"{end}_{side}" for end in ("front", "back") for side in ("left", "right")]
for leg in legs:
    for name in (f"{leg}_hip", f"{leg}_knee"):
        builder.joint(name).axis = (0, 1, 0)
        builder.add_position_servo(name, joint=name, kp=800.0, kd=20.0, effort=80.0)
model = builder.build()

crouch = {f"{leg}_hip": -0.5 for leg in legs} | {f"{leg}_knee": 1.0 for leg in legs}
low = 0.4 * (np.cos(0.5) - np.cos(1.0))  # the feet stay where they are
start = model.state(crouch | {"base_z": -low, "parcel_z": -low})


def policy(now):
    """Stand up within a second."""
    left = max(0.0, 1 - now.t)
    return {name: left * angle for name, angle in crouch.items()}


run = saltus.simulate(model, state=start, duration=2.0, h=0.005, control=policy)
push = {"trunk": saltus.Wrench((60, 0, 0))}
pushed = saltus.simulate(model, state=run.state(-1), duration=0.1, h=0.005, forces=push)
after = saltus.simulate(model, state=pushed.state(-1), duration=2.0, h=0.005, record_contacts=True)
last = after.contacts[after.contacts["row"] == len(after) - 1]
feet = [i for i, pair in enumerate(after.pair_names) if "shin" in pair and "floor" in pair]
load = last["lambda"][np.isin(last["pair"], feet)].sum() / 0.005
print(f"the trunk stands {after.poses('trunk')[-1, 2, 3]:.2f} m high")
print(f"the feet bear {load:.2f} N")

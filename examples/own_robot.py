"""A robot of one's own, first with a typing error.

The message names place, culprit and what there is. Then the weight falls freely for 1 s: by g t^2/2
= 4.905 m, exactly, because the midpoint rule integrates a constant force without error.
"""

import saltus

ROBOT = """
<robot name="lift">
  <link name="shaft"/>
  <joint name="height" type="prismatic">
    <parent link="shaft"/>
    <child link="wieght"/>
    <axis xyz="0 0 1"/>
    <limit lower="-10" upper="10"/>
  </joint>
  <link name="weight">
    <inertial>
      <mass value="2"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    </inertial>
  </link>
</robot>
"""

try:
    saltus.load_urdf(ROBOT)
except saltus.ModelError as error:
    print(error)
model = saltus.load_urdf(ROBOT.replace("wieght", "weight"))
run = saltus.simulate(model, duration=1.0)
print(f"height after 1 s: {run.column('height')[-1]:.6f} m")

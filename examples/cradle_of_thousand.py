"""A Newton's cradle of 1000 balls, the first let go at 0.3 rad.

Its blow goes through the row in 999 impulses at one instant, all of them I omega / length = p; the
last ball leaves with the first one's speed, sqrt(2 g (1 - cos 0.3) / I) = 0.9356 rad/s, I = 1.001.
"""

import saltus

model = saltus.load_urdf(saltus.scenes.cradle(1000, sways=False))
run = saltus.simulate(model, q={"swing_0": 0.3}, duration=0.6)
hit = run.impact(0)
print(f"at {hit.t:.4f} s {len(hit.lambdas)} impulses of {hit.lambdas[0]:.4f} N s")
print(f"greatest difference between them {abs(hit.lambdas - hit.lambdas[0]).max():.0e} N s")
print(f"first ball {run.column('swing_0', 'v')[-1]:.0e} rad/s")

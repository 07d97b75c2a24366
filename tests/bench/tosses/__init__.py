"""Recorded tosses of a cube, beside what engines make of their first rows.

`data` reads them; `flight` takes from their free flight what the recording's lengths and velocities
are worth; `measures` says how far two motions are apart. `engines` has a module for each engine,
run by `processes` in one of its own; `search` is the search by which `fit` finds an engine's
parameters on half of the tosses; `limits` asks how well anyone could do; `report`, `picture` and
`page.md` make a table, a drawing and the manual's page of the numbers.
"""

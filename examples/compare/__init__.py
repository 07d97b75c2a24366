"""Other engines before the same scenes: a process each, the same measures for all.

`scene` says what a scene is, `scenes` which there are; `engines` runs one in a process of its own,
with a module for each engine; `measure` makes numbers of a run, `report` and `picture` a table, a
page and a drawing of them.
"""

"""Tests and benchmarks; a package, because some wheels install a package `tests` of their own."""

"""Benchmarks against MuJoCo and Pinocchio: python -m tests.bench."""

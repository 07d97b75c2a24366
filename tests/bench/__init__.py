"""Benchmarks beside other engines: python -m tests.bench."""

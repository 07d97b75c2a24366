"""What is recorded of a run: plain data, impacts in words, files."""

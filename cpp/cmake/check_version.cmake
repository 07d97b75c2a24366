# Run by setup.sh: fails when this CMake is too old for the project.
cmake_minimum_required(VERSION 3.25)

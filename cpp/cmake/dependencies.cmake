# Where Eigen, urdfdom, console_bridge, tinyxml2, Qhull and Assimp come from.
#
# A pip environment keeps C++ packages (named cmeel-*) below site-packages/cmeel.prefix, an ordinary CMake prefix
# once it is known. Which site-packages, only a running Python can tell: pip's isolated builds put theirs on
# PYTHONPATH, and sysconfig does not know about it.
find_package(Threads REQUIRED)

if(SALTUS_DEPS STREQUAL "auto")
  if(SALTUS_FETCH_DEPS AND NOT EXISTS "${SALTUS_VENV}/bin/python")
    find_program(SALTUS_BASE_PYTHON python3 REQUIRED)
    message(STATUS "saltus: making the virtual environment ${SALTUS_VENV}")
    execute_process(COMMAND ${SALTUS_BASE_PYTHON} -m venv ${SALTUS_VENV} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  if(NOT DEFINED Python_EXECUTABLE AND EXISTS "${SALTUS_VENV}/bin/python")
    set(Python_EXECUTABLE "${SALTUS_VENV}/bin/python")
  endif()
endif()
# Development.Module must be asked for here: pybind11 finds no python_add_library after an Interpreter-only search.
find_package(Python 3.10 QUIET COMPONENTS Interpreter OPTIONAL_COMPONENTS Development.Module)

# Sets SALTUS_CMEEL_PREFIX to the folder that holds the C++ packages from PyPI, or to nothing.
function(saltus_find_cmeel_prefix)
  set(_ask "import importlib.util as u, pathlib as p; s = u.find_spec('cmeel'); \
print((p.Path(s.origin).parent.parent / 'cmeel.prefix').as_posix() if s else '')")
  execute_process(COMMAND "${Python_EXECUTABLE}" -c "${_ask}"
    OUTPUT_VARIABLE _prefix OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  foreach(_part lib/urdfdom include/urdfdom_headers include/libqhull_r include/assimp)
    if(NOT EXISTS "${_prefix}/${_part}")
      set(_prefix "")
      break()
    endif()
  endforeach()
  set(SALTUS_CMEEL_PREFIX "${_prefix}" PARENT_SCOPE)
endfunction()

if(SALTUS_DEPS STREQUAL "auto" AND Python_Interpreter_FOUND)
  saltus_find_cmeel_prefix()
  if(SALTUS_FETCH_DEPS AND NOT SALTUS_CMEEL_PREFIX)
    message(STATUS "saltus: pip installs the C++ dependencies into ${SALTUS_VENV}")
    execute_process(COMMAND "${Python_EXECUTABLE}" ${CMAKE_CURRENT_LIST_DIR}/build_requires.py
      OUTPUT_VARIABLE _requirements OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE "\n" ";" _requirements "${_requirements}")
    execute_process(COMMAND "${Python_EXECUTABLE}" -m pip install -q --disable-pip-version-check
      ${_requirements} ros-gtest-vendor COMMAND_ERROR_IS_FATAL ANY)
    saltus_find_cmeel_prefix()
  endif()
  if(SALTUS_CMEEL_PREFIX)
    list(PREPEND CMAKE_PREFIX_PATH "${SALTUS_CMEEL_PREFIX}" "${SALTUS_VENV}")
  endif()
endif()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(urdfdom_headers REQUIRED)
find_package(urdfdom REQUIRED)
find_package(console_bridge REQUIRED)  # urdfdom's config forgets to look for it
find_package(tinyxml2 REQUIRED)
find_package(Qhull REQUIRED)
find_package(assimp REQUIRED)
# Assimp's own libraries (zlib, on Debian draco) are its shared library's affair: no need to have them for linking.
set_property(TARGET assimp::assimp PROPERTY INTERFACE_LINK_LIBRARIES "")
message(STATUS "saltus: Eigen ${Eigen3_VERSION} in ${Eigen3_DIR}")
message(STATUS "saltus: urdfdom ${urdfdom_VERSION} in ${urdfdom_DIR}")

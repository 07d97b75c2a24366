# The extension module saltus._core.
if(NOT Python_Development.Module_FOUND)
  message(FATAL_ERROR "Python.h not found for ${Python_EXECUTABLE}: apt-get install python3-dev")
endif()
set(PYBIND11_FINDPYTHON ON)
find_package(pybind11 3.0 CONFIG REQUIRED)
# NO_EXTRAS: link-time optimisation costs compile time and gains nothing, the library being a shared one.
pybind11_add_module(_core NO_EXTRAS ${SALTUS_BINDING_SOURCES})
target_link_libraries(_core PRIVATE saltus::saltus)
target_precompile_headers(_core PRIVATE
  <pybind11/functional.h> ${PROJECT_SOURCE_DIR}/python/bindings/bindings.hpp)  # what every one of them includes
# Bindings only reshape data: -O1 compiles them in two thirds of the time. It stands after the configuration's -O3.
target_compile_options(_core PRIVATE $<$<CONFIG:Release>:-O1>)
target_compile_definitions(_core PRIVATE SALTUS_VERSION="${PROJECT_VERSION}")
saltus_warnings(_core)
set_target_properties(_core PROPERTIES INSTALL_RPATH "$ORIGIN/lib")
install(TARGETS _core LIBRARY DESTINATION .)

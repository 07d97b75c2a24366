# What `cmake --install` and a wheel contain. In a wheel everything lands below site-packages/saltus/, so that the
# Python package is at the same time an ordinary CMake prefix.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

if(SKBUILD)
  # Wheels have no symlinks: ship one file without version suffixes. Debian's lib/x86_64-linux-gnu makes no sense here.
  set(CMAKE_INSTALL_LIBDIR lib)
  set_target_properties(saltus PROPERTIES INSTALL_RPATH "$ORIGIN/../../cmeel.prefix/lib")
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    # DT_RPATH instead of DT_RUNPATH: an LD_LIBRARY_PATH (ROS sets one) beats RUNPATH, and its liburdfdom differs.
    target_link_options(saltus PRIVATE -Wl,--disable-new-dtags)
  endif()
else()
  set_target_properties(saltus PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  set(_rpath "$ORIGIN")
  if(SALTUS_CMEEL_PREFIX)
    list(APPEND _rpath "${SALTUS_CMEEL_PREFIX}/lib")
  endif()
  set_target_properties(saltus PROPERTIES INSTALL_RPATH "${_rpath}")
endif()

set(_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/saltus)
install(TARGETS saltus EXPORT saltusTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY cpp/include/saltus ${PROJECT_BINARY_DIR}/include/saltus DESTINATION include)
install(EXPORT saltusTargets NAMESPACE saltus:: DESTINATION ${_config_dir})
configure_package_config_file(cpp/saltusConfig.cmake.in saltusConfig.cmake INSTALL_DESTINATION ${_config_dir})
write_basic_package_version_file(saltusConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/saltusConfig.cmake ${PROJECT_BINARY_DIR}/saltusConfigVersion.cmake
  DESTINATION ${_config_dir})
install(DIRECTORY urdf/ DESTINATION share/saltus/urdf)

# What `cmake --install` puts where, beside what each folder installs of its own. The installed program finds
# its files from where it is itself, so the whole may be moved: bin, libexec/slipcheck, share/slipcheck.
include(CMakePackageConfigHelpers)

if(SLIPCHECK_PROGRAM)
  install(DIRECTORY scenarios DESTINATION share/slipcheck COMPONENT program)
  install(DIRECTORY results/baselines DESTINATION share/slipcheck/results COMPONENT program)
  install(FILES README.md CHANGELOG.md DESTINATION share/doc/slipcheck COMPONENT program)
  install(DIRECTORY docs DESTINATION share/doc/slipcheck COMPONENT program USE_SOURCE_PERMISSIONS)
endif()

# find_package(slipcheck)
set(cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/slipcheck)
set_target_properties(slipcheck_flags PROPERTIES EXPORT_NAME flags)
set_target_properties(slipcheck_plain_flags PROPERTIES EXPORT_NAME plain_flags)
install(TARGETS slipcheck_flags slipcheck_plain_flags EXPORT slipcheck)
install(EXPORT slipcheck NAMESPACE slipcheck:: FILE slipcheckTargets.cmake DESTINATION ${cmake_dir} COMPONENT dev)
configure_package_config_file(cmake/slipcheckConfig.cmake.in ${PROJECT_BINARY_DIR}/slipcheckConfig.cmake
  INSTALL_DESTINATION ${cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/slipcheckConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/slipcheckConfig.cmake ${PROJECT_BINARY_DIR}/slipcheckConfigVersion.cmake
  cmake/FindUDUNITS2.cmake DESTINATION ${cmake_dir} COMPONENT dev)

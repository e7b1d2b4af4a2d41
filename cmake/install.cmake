# What is installed, in two components: `runtime` is what a finished program needs, `development` the rest.
include(CMakePackageConfigHelpers)

# Shared libraries are executable but for Debian's, and lose their symbols with --strip; CMake does both for libraries that
# it built itself.
set(execute OWNER_EXECUTE GROUP_EXECUTE WORLD_EXECUTE)
if(CMAKE_INSTALL_SO_NO_EXE)
    set(execute "")
endif()
install(FILES "${lib_dir}/${shared_file}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime
    PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ ${execute})
set(installed_dir "${CMAKE_INSTALL_LIBDIR}")
cmake_path(ABSOLUTE_PATH installed_dir BASE_DIRECTORY "\${CMAKE_INSTALL_PREFIX}")
install(CODE "
    if(CMAKE_INSTALL_DO_STRIP)
        execute_process(COMMAND \"${CMAKE_STRIP}\" --strip-unneeded \"\$ENV{DESTDIR}${installed_dir}/${shared_file}\"
            COMMAND_ERROR_IS_FATAL ANY)
    endif()" COMPONENT runtime)
install(FILES "${lib_dir}/${soname}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime)
install(FILES "${lib_dir}/${shared_name}" "${lib_dir}/libgentrack2.a"
    DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development)

# How others find it: CMake's package and pkg-config. Both find their files from where they are themselves, so the
# installed tree can be moved.
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/gentrack2")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/gentrack2-config.cmake.in"
    "${PROJECT_BINARY_DIR}/gentrack2-config.cmake"
    INSTALL_DESTINATION "${package_dir}" PATH_VARS CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/gentrack2-config-version.cmake"
    COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/gentrack2-config.cmake" "${PROJECT_BINARY_DIR}/gentrack2-config-version.cmake"
    DESTINATION "${package_dir}" COMPONENT development)

set(pc_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
cmake_path(ABSOLUTE_PATH pc_dir BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}" OUTPUT_VARIABLE pc_absolute)
foreach(name LIBDIR INCLUDEDIR)
    # An absolute directory, which some distributions set, stays as it is.
    set(pc_${name} "${CMAKE_INSTALL_${name}}")
    if(NOT IS_ABSOLUTE "${pc_${name}}")
        string(PREPEND pc_${name} "\${prefix}/")
    endif()
endforeach()
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
    set(pc_prefix "${CMAKE_INSTALL_PREFIX}")
else()
    cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY "${pc_absolute}" OUTPUT_VARIABLE up)
    set(pc_prefix "\${pcfiledir}/${up}")
endif()
list(TRANSFORM static_needs PREPEND "-l" OUTPUT_VARIABLE static_flags)
list(JOIN static_flags " " static_flags)
configure_file("${PROJECT_SOURCE_DIR}/cmake/gentrack2.pc.in" "${PROJECT_BINARY_DIR}/gentrack2.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/gentrack2.pc" DESTINATION "${pc_dir}" COMPONENT development)

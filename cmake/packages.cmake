# cpack: a .tar.gz of everything, which may be unpacked anywhere, and Debian packages of the two components.
# `make package` makes them all.
set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_NAME gentrack2)
set(CPACK_PACKAGE_VENDOR "The gentrack2 maintainers")
set(CPACK_PACKAGE_CONTACT "The gentrack2 maintainers <maintainers@gentrack2.invalid>")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE-MIT")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_PACKAGE_FILE_NAME "gentrack2-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_ARCHIVE_COMPONENT_INSTALL OFF)
set(CPACK_STRIP_FILES ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(debian_aarch64 arm64)
set(debian_armv7l armhf)
if(CMAKE_CROSSCOMPILING AND DEFINED debian_${CMAKE_SYSTEM_PROCESSOR})
    set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${debian_${CMAKE_SYSTEM_PROCESSOR}})
    # dpkg-shlibdeps looks for packages of the machine that it runs on.
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS OFF)
    set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "libc6, libgcc-s1")
endif()

# As Debian names them: the SONAME's number is part of the runtime package's name, so two of them can be installed.
set(runtime_package "libgentrack2-${GENTRACK2_ABI_VERSION}")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "${PROJECT_DESCRIPTION} (shared library)")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME "${runtime_package}")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
file(WRITE "${PROJECT_BINARY_DIR}/triggers" "activate-noawait ldconfig\n")
file(WRITE "${PROJECT_BINARY_DIR}/shlibs" "libgentrack2 ${GENTRACK2_ABI_VERSION} ${runtime_package} (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/triggers" "${PROJECT_BINARY_DIR}/shlibs")

set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION} (headers, static library, how to find it)")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgentrack2-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${runtime_package} (= ${PROJECT_VERSION})")

file(READ "${PROJECT_SOURCE_DIR}/LICENSE-MIT" mit)
file(READ "${PROJECT_SOURCE_DIR}/LICENSE-APACHE" apache)
file(READ "${PROJECT_SOURCE_DIR}/LICENSE-THIRD-PARTY" third_party)
file(WRITE "${PROJECT_BINARY_DIR}/copyright"
    "gentrack2 is licensed under MIT or Apache-2.0, at your choice.\n\n${mit}\n${apache}\n${third_party}")
install(FILES "${PROJECT_BINARY_DIR}/copyright" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${runtime_package}"
    COMPONENT runtime)
install(FILES "${PROJECT_BINARY_DIR}/copyright" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/libgentrack2-dev"
    COMPONENT development)

include(CPack)

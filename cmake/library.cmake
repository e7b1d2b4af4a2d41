# The library, built by cargo, as imported targets.

set(GENTRACK2_CARGO_TARGET_DIR "${PROJECT_SOURCE_DIR}/target" CACHE PATH "Where cargo builds")
set(GENTRACK2_CARGO_PROFILE release CACHE STRING "Cargo's profile: release, or embedded for the smallest code")
set(GENTRACK2_FEATURES "" CACHE STRING "Cargo features, such as sort,toml; empty for all (docs/embedded.md)")
set(target "")
if(CMAKE_CROSSCOMPILING AND CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
    set(target aarch64-unknown-linux-gnu)
elseif(CMAKE_CROSSCOMPILING AND CMAKE_SYSTEM_PROCESSOR MATCHES "^armv7")
    set(target armv7-unknown-linux-gnueabihf)
endif()
set(GENTRACK2_CARGO_TARGET "${target}" CACHE STRING "Rust's name of the machine to build for; empty for this one")

find_program(CARGO cargo HINTS "$ENV{HOME}/.cargo/bin" REQUIRED)

set(cargo_options --profile ${GENTRACK2_CARGO_PROFILE} --lib --locked
    --manifest-path "${PROJECT_SOURCE_DIR}/Cargo.toml" --target-dir "${GENTRACK2_CARGO_TARGET_DIR}")
# Messages of panics name files; where the builder's crates lie is nobody's business and would make the library's bits
# depend on it. Whoever sets RUSTFLAGS decides for themselves.
set(cargo_home "$ENV{CARGO_HOME}")
if(NOT cargo_home)
    set(cargo_home "$ENV{HOME}/.cargo")
endif()
list(APPEND cargo_options --config "build.rustflags=['--remap-path-prefix=${cargo_home}=/cargo']")
set(cargo_environment "")
set(cargo_out "${GENTRACK2_CARGO_TARGET_DIR}")
if(GENTRACK2_FEATURES)
    list(APPEND cargo_options --no-default-features --features "${GENTRACK2_FEATURES}")
endif()
if(GENTRACK2_CARGO_TARGET)
    list(APPEND cargo_options --target ${GENTRACK2_CARGO_TARGET})
    string(TOUPPER "CARGO_TARGET_${GENTRACK2_CARGO_TARGET}_LINKER" linker)
    string(REPLACE "-" "_" linker "${linker}")
    set(cargo_environment "${linker}=${CMAKE_C_COMPILER}")
    string(APPEND cargo_out "/${GENTRACK2_CARGO_TARGET}")
endif()
string(APPEND cargo_out "/${GENTRACK2_CARGO_PROFILE}")

# Cargo knows best what is out of date, so it runs on every build; what it made is copied under its proper names,
# because cargo itself makes no versioned file and no symlinks for the SONAME.
set(lib_dir "${PROJECT_BINARY_DIR}/lib")
set(shared_name "libgentrack2.so")
set(soname "${shared_name}.${GENTRACK2_ABI_VERSION}")
set(shared_file "${shared_name}.${PROJECT_VERSION}")
file(MAKE_DIRECTORY "${lib_dir}")

add_custom_target(gentrack2_cargo ALL
    COMMAND "${CMAKE_COMMAND}" -E env ${cargo_environment} "${CARGO}" build ${cargo_options}
    COMMAND "${CMAKE_COMMAND}" -E copy_if_different "${cargo_out}/libgentrack2.so" "${lib_dir}/${shared_file}"
    COMMAND "${CMAKE_COMMAND}" -E copy_if_different "${cargo_out}/libgentrack2.a" "${lib_dir}/libgentrack2.a"
    COMMAND "${CMAKE_COMMAND}" -E create_symlink "${shared_file}" "${lib_dir}/${soname}"
    COMMAND "${CMAKE_COMMAND}" -E create_symlink "${soname}" "${lib_dir}/${shared_name}"
    BYPRODUCTS "${lib_dir}/${shared_file}" "${lib_dir}/libgentrack2.a" "${lib_dir}/${soname}" "${lib_dir}/${shared_name}"
    COMMENT "Building the library with cargo"
    USES_TERMINAL VERBATIM)

add_library(gentrack2_shared SHARED IMPORTED GLOBAL)
set_target_properties(gentrack2_shared PROPERTIES
    IMPORTED_LOCATION "${lib_dir}/${shared_file}"
    IMPORTED_SONAME "${soname}"
    INTERFACE_INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/include")
add_dependencies(gentrack2_shared gentrack2_cargo)
add_library(gentrack2::gentrack2 ALIAS gentrack2_shared)

# What `rustc --print native-static-libs` names, less gcc_s: compilers add the runtime themselves, in the form that suits
# a dynamic or a fully static program.
set(static_needs util rt pthread m dl c)
add_library(gentrack2_static STATIC IMPORTED GLOBAL)
set_target_properties(gentrack2_static PROPERTIES
    IMPORTED_LOCATION "${lib_dir}/libgentrack2.a"
    INTERFACE_LINK_LIBRARIES "${static_needs}"
    INTERFACE_INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/include")
add_dependencies(gentrack2_static gentrack2_cargo)
add_library(gentrack2::static ALIAS gentrack2_static)

# Checks a shared library: it exports exactly the functions of the header, needs nothing but the C library and the
# compiler's own, bears its versioned name, and rounds every product. Variables: LIBRARY, HEADER, SONAME, NM, READELF,
# OBJDUMP.
cmake_minimum_required(VERSION 3.25)

function(expect_equal what actual expected)
    if(NOT "${actual}" STREQUAL "${expected}")
        message(SEND_ERROR "${what}\n  is       ${actual}\n  expected ${expected}")
    endif()
endfunction()

execute_process(COMMAND "${NM}" -D --defined-only --format=posix "${LIBRARY}" OUTPUT_VARIABLE symbols
    COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" symbols "${symbols}")
list(TRANSFORM symbols REPLACE " .*" "")
list(SORT symbols)

file(READ "${HEADER}" header)
string(REGEX REPLACE "/\\*([^*]|\\*[^/])*\\*/" "" header "${header}")
string(REGEX REPLACE "//[^\n]*" "" header "${header}")
string(REGEX REPLACE "static inline[^(]*\\(" "" header "${header}")
string(REPLACE ";" "" header "${header}") # it would split the list
string(REGEX MATCHALL "gt2_[a-z0-9_]+\\([^)]*\\)" declared "${header}")
list(TRANSFORM declared REPLACE "\\(.*" "")
list(SORT declared)
list(LENGTH declared count)
if(count LESS 30)
    message(SEND_ERROR "only ${count} functions found in the header")
endif()
expect_equal("exported symbols" "${symbols}" "${declared}")

execute_process(COMMAND "${READELF}" -d "${LIBRARY}" OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "SONAME[^\n]*\\[([^\n]*)\\]" ignored "${dynamic}")
expect_equal("SONAME" "${CMAKE_MATCH_1}" "${SONAME}")
string(REGEX MATCHALL "NEEDED[^\n]*" needed "${dynamic}")
list(LENGTH needed count)
if(count EQUAL 0)
    message(SEND_ERROR "no NEEDED entries found")
endif()
foreach(entry IN LISTS needed)
    if(NOT entry MATCHES "\\[(libc|libm|libgcc_s|ld-linux[^]]*)\\.so\\.[0-9]+\\]")
        message(SEND_ERROR "needs more than it may: ${entry}")
    endif()
endforeach()

# A product that is added without being rounded first gives other bits than on a machine without such instructions.
execute_process(COMMAND "${OBJDUMP}" -d --no-show-raw-insn "${LIBRARY}" OUTPUT_VARIABLE code COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "\t(mulsd|fmul|vmul\\.f64)[ \t]" product "${code}")
string(REGEX MATCHALL "\t(vf?n?m(add|sub)[0-9a-z]*|fn?m(add|sub)|fml[as]|vfn?m[as]\\.f[0-9]+)[ \t][^\n]*" fused "${code}")
if(NOT product)
    message(SEND_ERROR "no product found in the code of ${LIBRARY}")
endif()
expect_equal("fused products" "${fused}" "")

# The name that programs look for leads to the library.
get_filename_component(directory "${LIBRARY}" DIRECTORY)
file(REAL_PATH "${directory}/${SONAME}" through_link)
file(REAL_PATH "${LIBRARY}" itself)
expect_equal("what ${SONAME} leads to" "${through_link}" "${itself}")

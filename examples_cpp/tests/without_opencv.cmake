# Tests of the example programs that go without OpenCV.

add_program_test(example_plain_c plain_c)
add_program_test(example_many_streams many_streams 8 60)
add_program_test(example_entrance_areas entrance_areas)
set(snapshot "${CMAKE_CURRENT_BINARY_DIR}/example.snapshot")
add_test(NAME example_save_restore_clean COMMAND "${CMAKE_COMMAND}" -E rm -f "${snapshot}")
add_program_test(example_save_restore_first save_restore "${snapshot}")
add_program_test(example_save_restore_second save_restore "${snapshot}")
set_tests_properties(example_save_restore_clean PROPERTIES LABELS program)
set_tests_properties(example_save_restore_first PROPERTIES DEPENDS example_save_restore_clean)
set_tests_properties(example_save_restore_second PROPERTIES DEPENDS example_save_restore_first)

# Eleven black frames and a part of a twelfth.
list(JOIN CMAKE_CROSSCOMPILING_EMULATOR " " emulator)
set(detections "${PROJECT_SOURCE_DIR}/../tests/fixtures/oracles/synthetic/syn_a4.det.txt")
set(tracks "${CMAKE_CURRENT_BINARY_DIR}/raw_yuv.txt")
add_program_test(example_raw_yuv sh -c
    "head -c 4000000 /dev/zero | ${emulator} '$<TARGET_FILE:raw_yuv>' 640 360 30 '${detections}' > '${tracks}' \
    && grep -q '^11,' '${tracks}' && ! grep '^12,' '${tracks}'")

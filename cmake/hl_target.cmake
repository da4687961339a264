# hl_library(name SOURCES ... LINK ...): one folder, one static library, the project's warnings and sanitizers.
# -ffp-contract=off: the same source gives the same bits with and without FMA units.
add_library(hl_flags INTERFACE)
target_compile_options(hl_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor> -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports false positives inside Eigen and the standard library at -O2.
  target_compile_options(hl_flags INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict)
endif()
if(HL_WERROR)
  target_compile_options(hl_flags INTERFACE -Werror)
endif()
if(HL_ASSERTS)
  target_compile_options(hl_flags INTERFACE -UNDEBUG)
endif()
if(HL_SANITIZE)
  target_compile_options(hl_flags INTERFACE -fsanitize=${HL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(hl_flags INTERFACE -fsanitize=${HL_SANITIZE})
  target_compile_definitions(hl_flags INTERFACE HL_SANITIZED=1)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # This check wants C functions of vendors' libraries declared with the very types of their own headers, which are not
    # ours to give on; nor can clang 14 place its marks in coroutines.
    target_compile_options(hl_flags INTERFACE -fno-sanitize=function)
  endif()
endif()

# hl_light(): the code of this folder waits for sockets, files and people, or calls other code that does the work.
# Optimising it takes time, twice as much with sanitizers, and gains nothing.
macro(hl_light)
  if(HL_SANITIZE)
    set(HL_LIGHT _light)
    add_compile_options(-O0)
  else()
    add_compile_options($<$<CONFIG:Release>:-O1>)
  endif()
endmacro()

# Beast's coroutines wait too, and -O3 would cost minutes of compiling. So would UndefinedBehaviorSanitizer, which looks
# at Boost's code for the most part: 80 s in place of 42 for page_feed.cpp.
if(HL_SANITIZE MATCHES undefined)
  set(HL_COROUTINES -O0 -fno-sanitize=undefined)
elseif(HL_SANITIZE)
  # GCC warns of Asio's fences: tests/tsan_suppressions.txt knows them.
  set(HL_COROUTINES -O0 $<$<CXX_COMPILER_ID:GNU>:-Wno-tsan>)
else()
  set(HL_COROUTINES -O1)
endif()

# hl_coroutines(SOURCES...): the sources of a target that are coroutines.
function(hl_coroutines)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON COMPILE_OPTIONS "${HL_COROUTINES}")
endfunction()

# hl_coroutine_target(TARGET): most of its sources are coroutines, so that they are compiled together.
function(hl_coroutine_target target)
  set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)  # made with other options
  # GCC takes sources that are compiled together for headers.
  target_compile_options(${target} PRIVATE ${HL_COROUTINES} $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

function(hl_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC hl_flags ${ARG_LINK})
endfunction()

# What tests do themselves takes no time: they call code that is optimised as users have it. Compiling them with -O3 takes
# a third longer, and they are half of all that is compiled.
if(NOT HL_SANITIZE)
  set(HL_TEST_OPTIMISATION $<$<CONFIG:Release>:-O1>)
endif()
# It links a test in a fifth of the time; the presets of sanitizers ask for it themselves.
find_program(HL_LLD ld.lld)

# The headers that most tests include, compiled once: GoogleTest, RapidCheck and Eigen are half of a test's compiling.
function(hl_test_headers name)
  if(NOT TARGET ${name})
    add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/tests/precompiled.cpp)
    # As the programs that use them: those made with -fPIC are of no use to them.
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${name} PRIVATE -fPIE ${HL_TEST_OPTIMISATION})
    target_link_libraries(${name} PRIVATE hl_flags Eigen3::Eigen GTest::gtest rapidcheck)
    target_precompile_headers(${name} PRIVATE <gtest/gtest.h> <rapidcheck/gtest.h> <Eigen/Core> <Eigen/Geometry>
      <fstream> <functional> <map> <memory> <mutex> <sstream> <string> <thread> <vector>)
  endif()
endfunction()

# hl_test(name SOURCES ... LINK ...): one GoogleTest program; ctest runs each of its cases on its own. Their label is
# the name of the folder. A folder has one program: its sources are compiled together, so each has a namespace named as
# the file.
function(hl_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 900)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_options(${name} PRIVATE ${HL_TEST_OPTIMISATION})
  if(HL_LLD)
    target_link_options(${name} PRIVATE -fuse-ld=lld)
  endif()
  target_link_libraries(${name} PRIVATE ${ARG_LINK} hl_flags Eigen3::Eigen GTest::gtest GTest::gtest_main rapidcheck)
  if(NOT "${ARG_SOURCES}" MATCHES "\\.c(;|$)")
    hl_test_headers(hl_test_headers${HL_LIGHT})
    target_precompile_headers(${name} REUSE_FROM hl_test_headers${HL_LIGHT})
  endif()
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS ${folder}
    # Black boxes of faults that tests bring about: not among those of whoever runs them.
    ENVIRONMENT "XDG_STATE_HOME=${CMAKE_BINARY_DIR}/test-state")
endfunction()

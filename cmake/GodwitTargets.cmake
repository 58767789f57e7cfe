# What every target of the project shares: the language level, the warnings, where programs go, the optional sanitizers,
# the compiler cache and the precompiled header of CAF. Warnings are errors, so that the tree stays clean; dependencies
# are system headers and stay quiet.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
# Assertions stay on in every build: a broken invariant of our own ends the incarnation or the process, also in flight.
# The sanitizer suite is not measured: what is tested is compiled with -O1, the tests themselves with -O0
# (godwit_options_of_tests), which takes half the time.
if(GODWIT_SANITIZE)
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1")
else()
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")
endif()

# The libraries are for this build only: they name their object files and do not copy them, which saves a sixth of the
# disk that a build takes.
set(CMAKE_CXX_ARCHIVE_CREATE "<CMAKE_AR> qcT <TARGET> <LINK_FLAGS> <OBJECTS>")
set(CMAKE_CXX_ARCHIVE_APPEND "<CMAKE_AR> qT <TARGET> <LINK_FLAGS> <OBJECTS>")

# ccache is set up here and not in the presets, so that `ninja -C build/release` uses it just as `./dev build` does.
# Relative paths (BASEDIR) let a fresh clone find what another clone has compiled; the sloppiness is what precompiled
# headers need.
find_program(GODWIT_CCACHE ccache)
if(GODWIT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_BASEDIR=${PROJECT_SOURCE_DIR};CCACHE_NOHASHDIR=true"
      "CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime"
      "${GODWIT_CCACHE}")
endif()

# The presets that build everything compile several files of a target as one (unity build): the headers that they share
# are what takes the time, and a whole build takes a fifth of it so. Names in unnamed namespaces must therefore differ
# within a target. In the others (dev, lint) each file stands alone, and shows what it forgot to include.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)

# With GCC the linker is GNU's. LLVM's (14) keeps one entry for each address in .eh_frame_hdr, and GCC gives empty cold
# parts of functions an entry of their own: then an exception out of the cold part of the next function is not caught,
# and ends the process (phase_table.a_trigger_without_a_row_throws was so).
add_library(godwit_options INTERFACE)
target_include_directories(godwit_options INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_options(godwit_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Werror
                       "-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports these for inlined standard-library code that is correct (GCC bugs 105562, 105329, 107138).
  target_compile_options(godwit_options INTERFACE -Wno-maybe-uninitialized -Wno-restrict -Wno-stringop-overflow
                         -Wno-array-bounds)
  if(CMAKE_UNITY_BUILD)
    target_compile_options(godwit_options INTERFACE -Wno-subobject-linkage) # as if our sources were headers
  endif()
endif()
if(GODWIT_PLANTED_BUGS)
  target_compile_definitions(godwit_options INTERFACE GODWIT_PLANTED_BUGS)
endif()
if(GODWIT_FUZZ)
  target_compile_options(godwit_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(godwit_options INTERFACE -fsanitize=address,undefined)
elseif(GODWIT_SANITIZE)
  target_compile_options(godwit_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                         -fno-omit-frame-pointer)
  target_link_options(godwit_options INTERFACE -fsanitize=address,undefined)
endif()

# godwit_precompiled(NAME LINK ... HEADERS ...): a target whose only product is a precompiled header for others.
function(godwit_precompiled name)
  cmake_parse_arguments(arg "" "" "LINK;HEADERS" ${ARGN})
  set(source "${CMAKE_BINARY_DIR}/${name}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "// CMake builds a precompiled header only for a target with a source.\n")
  add_library(${name} OBJECT "${source}")
  target_link_libraries(${name} PRIVATE godwit_options ${arg_LINK})
  target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${name} PRIVATE -fpch-preprocess)
  endif()
endfunction()

# godwit_reuse_precompiled(TARGET FROM): TARGET includes the precompiled header of FROM first in each file.
# -fpch-preprocess is what ccache needs to see the precompiled header.
function(godwit_reuse_precompiled target from)
  target_precompile_headers(${target} REUSE_FROM ${from})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)
  endif()
endfunction()

set(godwit_common_headers <nlohmann/json.hpp> <tl/expected.hpp> <algorithm> <array> <chrono> <cstdint> <deque> <functional>
    <map> <memory> <mutex> <optional> <span> <string> <string_view> <thread> <unordered_map> <utility> <variant> <vector>)
set(godwit_caf_headers <caf/all.hpp> ${godwit_common_headers})
set(godwit_gtest_headers <gtest/gtest.h> <rapidcheck.h> <rapidcheck/gtest.h>)

# godwit_use_pch(TARGET): for every library and program; the headers cost 1.5 s in each file.
function(godwit_use_pch target)
  if(NOT TARGET godwit_pch)
    godwit_precompiled(godwit_pch LINK nlohmann_json::nlohmann_json tl::expected HEADERS ${godwit_common_headers})
  endif()
  godwit_reuse_precompiled(${target} godwit_pch)
endfunction()

# godwit_options_of_tests(TARGET): for what is compiled of a test, and its precompiled header; both must be the same. -Og
# takes two thirds of the time of -O2; what is tested is compiled as it ships. Benches are not tests.
function(godwit_options_of_tests target)
  if(GODWIT_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  elseif(CMAKE_BUILD_TYPE STREQUAL "RelWithDebInfo")
    target_compile_options(${target} PRIVATE -Og)
  endif()
endfunction()

# godwit_use_test_pch(TARGET): the same for tests, with GoogleTest and RapidCheck.
function(godwit_use_test_pch target)
  if(NOT TARGET godwit_test_pch)
    godwit_precompiled(godwit_test_pch
                       LINK nlohmann_json::nlohmann_json tl::expected GTest::gtest rapidcheck rapidcheck_gtest
                       HEADERS ${godwit_common_headers} ${godwit_gtest_headers})
    godwit_options_of_tests(godwit_test_pch)
  endif()
  godwit_options_of_tests(${target})
  godwit_reuse_precompiled(${target} godwit_test_pch)
endfunction()

# godwit_use_caf_pch(TARGET): for the runtime and what tests it from inside; nothing else includes CAF.
function(godwit_use_caf_pch target)
  if(NOT TARGET godwit_caf_pch)
    godwit_precompiled(godwit_caf_pch LINK CAF::core nlohmann_json::nlohmann_json tl::expected
                       HEADERS ${godwit_caf_headers})
  endif()
  godwit_reuse_precompiled(${target} godwit_caf_pch)
endfunction()

# godwit_use_caf_test_pch(TARGET): the same for tests: CAF, GoogleTest and RapidCheck.
function(godwit_use_caf_test_pch target)
  if(NOT TARGET godwit_caf_test_pch)
    godwit_precompiled(godwit_caf_test_pch
                       LINK CAF::core nlohmann_json::nlohmann_json tl::expected GTest::gtest rapidcheck rapidcheck_gtest
                       HEADERS ${godwit_caf_headers} ${godwit_gtest_headers})
    godwit_options_of_tests(godwit_caf_test_pch)
  endif()
  godwit_options_of_tests(${target})
  godwit_reuse_precompiled(${target} godwit_caf_test_pch)
endfunction()

# godwit_library(NAME [CAF] [ALONE] SOURCES ... LINK ...): a static library with the shared options and the precompiled
# header of what nearly every file includes; CAF (only runtime/): with CAF's instead. ALONE: each file is compiled by
# itself, because what it instantiates takes far longer than its headers (stored forms, mailboxes, messages).
function(godwit_library name)
  cmake_parse_arguments(arg "CAF;ALONE" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${arg_SOURCES})
  if(arg_ALONE)
    set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  endif()
  target_link_libraries(${name} PUBLIC godwit_options ${arg_LINK})
  if(arg_CAF)
    godwit_use_caf_pch(${name})
  elseif(NOT GODWIT_FUZZ)
    godwit_use_pch(${name})
  endif()
endfunction()

# How targets are made here, once.

add_library(mpmWarnings INTERFACE)
# Functions that return records of eight doubles (base/record.hpp) are inlined wherever they are called, so how a machine
# without AVX-512 would pass such a value does not matter.
target_compile_options(mpmWarnings INTERFACE -Wall -Wextra -Wno-psabi)

# Flags of the hot kernels. Contraction to fused multiply-add and the absence of errno, traps and signed zeros let
# plain loops over 64 lanes vectorise; NaN and infinity keep their meaning (no -ffast-math), so that checks for them work.
add_library(mpmKernelFlags INTERFACE)
target_compile_options(mpmKernelFlags INTERFACE
    -fno-math-errno -fno-trapping-math -fno-signed-zeros -ffp-contract=fast)
if(MPM_KERNEL_LIBRARY STREQUAL STATIC) # else each library has its own
    mpm_set_flags(${MPM_BASE_SET} setFlags)
    target_compile_options(mpmKernelFlags INTERFACE ${setFlags})
endif()

# mpm_joined(target): eight sources at a time are one for the compiler, which takes half as long, as all include much the
# same. Release compiles each alone, so that each has to include what it uses. Apart stay kernels and CGAL, which are long
# anyway, and sources that share a name with another of their folder.
option(MPM_JOINED "compile the libraries' sources eight at a time, as the sanitizers of tests/Allaudit do" OFF)
function(mpm_joined target)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "(/|^)(step[A-Z][A-Za-z]*[23]D|region[23]D|alphaWrap[23]D|hullDistance|neoHookean|smallStrain|splitParticles|meshBytes|lawCheck|rateEquations|vonMisesRates|accuracyMatrix|accuracyReport|pickSetting|transferEffects)\\.cpp$")
    set_source_files_properties(${sources} TARGET_DIRECTORY ${target} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
endfunction()

# mpm_utility(name LIBS...): one thin main, utilities/<name>/<name>.cpp, put into build/bin. The target `utilities`
# builds them all, without the tests.
add_custom_target(utilities)
function(mpm_utility name)
    add_executable(${name} ${name}/${name}.cpp)
    target_link_libraries(${name} PRIVATE mpm::core mpmWarnings ${ARGN})
    add_dependencies(utilities ${name})
    mpm_install_utility(${name})
endfunction()

# Assertions need little of the optimiser, and of the sanitizers that of addresses alone: compiling them with all takes
# twice as long.
set(MPM_TEST_FLAGS -O1 CACHE STRING "how test programs are compiled that hold no kernels themselves")
option(MPM_TEST_CASES "a ctest test for each case of the test programs; OFF: one a program, without its cases tagged [long]" ON)

# What the sanitizers of tests/Allaudit look at: test programs of the labels unit and verification, and utilities that
# scenes of the label stability run.
add_custom_target(audited)

function(mpm_test_flags target)
    target_link_libraries(${target} PRIVATE mpmWarnings Catch2::Catch2 OpenMP::OpenMP_CXX)
    target_compile_options(${target} PRIVATE "$<$<NOT:$<CONFIG:Debug>>:${MPM_TEST_FLAGS}>")
endfunction()

# mpm_test(name LIBS...): one Catch2 program from <name>.cpp in the current folder; its cases become ctest tests whose
# label is the folder's name.
function(mpm_test name)
    add_executable(${name} ${name}.cpp $<TARGET_OBJECTS:mpmCatchMain>)
    target_link_libraries(${name} PRIVATE mpm::core ${ARGN})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_compile_definitions(${name} PRIVATE MPM_SOURCE_DIR="${PROJECT_SOURCE_DIR}" MPM_BUILD_DIR="${PROJECT_BINARY_DIR}")
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
    get_filename_component(label ${CMAKE_CURRENT_SOURCE_DIR} NAME)
    if("mpmKernelFlags" IN_LIST ARGN)
        target_link_libraries(${name} PRIVATE mpmWarnings Catch2::Catch2)
    else()
        mpm_test_flags(${name})
        target_precompile_headers(${name} REUSE_FROM mpmCatchHeader)
    endif()
    if(label MATCHES "^(unit|verification)$")
        add_dependencies(audited ${name})
    endif()
    # threads that wait sleep: tests run side by side
    if(MPM_TEST_CASES)
        catch_discover_tests(${name} TEST_PREFIX "${name}:" PROPERTIES LABELS ${label} ENVIRONMENT OMP_WAIT_POLICY=passive)
    else()
        add_test(NAME ${name} COMMAND ${name} ~[long]~[.])
        set_tests_properties(${name} PROPERTIES LABELS ${label} ENVIRONMENT OMP_WAIT_POLICY=passive)
    endif()
endfunction()

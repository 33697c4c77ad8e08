# Which instruction sets the libraries of kernels (mpm::core, mpm::benchmark) are compiled for.
#
#   MPM_NATIVE=ON   that of this machine: one static library (the default; the fastest, and for this machine only)
#   MPM_NATIVE=OFF  those in MPM_INSTRUCTION_SETS. With several, each library of kernels is a shared one, made once for
#                   every set, where the dynamic loader (glibc 2.33 and later) looks first for what the processor can do:
#                       lib/libmpmCore.so                               the first set, which everything else is made for
#                       lib/glibc-hwcaps/x86-64-v3/libmpmCore.so        AVX2 and FMA
#                       lib/glibc-hwcaps/x86-64-v4/libmpmCore.so        AVX-512
#                   No code of ours chooses, and no function compiled for AVX-512 can be linked into a program that has
#                   to run without. With one set everything is compiled for it, and static.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64")
    set(sets x86-64-v2 x86-64-v3 x86-64-v4)
endif()
set(MPM_INSTRUCTION_SETS "${sets}" CACHE STRING "without MPM_NATIVE: instruction sets of the kernels, lowest first")

set(MPM_HIGHER_SETS "") # beyond the first, MPM_BASE_SET
if(MPM_NATIVE)
    set(MPM_BASE_SET native)
elseif(MPM_INSTRUCTION_SETS)
    set(MPM_HIGHER_SETS ${MPM_INSTRUCTION_SETS})
    list(POP_FRONT MPM_HIGHER_SETS MPM_BASE_SET)
    add_compile_options(-march=${MPM_BASE_SET})
else()
    set(MPM_BASE_SET ${CMAKE_SYSTEM_PROCESSOR})
endif()
set(MPM_KERNEL_LIBRARY STATIC)
if(MPM_HIGHER_SETS)
    set(MPM_KERNEL_LIBRARY SHARED)
    # Eigen aligns objects and memory by the instruction set; on both sides of a library's border it has to be the same.
    add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
endif()

# What -march=native means here: the compiler's name of the machine and its widest vectors, as "znver3, avx512".
function(mpm_native_name result)
    set(flags -march=native -E -x c++ /dev/null)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} "-###" ${flags} OUTPUT_QUIET ERROR_VARIABLE call)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -dM ${flags} OUTPUT_VARIABLE macros ERROR_QUIET)
    set(name ${CMAKE_SYSTEM_PROCESSOR})
    if(call MATCHES "\"-target-cpu\" \"([^\"]+)")
        set(name ${CMAKE_MATCH_1})
    elseif(call MATCHES "cc1plus[^\n]*-march=([A-Za-z0-9_-]+)")
        set(name ${CMAKE_MATCH_1})
    endif()
    foreach(vectors AVX512F AVX2 AVX SSE2)
        if(macros MATCHES "#define __${vectors}__ 1")
            string(TOLOWER ${vectors} vectors)
            string(APPEND name ", ${vectors}")
            break()
        endif()
    endforeach()
    set(${result} "${name}" PARENT_SCOPE)
endfunction()

# Flags of a set.
function(mpm_set_flags set result)
    set(flags "")
    if(set STREQUAL native)
        set(flags -march=native)
    elseif(MPM_INSTRUCTION_SETS)
        set(flags -march=${set})
    endif()
    if(set STREQUAL x86-64-v4 OR (set STREQUAL native AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64"))
        list(APPEND flags -mprefer-vector-width=512)
    endif()
    set(${result} ${flags} PARENT_SCOPE)
endfunction()

# A static library that programs and shared libraries (libmpm.so, the Python module, FMUs) are linked from alike. Its
# symbols are hidden, so that its code is that of a program: no call goes through a table.
function(mpm_embeddable target)
    set_target_properties(${target} PROPERTIES
        POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# Name and flags of the set a target is made for, as base/version.cpp says them; flags and place of one of several.
function(mpm_instruction_set target output set)
    set(name ${set})
    if(set STREQUAL native)
        mpm_native_name(machine)
        set(name "native (${machine})")
    endif()
    set(flagsText "") # of one set: part of mpmKernelFlags
    if(MPM_KERNEL_LIBRARY STREQUAL SHARED)
        mpm_set_flags(${set} flags)
        string(REPLACE ";" " " flagsText " ${flags}")
        set(folder "")
        if(NOT set STREQUAL MPM_BASE_SET)
            set(folder /glibc-hwcaps/${set})
        endif()
        set_target_properties(${target} PROPERTIES
            OUTPUT_NAME ${output} LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib${folder} INSTALL_RPATH "$ORIGIN")
        # Calls within the library stay there, as in a static one: a program's copy of an inline function, compiled for
        # the lowest set, must not stand in for the library's own.
        target_compile_options(${target} PRIVATE ${flags} -fvisibility-inlines-hidden -fno-semantic-interposition)
        target_link_options(${target} PRIVATE -Wl,-Bsymbolic-functions)
        install(TARGETS ${target} LIBRARY DESTINATION ${MPM_LIBRARY_FOLDER}${folder} COMPONENT coupling)
    endif()
    target_compile_definitions(${target} PRIVATE MPM_INSTRUCTION_SET="${name}" "MPM_SET_FLAGS=\"${flagsText}\"")
endfunction()

# mpm_kernel_library(name LINKED...): a library of kernels, and its likes for the higher sets; LINKED as in
# target_link_libraries. Once all sources of `name` are known, mpm_kernel_sources(name) gives them to the others.
function(mpm_kernel_library name)
    foreach(set ${MPM_BASE_SET} ${MPM_HIGHER_SETS})
        set(target ${name})
        if(NOT set STREQUAL MPM_BASE_SET)
            set(target ${name}-${set})
        endif()
        add_library(${target} ${MPM_KERNEL_LIBRARY})
        target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/libmpm)
        target_link_libraries(${target} PRIVATE mpmWarnings mpmKernelFlags ${ARGN})
        if(MPM_KERNEL_LIBRARY STREQUAL STATIC)
            mpm_embeddable(${target})
        endif()
        mpm_instruction_set(${target} ${name} ${set})
    endforeach()
endfunction()

function(mpm_kernel_sources name)
    get_target_property(sources ${name} SOURCES)
    foreach(set ${MPM_HIGHER_SETS})
        target_sources(${name}-${set} PRIVATE ${sources})
        add_dependencies(${name} ${name}-${set})
    endforeach()
endfunction()

# MPM_SHAPES: whose kernels are compiled. All by default; a list of some (-DMPM_SHAPES=uGIMP) builds several times faster while
# one works on the step. The others are then refused by name where a case asks for them.
set(MPM_SHAPES all CACHE STRING "shapes to compile kernels for: all, or a list of linear uGIMP cpGIMP CPDI quadraticBSpline cubicBSpline")

# mpm_shape_sources(TARGET TEMPLATE PREFIX shapes...): adds PREFIX<Shape><dim>D.cpp for the shapes that are built; for the others a source made
# from TEMPLATE, whose function refuses.
function(mpm_shape_sources target template prefix)
    foreach(name IN LISTS ARGN)
        string(SUBSTRING ${name} 0 1 first)
        string(TOUPPER ${first} first)
        string(SUBSTRING ${name} 1 -1 rest)
        set(shape ${first}${rest}) # the class, in a file of the same name as the word
        foreach(dim 2 3)
            if(prefix)
                set(file ${prefix}${shape}${dim}D.cpp)
            else()
                set(file ${name}${dim}D.cpp)
            endif()
            if(MPM_SHAPES STREQUAL all OR name IN_LIST MPM_SHAPES)
                target_sources(${target} PRIVATE ${file})
                # Passes over particles are the same templates for every shape: under sanitizers all are watched for
                # addresses, those of uGIMP (and the tests chunk, cornerWeights and transfer) for undefined behaviour too.
                if(prefix AND NOT name STREQUAL uGIMP) # step
                    set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/${file} TARGET_DIRECTORY ${target} PROPERTIES
                        COMPILE_OPTIONS $<$<BOOL:${MPM_JOINED}>:-fno-sanitize=undefined>)
                endif()
            else()
                configure_file(${template} ${CMAKE_CURRENT_BINARY_DIR}/${file} @ONLY)
                target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${file})
            endif()
        endforeach()
    endforeach()
endfunction()

set(known all linear uGIMP cpGIMP CPDI quadraticBSpline cubicBSpline)
foreach(name IN LISTS MPM_SHAPES)
    if(NOT name IN_LIST known)
        message(FATAL_ERROR "MPM_SHAPES: found '${name}', allowed all, or some of linear;uGIMP;cpGIMP;CPDI;quadraticBSpline;cubicBSpline")
    endif()
endforeach()

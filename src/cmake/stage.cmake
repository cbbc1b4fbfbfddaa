# transillum_stage(NAME SOURCES ... USES stages ... PRIVATE packages ...)
# One static library a stage. USES are the stages to its left; packages stay private to it.
add_library(transillum_warnings INTERFACE)
target_compile_options(transillum_warnings INTERFACE
    -Wall -Wextra -Wconversion -Wno-sign-conversion
    $<$<BOOL:${TRANSILLUM_WERROR}>:-Werror>)

function(transillum_stage name)
    cmake_parse_arguments(STAGE "" "" "SOURCES;USES;PRIVATE" ${ARGN})
    add_library(transillum_${name} STATIC ${STAGE_SOURCES})
    add_library(transillum::${name} ALIAS transillum_${name})
    set_target_properties(transillum_${name} PROPERTIES EXPORT_NAME ${name}
        POSITION_INDEPENDENT_CODE ON)
    target_include_directories(transillum_${name}
        PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
        PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_compile_features(transillum_${name} PUBLIC cxx_std_20)
    # Contraction would make results depend on the processor's instruction set.
    target_compile_options(transillum_${name} PRIVATE -ffp-contract=off)
    target_link_libraries(transillum_${name} PUBLIC glm::glm)
    foreach(stage IN LISTS STAGE_USES)
        target_link_libraries(transillum_${name} PUBLIC transillum_${stage})
    endforeach()
    target_link_libraries(transillum_${name} PRIVATE $<BUILD_INTERFACE:transillum_warnings> ${STAGE_PRIVATE})
    install(TARGETS transillum_${name} EXPORT transillum ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()

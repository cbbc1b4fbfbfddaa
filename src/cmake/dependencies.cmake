# Every package the project uses. The installed package configuration includes this file too, so that
# the static libraries find what they need.
include(CMakeFindDependencyMacro)

find_dependency(glm)
find_dependency(TBB)
find_dependency(fmt)
find_dependency(spdlog)
find_dependency(CLI11)
find_dependency(nlohmann_json)
find_dependency(OpenImageIO)
find_dependency(embree 3)
find_dependency(CGAL)
find_dependency(VTK COMPONENTS CommonCore CommonDataModel IOXML)
# CGAL brings a module of the same name that does not know Debian's OpenMesh.
find_package(OpenMesh REQUIRED CONFIG)

# Debian's OpenImageIO names OpenCV's headers, which its package does not bring.
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "")

# Every package the project uses. The installed package configuration includes this file too, so that
# the static libraries find what they need. Debian's names: packages.txt.
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(embree 3 REQUIRED)
find_package(CGAL REQUIRED)
find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel IOXML)
# CGAL brings a module of the same name that does not know Debian's OpenMesh.
find_package(OpenMesh REQUIRED CONFIG)

# Debian's OpenImageIO names OpenCV's headers, which its package does not bring.
get_target_property(include_folders OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER include_folders EXCLUDE REGEX opencv)
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${include_folders}")
unset(include_folders)

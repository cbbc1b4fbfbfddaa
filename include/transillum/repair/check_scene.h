/// Counts and locates what is wrong with a scene's meshes. Changes nothing.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/base/parallel.h>
#include <transillum/repair/defects.h>
#include <transillum/repair/triangle_soup.h>

#include <string>
#include <vector>

namespace transillum {

struct CheckOptions {
    /// Over the scene's diagonal: of near vertices and T-junctions.
    double tolerance = usual_tolerance;
    double needle = 1e-4;      ///< height over longest edge, below which a face is a needle
    double thin_wall = 1e-4;   ///< thickness over the diagonal, below which a wall is thin
    double leak_width = 0.01;  ///< over the diagonal; wider ways out are openings, not leaks
    bool leaks = true;         ///< resolves intersections first, which takes the most time
};

/// Faces that hang together by edges of two faces.
struct Component {
    std::uint64_t faces = 0;
    std::uint32_t object = 0;  ///< of its first face
    bool closed = false;       ///< every edge has two faces
    bool orientable = true;
    double volume = 0.0;        ///< enclosed, negative when inside out; 0 unless closed
    std::uint64_t borders = 0;  ///< loops of border edges
};

/// A way from outside the scene to a luminaire or camera.
struct Leak {
    std::string from;                  ///< "luminaire 'lamp'", "camera 'front'"
    std::vector<glm::dvec3> path;      ///< from there to outside
    double length = 0.0, width = 0.0;  ///< [scene units]; width: of the narrowest gap it passes,
                                       ///< infinite where there is nothing beside it
    bool is_opening = false;           ///< wider than a leak
};

struct ObjectCounts {
    std::string name;
    std::uint64_t triangles = 0;
    DefectCounts counts{};  ///< a pair of two objects counts for both
};

struct CheckReport {
    std::uint64_t polygons = 0, triangles = 0, vertices = 0;
    double diagonal = 0.0;
    double tolerance = 0.0, thin_wall = 0.0;  ///< [scene units]
    DefectCounts counts{};
    std::vector<ObjectCounts> objects;  ///< as Scene::objects
    std::vector<Component> components;
    std::vector<Leak> leaks;
    bool leaks_searched = false;  ///< else there is nothing to start from, or no wish
    double thinnest_wall = 0.0;   ///< [scene units]; 0 without thin walls
    /// Every one, in the order of Defect, but for duplicate vertices and leaks.
    std::vector<DefectSite> sites;

    [[nodiscard]] bool is_sound() const;  ///< nothing harmful
};

/// Edges and non-manifold vertices are counted on all triangles that name three vertices, what else
/// needs sound faces on those that find_faulty_faces keeps, one side of walls of two materials.
/// Self and object intersections count pairs that pass through each other and pairs that only
/// touch, as a vertex on a face: both let light leak or patches straddle. Leaks: see CheckOptions;
/// where a scene is open anyway, its narrow gaps are not told. \throws InputError on a coordinate
/// that is no finite number or when there is no polygon.
[[nodiscard]] CheckReport check_scene(const Scene& scene, const CheckOptions& options,
                                      const Workers& workers, Monitor& monitor);

}  // namespace transillum

// How large the scene is, and how far from the origin.
#include "physics/stability/rooms.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace transillum::stability {

using namespace testing_support;

namespace {

void sphere_in_room(SceneBuilder& b, const RoomMaterials& m, std::uint64_t) {
    b.sphere({0.45, 0.55, 0.4}, 0.25, 12, Facing::outwards, m.solid);
}

/// Turned, so that no plane is parallel to an axis and no coordinate dyadic.
Scene placed_room(Lit lit, double scale, double shift) {
    Scene scene = room(0.8f, lit, sphere_in_room);
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3))));
    for (glm::dvec3& p : scene.positions) p = (turn * p + shift) * scale;
    return scene;
}

}  // namespace

std::vector<Condition> place_conditions() {
    struct Place {
        double scale, shift;  ///< in sizes of the room
    };
    std::vector<Condition> all;
    for (const Place& at :
         {Place{1e-6, 0}, Place{1e-3, 0}, Place{1e3, 0}, Place{1e6, 0}, Place{1, 1e3},
          Place{1, 1e6}, Place{1, -1e6}, Place{1e-6, 1e6}, Place{1e6, 1e6}})
        for (const Lit lit : {Lit::evenly, Lit::from_floor}) {
            Condition c{
                .name =
                    fmt::format("coordinates times {:.0e}, moved by {:.0e} sizes, lit {}", at.scale,
                                at.shift, lit == Lit::evenly ? "evenly" : "from the floor"),
                .scene = [=](std::uint64_t) { return placed_room(lit, at.scale, at.shift); },
                .options = few_patches(),
                .albedo = 0.8};
            if (lit == Lit::evenly) {
                c.closed_form = even_radiance();
                c.options.light.first_shot = FirstShot::off;
            }
            all.push_back(c);
        }
    return all;
}

}  // namespace transillum::stability

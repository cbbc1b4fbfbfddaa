#include "physics/stability/random_room.h"

#include <transillum/base/sampling.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace transillum::stability {

using namespace testing_support;

namespace {

class RandomRoom {
public:
    RandomRoom(std::uint64_t number, Lit lit) : random_(number, 11), lit_(lit) {}

    Scene make() {
        const glm::dvec3 size(between(1.0, 2.0), between(1.0, 2.0), between(1.0, 2.0));
        builder_.box({0, 0, 0}, size, Facing::inwards, material(Side::inside));
        builder_.scene.polygons[0].material = material(Side::floor);
        // What lies flush on walls may have its other side out there.
        const glm::dvec3 thickness(0.1);
        builder_.box(-thickness, size + thickness, Facing::inwards, material(Side::outmost));
        const int things = 2 + static_cast<int>(3.0 * random_.next());
        for (int i = 0; i < things; ++i) add_thing(size);
        const glm::dmat3 turn = frame();
        for (glm::dvec3& p : builder_.scene.positions) p = turn * p;
        return std::move(builder_.scene);
    }

private:
    enum class Side { inside, floor, outmost };

    double between(double low, double high) { return low + (high - low) * random_.next(); }
    glm::dmat3 frame() {
        const double u = random_.next();
        return frame_about(uniform_direction(u, random_.next()));
    }

    std::uint32_t material(Side side) {
        const auto albedo = [&] {
            return static_cast<float>(between(0.05, largest_random_albedo));
        };
        const Spectrum diffuse(albedo(), albedo(), albedo());
        const bool emits = side == Side::floor && lit_ == Lit::from_floor;
        const std::uint32_t m =
            builder_.material(diffuse, lit_ == Lit::evenly ? Spectrum(1.0f) - diffuse
                                                           : Spectrum(emits ? 1.0f : 0.0f));
        builder_.scene.materials[m].back_reflects = side != Side::outmost;
        builder_.scene.materials[m].back_emits = lit_ == Lit::evenly && side != Side::outmost;
        return m;
    }

    void add_thing(const glm::dvec3& size) {
        const std::size_t first = builder_.scene.positions.size();
        const std::uint32_t m = material(Side::inside);
        const double radius = between(0.1, 0.25);
        const int kind = static_cast<int>(4.0 * random_.next());
        // Its corners are within the radius times sqrt(3).
        const glm::dvec3 half(radius, between(0.2, 1.0) * radius, between(0.2, 1.0) * radius);
        if (kind == 0)
            builder_.sphere({0, 0, 0}, radius, 12, Facing::outwards, m);
        else if (kind == 1)
            builder_.polygon({{-half.x, -half.y, 0}, {half.x, -half.y, 0}, {0, half.y, half.z}}, m);
        else
            builder_.box(-half, half, Facing::outwards, m);
        const bool stands = kind == 3;
        const glm::dmat3 turn = stands ? glm::dmat3(1.0) : frame();
        const double reach = std::sqrt(3.0) * radius;
        glm::dvec3 at;
        for (int axis = 0; axis < 3; ++axis) at[axis] = between(reach, size[axis] - reach);
        if (stands) at.z = half.z;
        for (std::size_t i = first; i < builder_.scene.positions.size(); ++i)
            builder_.scene.positions[i] = at + turn * builder_.scene.positions[i];
    }

    Random random_;
    Lit lit_;
    SceneBuilder builder_;
};

}  // namespace

Scene random_room(std::uint64_t number, Lit lit) {
    return RandomRoom(number, lit).make();
}

std::vector<Condition> random_conditions() {
    std::vector<Condition> all;
    for (std::uint64_t number = 1; number <= 40; ++number)
        for (const Lit lit : {Lit::evenly, Lit::from_floor}) {
            Condition c{.name = fmt::format("random room {}, {}", number, name_of(lit)),
                        .scene = [=](std::uint64_t) { return random_room(number, lit); },
                        .options = few_patches(),
                        .albedo = largest_random_albedo,
                        .is_long = number > 5};
            // Enough for the first balance to tell about the smallest of the things.
            c.options.resolution = 300;
            if (lit == Lit::evenly) {
                c.closed_form = even_radiance();
                c.options.light.first_shot = FirstShot::off;
            }
            all.push_back(c);
            if (lit != Lit::evenly) continue;
            // Points stand for all of these lights: then radiance is even but about.
            c.name += ", a first shot";
            c.closed_form = {};
            c.options.light.first_shot = FirstShot::hemicube;
            all.push_back(c);
        }
    return all;
}

}  // namespace transillum::stability

// How much is reflected, how bright lights are, how large, and how sharp reflections.
#include "physics/stability/rooms.h"

#include <fmt/format.h>

#include <numbers>

namespace transillum::stability {

using namespace testing_support;

namespace {

Condition lit_room(std::string name, float albedo, Lit lit, const Filling& filling = {}) {
    Condition c{.name = std::move(name),
                .scene = [=](std::uint64_t seed) { return room(albedo, lit, filling, seed); },
                .options = few_patches(),
                .albedo = albedo};
    if (lit == Lit::evenly) c.closed_form = even_radiance();
    return c;
}

void add_albedos(std::vector<Condition>& to) {
    for (const float albedo : {0.5f, 0.9f, 0.99f, 0.999f}) {
        const std::string name = fmt::format("albedo {}", albedo);
        to.push_back(lit_room(name + ", lit evenly", albedo, Lit::evenly));
        to.push_back(lit_room(name + ", lit from the floor", albedo, Lit::from_floor));
    }
}

void scale_emission(Scene& scene, float factor) {
    for (Material& m : scene.materials) m.emission *= factor;
}

void add_emissions(std::vector<Condition>& to) {
    for (const float emission : {1e-30f, 1e-15f, 1e15f, 1e30f}) {
        const auto bright = [=](Lit lit) {
            return [=](std::uint64_t) {
                Scene scene = room(0.9f, lit);
                scale_emission(scene, emission);
                return scene;
            };
        };
        Condition even =
            lit_room(fmt::format("emission {:.0e}, lit evenly", emission), 0.9f, Lit::evenly);
        even.scene = bright(Lit::evenly);
        even.closed_form = even_radiance(double{emission});
        to.push_back(even);
        for (const FirstShot shot : {FirstShot::off, FirstShot::hemicube}) {
            Condition floor = lit_room(fmt::format("emission {:.0e}, {} first shot", emission,
                                                   shot == FirstShot::off ? "no" : "a"),
                                       0.9f, Lit::from_floor);
            floor.scene = bright(Lit::from_floor);
            floor.options.light.first_shot = shot;
            to.push_back(floor);
        }
    }
}

/// Not a power of two, as steps of radiance are.
constexpr float dim_radiance = 0.7f;

/// Two sealed rooms beside each other, each lit evenly; the first is brighter.
Scene unlike_rooms(float ratio) {
    SceneBuilder b;
    constexpr float albedo = 0.5f;
    const auto walls = [&](float radiance) {
        const std::uint32_t m = b.material(Spectrum(albedo), Spectrum((1.0f - albedo) * radiance));
        b.scene.materials[m].back_reflects = false;
        return m;
    };
    b.box({0, 0, 0}, {1, 1, 1}, Facing::inwards, walls(ratio));
    b.box({1.25, 0, 0}, {2.25, 1, 1}, Facing::inwards, walls(dim_radiance));
    return b.scene;
}

/// Of means over either room: what is far below the brightest is rounded, at random.
double deviation_of_rooms(const Solution& s, double ratio) {
    double sum[2]{}, area[2]{};
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        if (!s.emits(p)) continue;
        const std::uint32_t leaf = s.patches.leaf_of_patch(p);
        const int which = leaf_centre(s.surface, s.patches, leaf).x < 1.1 ? 0 : 1;
        const double a = area_of_leaf(s.surface, s.patches, leaf);
        sum[which] += a * (s.emission(p) + s.direct_radiance(p) + s.finite_element_radiance(p)).x;
        area[which] += a;
    }
    const double bright = sum[0] / area[0] / ratio - 1.0,
                 dim = sum[1] / area[1] / double{dim_radiance} - 1.0;
    return std::abs(bright) > std::abs(dim) ? bright : dim;
}

/// The same, but all of the dim room's walls are black; its floor and its ceiling emit unlike.
constexpr float floor_share = 0.8f, ceiling_share = 0.3f;
Scene bright_and_black_room(float ratio) {
    Scene scene = unlike_rooms(ratio);
    const auto add = [&](float radiance) {
        scene.materials.push_back(scene.materials.back());
        scene.materials.back().diffuse = Spectrum(0.0f);
        scene.materials.back().emission = Spectrum(radiance * dim_radiance);
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    };
    constexpr std::size_t sides = 6;
    const std::uint32_t dark = add(0.0f);
    for (std::size_t side = sides; side < 2 * sides; ++side) scene.polygons[side].material = dark;
    scene.polygons[sides].material = add(floor_share);
    scene.polygons[sides + 1].material = add(ceiling_share);
    return scene;
}

/// Of the light on the dim room's floor, which sees its ceiling alone, and on its ceiling.
double deviation_of_black_room(const Solution& s) {
    constexpr double of_opposite = 0.1998249;  // form factor (validation C)
    double flux[2]{};
    for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
        const std::uint32_t leaf = s.patches.leaf_of_patch(p);
        const glm::dvec3 at = leaf_centre(s.surface, s.patches, leaf);
        if (at.x < 1.1 || !s.emits(p)) continue;
        flux[at.z > 0.5 ? 1 : 0] +=
            area_of_leaf(s.surface, s.patches, leaf) * double{s.indirect_irradiance[p].x};
    }
    const double unit = of_opposite * std::numbers::pi * double{dim_radiance};
    const double floor = flux[0] / (unit * double{ceiling_share}) - 1.0;
    const double ceiling = flux[1] / (unit * double{floor_share}) - 1.0;
    return std::abs(floor) > std::abs(ceiling) ? floor : ceiling;
}

/// Both in one room, on the floor and the ceiling.
Scene two_lights(float ratio) {
    Scene scene = room(0.5f, Lit::from_floor);
    scene.materials.push_back(scene.materials[scene.polygons[0].material]);
    scene.materials.back().emission *= ratio;
    scene.polygons[1].material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    return scene;
}

void add_ratios(std::vector<Condition>& to) {
    for (const float ratio : {1e6f, 1e12f}) {
        to.push_back({.name = fmt::format("lights of 1 to {:.0e} in one room", ratio),
                      .scene = [=](std::uint64_t) { return two_lights(ratio); },
                      .options = few_patches()});
        to.push_back(
            {.name = fmt::format("lights of 1 to {:.0e} in sealed rooms", ratio),
             .scene = [=](std::uint64_t) { return unlike_rooms(ratio); },
             .options = few_patches(),
             .closed_form = {
                 [=](const Solution& s) { return deviation_of_rooms(s, double{ratio}); }, true}});
        to.push_back({.name = fmt::format("lights of 1 to {:.0e}, the dim room black", ratio),
                      .scene = [=](std::uint64_t) { return bright_and_black_room(ratio); },
                      .options = few_patches(),
                      .closed_form = {deviation_of_black_room, true}});
    }
}

/// A room whose ceiling is divided at `low` and `high` along both axes; the middle, and `others`
/// of its six sides, emit.
Scene divided_ceiling(double low, double high, std::initializer_list<int> others) {
    Scene plain = room(0.8f, Lit::from_floor);
    SceneBuilder b;
    b.scene = plain;
    const std::uint32_t lamp = plain.polygons[0].material, wall = plain.polygons[2].material;
    b.scene.polygons[0].material = wall;
    for (const int side : others) b.scene.polygons[static_cast<std::size_t>(side)].material = lamp;
    b.scene.polygons.erase(b.scene.polygons.begin() + 1);
    const double at[] = {0.0, low, high, 1.0};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            if (at[i] == at[i + 1] || at[j] == at[j + 1]) continue;
            b.polygon({{at[i], at[j], 1},
                       {at[i], at[j + 1], 1},
                       {at[i + 1], at[j + 1], 1},
                       {at[i + 1], at[j], 1}},
                      i == 1 && j == 1 ? lamp : wall);
        }
    return b.scene;
}

void add_sizes(std::vector<Condition>& to) {
    struct Size {
        const char* share;
        double low, high;
        std::initializer_list<int> others;
    };
    // 6 m^2 in all: 2.449 mm square; five sides and 0.4 of the sixth.
    static const Size sizes[] = {{"1e-6", 0.5 - 1.2247e-3, 0.5 + 1.2247e-3, {}},
                                 {"0.9", 0.0, 0.632456, {0, 2, 3, 4, 5}}};
    for (const Size& size : sizes)
        for (const FirstShot shot : {FirstShot::automatic, FirstShot::off}) {
            Condition c{.name = fmt::format("light of {} of the room's area, first shot {}",
                                            size.share, shot == FirstShot::off ? "off" : "auto"),
                        .scene =
                            [&size](std::uint64_t) {
                                return divided_ceiling(size.low, size.high, size.others);
                            },
                        .options = few_patches(),
                        .albedo = 0.8};
            c.options.light.first_shot = shot;
            // Else the small one is met too seldom to say what it sends.
            if (size.others.size() == 0) c.options.resolution = 400;
            to.push_back(c);
        }
}

void make_glossy(Scene& scene, Lobe lobe, float shininess, float roughness) {
    for (Material& m : scene.materials) {
        m.diffuse = Spectrum(0.3f);
        m.specular = Spectrum(0.5f);
        m.lobe = lobe;
        m.shininess = shininess;
        m.roughness = roughness;
    }
}

void add_lobes(std::vector<Condition>& to) {
    const auto add = [&](std::string name, Lobe lobe, float shininess, float roughness,
                         FirstShot shot) {
        Condition c{.name = name + (shot == FirstShot::off ? "" : ", a first shot"),
                    .scene =
                        [=](std::uint64_t) {
                            Scene scene = room(0.8f, Lit::from_floor);
                            make_glossy(scene, lobe, shininess, roughness);
                            return scene;
                        },
                    .options = few_patches(),
                    .albedo = 0.8};
        c.options.subdivision.leaf_target = 500;
        c.options.light.first_shot = shot;
        to.push_back(c);
    };
    for (const float exponent : {1.0f, 10.0f, 100.0f, 1e3f, 1e4f, 1e5f})
        for (const FirstShot shot : {FirstShot::off, FirstShot::hemicube})
            add(fmt::format("max-Phong exponent {:g}", exponent), Lobe::max_phong, exponent, 1.0f,
                shot);
    for (const float roughness : {0.0f, 1.0f})
        add(fmt::format("GGX roughness {:g}", roughness), Lobe::ggx, 0.0f, roughness,
            FirstShot::off);
}

void add_channels(std::vector<Condition>& to) {
    Condition c{.name = "a zero channel of emission, one of albedo",
                .scene =
                    [](std::uint64_t) {
                        Scene scene = room(0.9f, Lit::from_floor);
                        for (Material& m : scene.materials) {
                            m.emission *= Spectrum(1.0f, 0.0f, 0.5f);
                            m.diffuse.z = 0.0f;
                        }
                        return scene;
                    },
                .options = few_patches()};
    c.closed_form.error = [](const Solution& s) {
        float most = 0.0f;
        for (std::uint32_t p = 0; p < s.patches.patch_count(); ++p) {
            const Spectrum reflected = s.direct_radiance(p) + s.finite_element_radiance(p);
            most = std::max({most, reflected.y, reflected.z, s.indirect_irradiance[p].y});
        }
        return double{most};
    };
    to.push_back(c);
}

}  // namespace

std::vector<Condition> light_conditions() {
    std::vector<Condition> all;
    add_albedos(all);
    add_emissions(all);
    add_ratios(all);
    add_sizes(all);
    add_lobes(all);
    add_channels(all);
    return all;
}

}  // namespace transillum::stability

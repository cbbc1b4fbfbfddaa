#include "support/decision_cases.h"

#include "support/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace transillum::testing_support {

namespace {

class Cases {
public:
    explicit Cases(const DecisionSize& size) : size_(size) {
        bake_.subdivision.leaf_target = size.leaves;
        bake_.iteration.iterations = size.directions;
        bake_.light.first_shot = FirstShot::off;
        bake_.hemicube_resolution = 128;
        // Rooms made of the same leaves see the same pixels.
        bake_.resolution = 300;
    }

    std::vector<DecisionCase> take() && {
        add(
            "diffuse only", "one direction bin a patch", bright_room(),
            [](DecisionCase& c) {
                for (Material& m : c.forced_scene.materials) {
                    m.lobe = Lobe::max_phong;
                    m.specular = Spectrum(1e-6f);
                    m.shininess = 20.0f;
                }
                c.forced_options.bins.level = 3;
            },
            1e-4);
        add("no small emitter", "no first shot", bright_room(), [](DecisionCase& c) {
            c.options.light.first_shot = FirstShot::automatic;
            c.forced_options.light.first_shot = FirstShot::hemicube;
            c.forced_options.light.samples = 256;
            // Close to the ceiling the points that stand for it can be told apart.
            c.means_alone = true;
        });
        add("closed", "no environment", bright_room(), [](DecisionCase& c) {
            Environment& sky = c.forced_scene.lighting.environment;
            sky.kind = Environment::Kind::uniform;
            sky.radiance_scale = Spectrum(0.5f);
        });
        add("black backs", "for the energy balance alone", bright_room(), [](DecisionCase& c) {
            for (Scene* const scene : {&c.scene, &c.forced_scene})
                for (Material& m : scene->materials) {
                    m.lobe = Lobe::max_phong;
                    m.specular = Spectrum(0.2f);
                    m.shininess = 5.0f;
                    m.back_reflects = scene != &c.scene;
                }
        });
        add("converged", "the error asked for is met", bright_room(), [](DecisionCase& c) {
            c.options.iteration.iterations = c.forced_options.iteration.iterations = 1024;
            c.options.iteration.target_error = 0.05;
        });
        add(
            "even light", "refined", even_room(),
            [](DecisionCase& c) {
                c.options.refinement.phases = 1;
                c.options.iteration.iterations = c.forced_options.iteration.iterations =
                    std::max<std::uint64_t>(256, c.options.iteration.iterations);
                c.forced_options.subdivision.leaf_target *= 4;
                c.means_alone = true;
            },
            1e-5);
        add("dark rooms", "left out of the transport", one_lit_room_of(4),
            [](DecisionCase& c) { c.forced_options.dark_rooms = DarkRooms::keep; });
        add("nothing to repair", "it would find nothing to do", bright_room(),
            [](DecisionCase& c) { c.forced_options.repair.level = RepairLevel::off; });
        add(
            "no texture", "no texture is averaged", bright_room(),
            [](DecisionCase& c) { paper(c.forced_scene); }, 1e-6);
        add("pixels from the leaves", "three a leaf's edge", bright_room(),
            [many_pixels = size_.many_pixels](DecisionCase& c) {
                c.options.resolution = 0;
                c.forced_options.resolution = many_pixels;
            });
        add("negligible residual", "below the error to be expected", bright_room(),
            [](DecisionCase& c) {
                c.options.iteration.iterations = c.forced_options.iteration.iterations =
                    std::max<std::uint64_t>(size_of_residual, c.options.iteration.iterations);
                c.options.iteration.monte_carlo = MonteCarlo::automatic;
                c.forced_options.iteration.monte_carlo = MonteCarlo::subpatch;
            });
        add(
            "nothing reflects", "no iteration", bright_room(),
            [](DecisionCase& c) {
                for (BakeOptions* const o : {&c.options, &c.forced_options}) {
                    o->light.first_shot = FirstShot::hemicube;
                    o->light.samples = 4;
                }
                for (Material& m : c.scene.materials) m.diffuse = Spectrum(0.0f);
                for (Material& m : c.forced_scene.materials) m.diffuse = Spectrum(1e-12f);
            },
            1e-6);
        return std::move(cases_);
    }

private:
    static constexpr std::uint64_t size_of_residual = 512;

    void add(const char* name, const char* told, const Scene& scene,
             const std::function<void(DecisionCase&)>& force, double tolerance = 0.0) {
        DecisionCase c{name, told, scene, scene, bake_, bake_, false, tolerance};
        force(c);
        cases_.push_back(std::move(c));
    }

    void furnish(SceneBuilder& b, const glm::dvec3& corner, std::uint32_t walls,
                 std::uint32_t ceiling) const {
        const auto first = b.scene.polygons.size();
        b.box(corner, corner + 1.0, Facing::inwards, walls);
        b.scene.polygons[first + 1].material = ceiling;
        const int n = size_.spheres;
        for (int i = 0; i < n * n * n; ++i) {
            const glm::dvec3 cell(i % n, i / n % n, i / n / n);
            b.sphere(corner + (cell + 0.5) / double(n), 0.35 / n, size_.meridians, Facing::outwards,
                     walls);
        }
    }
    /// The ceiling shines.
    [[nodiscard]] Scene bright_room() const {
        SceneBuilder b;
        const std::uint32_t grey = b.material(Spectrum(0.6f));
        furnish(b, glm::dvec3(0.0), grey, b.material(Spectrum(0.6f), Spectrum(1.0f)));
        return b.scene;
    }
    /// In a row, sealed off from each other.
    [[nodiscard]] Scene one_lit_room_of(int rooms) const {
        SceneBuilder b;
        const std::uint32_t grey = b.material(Spectrum(0.6f));
        const std::uint32_t lamp = b.material(Spectrum(0.6f), Spectrum(1.0f));
        for (int i = 0; i < rooms; ++i)
            furnish(b, glm::dvec3(1.25 * i, 0.0, 0.0), grey, i == 0 ? lamp : grey);
        return b.scene;
    }
    /// The same radiance everywhere.
    [[nodiscard]] Scene even_room() const {
        SceneBuilder b;
        const std::uint32_t all = b.material(Spectrum(0.5f), Spectrum(0.5f));
        furnish(b, glm::dvec3(0.0), all, all);
        return b.scene;
    }
    /// Papers all that reflects with an image of its colour.
    static void paper(Scene& scene) {
        for (Material& m : scene.materials) {
            auto image = std::make_shared<Texture>();
            image->width = image->height = 4;
            image->texels.assign(16, m.diffuse);
            image->build_levels();
            m.textures.diffuse = static_cast<std::int32_t>(scene.textures.size());
            scene.textures.push_back(image);
        }
        for (std::size_t i = 0; i < scene.corners.size(); ++i)
            scene.uvs.emplace_back(i % 4 / 2, (i + 1) % 4 / 2);
    }

    DecisionSize size_;
    BakeOptions bake_;
    std::vector<DecisionCase> cases_;
};

}  // namespace

std::vector<DecisionCase> decision_cases(const DecisionSize& size) {
    return Cases(size).take();
}

bool tells(const Solution& solution, const std::string& text) {
    return std::ranges::any_of(solution.decisions, [&](const Decision& d) {
        return (d.what + ": " + d.why).find(text) != std::string::npos;
    });
}

double FrontField::mean() const {
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += areas[i] * values[i];
        area += areas[i];
    }
    return sum / area;
}

FrontField fronts_of(const Solution& s) {
    FrontField field;
    for (std::uint32_t leaf = 0; leaf < s.patches.leaf_count; ++leaf) {
        field.values.push_back(luminance(s.direct_irradiance[leaf]) +
                               luminance(s.indirect_irradiance[leaf]));
        field.areas.push_back(area_of_leaf(s.surface, s.patches, leaf));
    }
    field.relative_error = s.relative_error;
    return field;
}

double relative_rms(const FrontField& a, const FrontField& b) {
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < b.values.size(); ++i) {
        sum += b.areas[i] * std::pow(a.values[i] - b.values[i], 2.0);
        area += b.areas[i];
    }
    return std::sqrt(sum / area) / b.mean();
}

}  // namespace transillum::testing_support

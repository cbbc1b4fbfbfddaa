#include <transillum/base/sampling.h>
#include <transillum/scene/brdf.h>

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

namespace transillum {

namespace {

constexpr double pi = std::numbers::pi;
/// What brdf.h promises of the tables.
constexpr double table_error = 1e-3, table_error_at_grazing = 4e-3;

struct Case {
    std::string name;
    Brdf brdf;
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

Brdf lambert(float diffuse) {
    return {.diffuse = Spectrum(diffuse)};
}
Brdf max_phong(float diffuse, float specular, float shininess) {
    return {.diffuse = Spectrum(diffuse),
            .specular = Spectrum(specular),
            .lobe = Lobe::max_phong,
            .shininess = shininess};
}
Brdf ggx(float diffuse, float specular, float alpha) {
    return {.diffuse = Spectrum(diffuse),
            .specular = Spectrum(specular),
            .lobe = Lobe::ggx,
            .alpha = alpha};
}

/// All reflect as much as is admissible.
std::vector<Case> blunt_cases() {
    return {{"Lambert", lambert(1.0f)},
            {"MaxPhong1", max_phong(0.0f, 1.0f, 1.0f)},
            {"MaxPhong3", max_phong(0.25f, 0.75f, 3.0f)},
            {"MaxPhong10", max_phong(0.5f, 0.5f, 10.0f)},
            {"MaxPhong60", max_phong(0.0f, 1.0f, 60.0f)},
            {"Plaster", ggx(1.0f, 0.04f, 1.0f)},
            {"Plastic", ggx(1.0f, 0.04f, 0.2f)},
            {"Pearl", ggx(1.0f, 0.5f, 0.3f)},
            {"RoughMetal", ggx(0.0f, 1.0f, 0.5f)}};
}
std::vector<Case> all_cases() {
    std::vector<Case> cases = blunt_cases();
    cases.push_back({"MaxPhong1000", max_phong(0.5f, 0.5f, 1000.0f)});
    cases.push_back({"MaxPhong100000", max_phong(0.5f, 0.5f, 1e5f)});
    cases.push_back({"Gloss", ggx(1.0f, 0.04f, 0.01f)});
    cases.push_back({"Mirror", ggx(0.0f, 1.0f, least_alpha)});
    cases.push_back({"Tinted", {{0.1f, 0.5f, 1.0f}, {0.9f, 0.2f, 0.0f}, Lobe::ggx, 1.0f, 0.1f}});
    return cases;
}
std::string name_of(const testing::TestParamInfo<Case>& info) {
    return info.param.name;
}

class BluntBrdf : public testing::TestWithParam<Case> {};
class AnyBrdf : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Brdf, BluntBrdf, testing::ValuesIn(blunt_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(Brdf, AnyBrdf, testing::ValuesIn(all_cases()), name_of);

glm::vec3 direction(double cosine, double phi = 0.0) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
            static_cast<float>(cosine)};
}

/// Midpoint rule over the half of [c0, c1] x [0, pi] of the hemisphere; `value` is even in phi.
template <class Value>
double integral(double c0, double c1, double phi0, double phi1, int steps, Value value) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j)
            sum += value(direction(c0 + (c1 - c0) * (i + 0.5) / steps,
                                   phi0 + (phi1 - phi0) * (j + 0.5) / steps));
    return sum * (c1 - c0) * (phi1 - phi0) / (steps * steps);
}
double integrated_albedo(const Brdf& brdf, double cosine, bool lobe_alone = false) {
    const glm::vec3 out = direction(cosine);
    return 2.0 * integral(0.0, 1.0, 0.0, pi, 600, [&](const glm::vec3& in) {
               return (lobe_alone ? evaluate_lobe(brdf, in, out) : evaluate(brdf, in, out)).x *
                      in.z;
           });
}

constexpr double angles[] = {1.0, 0.95, 0.8, 0.5, 0.2, 0.05};

TEST(MaxPhong, HasTheAlbedosOfItsClosedForms) {
    for (const float n : {1.0f, 3.0f, 10.0f, 100.0f, 1e4f}) {
        const double ks = (n + 2.0) / (2.0 * pi);
        const Brdf brdf = max_phong(0.0f, 1.0f, n);
        EXPECT_NEAR(directional_albedo(brdf, 1.0f).x, 2.0 * pi * ks / (n + 2.0), 1e-4) << n;
        EXPECT_NEAR(directional_albedo(brdf, 0.0f).x, pi * ks / (n + 1.0), table_error) << n;
    }
    EXPECT_NEAR(lobe_albedo(max_phong(0.2f, 0.3f, 3.0f), 0.5f).x, 0.3 * 1.03983 * 5.0 / (2.0 * pi),
                table_error);
    EXPECT_NEAR(lobe_albedo(max_phong(0.2f, 0.3f, 10.0f), 0.5f).x,
                0.3 * 0.43955 * 12.0 / (2.0 * pi), table_error);
}

TEST(MaxPhong, HasTheValueItIsDefinedBy) {
    const Brdf brdf = max_phong(0.0f, 0.6f, 3.0f);
    const glm::vec3 out = direction(0.8), in = direction(0.5, 2.0);
    const double cosine = glm::dot(in, glm::vec3(-out.x, -out.y, out.z));
    EXPECT_NEAR(evaluate_lobe(brdf, in, out).x,
                0.6 * 5.0 / (2.0 * pi) * std::pow(cosine, 3.0) / 0.8, 1e-6);
    // beyond a right angle from the mirror direction
    EXPECT_EQ(evaluate_lobe(brdf, direction(0.1), direction(0.1)), Spectrum(0.0f));
}

TEST(Ggx, ReflectsAlongTheNormalWhatItsClosedFormSays) {
    // alpha = 1: D = 1 / pi, and the integral of D V F cos over the hemisphere is 1 - ln 2.
    EXPECT_NEAR(lobe_albedo(ggx(0.0f, 1.0f, 1.0f), 1.0f).x, 1.0 - std::log(2.0), table_error);
    // Mirror direction of a smooth surface: Schlick's term.
    for (const double c : {1.0, 0.7, 0.4, 0.1})
        EXPECT_NEAR(lobe_albedo(ggx(0.0f, 0.04f, least_alpha), static_cast<float>(c)).x,
                    0.04 + 0.96 * std::pow(1.0 - c, 5.0), table_error);
}

TEST_P(AnyBrdf, OfManyDirectionsIsThatOfEach) {
    const Brdf& brdf = GetParam().brdf;
    std::vector<glm::vec3> in;
    for (int i = 0; i < 200; ++i)
        in.push_back(glm::normalize(glm::dvec3(std::cos(i), std::sin(2 * i), 0.01 * i - 0.1)));
    for (const glm::vec3 out : {glm::vec3(0, 0, 1), glm::vec3(0.6, 0, 0.8), glm::vec3(1, 0, 0)}) {
        in.front() = {-out.x, -out.y, out.z};
        std::vector<Spectrum> values(in.size(), Spectrum(-1.0f));
        evaluate(brdf, in, out, values);
        for (std::size_t i = 0; i < in.size(); ++i) {
            const Spectrum each = evaluate(brdf, in[i], out);
            for (int c = 0; c < channel_count; ++c)
                ASSERT_NEAR(values[i][c], each[c], 4 * 0x1p-24f * each[c]);
        }
    }
}

TEST_P(AnyBrdf, IsReciprocal) {
    Random random(1, 0);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 a = cosine_direction(random.next(), random.next());
        const glm::vec3 b = i % 2 ? glm::vec3(cosine_direction(random.next(), random.next()))
                                  : sample_direction(GetParam().brdf, a, 0.0f,
                                                     {static_cast<float>(random.next()),
                                                      static_cast<float>(random.next())});
        const Spectrum ab = evaluate(GetParam().brdf, a, b), ba = evaluate(GetParam().brdf, b, a);
        for (int c = 0; c < channel_count; ++c)
            ASSERT_NEAR(ab[c], ba[c], 1e-5f * (1.0f + ab[c])) << i;
    }
}

TEST_P(BluntBrdf, TabledAlbedoIsTheIntegralAndNeverAboveOne) {
    const Brdf& brdf = GetParam().brdf;
    for (const double cosine : angles) {
        const double whole = integrated_albedo(brdf, cosine);
        EXPECT_LE(whole, 1.0 + 4e-4) << cosine;  // 3e-4 of it the bluntest max-Phong lobe's
        EXPECT_NEAR(directional_albedo(brdf, static_cast<float>(cosine)).x, whole, table_error)
            << cosine;
        EXPECT_NEAR(lobe_albedo(brdf, static_cast<float>(cosine)).x,
                    integrated_albedo(brdf, cosine, true), table_error)
            << cosine;
    }
}

/// What a table says is never above 1, at any angle.
TEST_P(AnyBrdf, ReflectsNoMoreThanComesIn) {
    for (int i = 0; i <= 1000; ++i)
        ASSERT_LE(max_channel(directional_albedo(GetParam().brdf, static_cast<float>(i) / 1000.0f)),
                  1.0f + 4e-4f)
            << i;
}

/// The means of values over densities are the albedos, channel by channel, for sharp lobes too.
TEST_P(AnyBrdf, SamplesReflectTheDirectionalAlbedo) {
    const Brdf& brdf = GetParam().brdf;
    constexpr int count = 1 << 16;
    for (const double cosine : {1.0, 0.8, 0.5, 0.2, 0.05, 0.005}) {
        const glm::vec3 out = direction(cosine, 1.0);
        glm::dvec3 sum(0.0), squares(0.0);
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec2 u(sobol_owen(i, 0, 1), sobol_owen(i, 1, 1));
            const glm::vec3 in =
                sample_direction(brdf, out, static_cast<float>(sobol_owen(i, 2, 1)), u);
            ASSERT_NEAR(glm::length(in), 1.0f, 1e-5f);
            const float density = direction_density(brdf, in, out);
            if (!(in.z > 1e-6f)) {
                ASSERT_EQ(density, 0.0f);
                continue;
            }
            ASSERT_GT(density, 0.0f);
            const glm::dvec3 value(evaluate(brdf, in, out) * (in.z / density));
            sum += value;
            squares += value * value;
        }
        const glm::dvec3 mean = sum / double(count);
        const Spectrum expected = directional_albedo(brdf, static_cast<float>(cosine));
        for (int c = 0; c < channel_count; ++c) {
            const double error =
                std::sqrt(std::max(0.0, squares[c] / count - mean[c] * mean[c]) / count);
            EXPECT_NEAR(mean[c], expected[c],
                        4.0 * error + (cosine < 0.02 ? table_error_at_grazing : table_error))
                << "cosine " << cosine << " channel " << c;
            EXPECT_LE(mean[c], 1.0 + 4e-4 + 4.0 * error) << cosine;
        }
    }
}

/// Pearson's chi-squared over 8 x 16 cells of the hemisphere and what is below it, at 5 sigma.
TEST_P(BluntBrdf, SamplesFollowTheirDensity) {
    const Brdf& brdf = GetParam().brdf;
    constexpr int rows = 8, columns = 16, count = 200000;
    for (const double cosine : {0.9, 0.4, 0.1}) {
        const glm::vec3 out = direction(cosine);
        std::vector<int> found(rows * columns + 1);
        Random random(7, 0);
        const auto next = [&random] { return static_cast<float>(random.next()); };
        for (int i = 0; i < count; ++i) {
            const float choice = next(), u = next(), v = next();
            const glm::vec3 in = sample_direction(brdf, out, choice, {u, v});
            if (in.z <= 1e-6f) {
                ++found.back();
                continue;
            }
            const double phi = std::atan2(in.y, in.x) + pi;
            const int row = std::min(rows - 1, static_cast<int>(in.z * rows));
            const int column = std::min(columns - 1, static_cast<int>(phi / (2.0 * pi) * columns));
            ++found[row * columns + column];
        }
        double chi2 = 0.0, above = 0.0;
        int cells = 0;
        const auto compare = [&](double expected, int number) {
            if (expected < 5.0) return;
            chi2 += (number - expected) * (number - expected) / expected;
            ++cells;
        };
        for (int i = 0; i < rows * columns; ++i) {
            const int row = i / columns, column = i % columns;
            const double share =
                integral(double(row) / rows, double(row + 1) / rows,
                         2.0 * pi * column / columns - pi, 2.0 * pi * (column + 1) / columns - pi,
                         64, [&](const glm::vec3& in) { return direction_density(brdf, in, out); });
            above += share;
            compare(share * count, found[i]);
        }
        EXPECT_LE(above, 1.0 + 1e-3) << cosine;
        if (brdf.lobe != Lobe::ggx) {
            EXPECT_NEAR(above, 1.0, 1e-3) << cosine;
        }
        compare((1.0 - above) * count, found.back());
        EXPECT_LT(chi2, cells + 5.0 * std::sqrt(2.0 * cells)) << cosine << ' ' << cells;
    }
}

TEST_P(AnyBrdf, MeansAreThoseOfTheAngles) {
    const Brdf& brdf = GetParam().brdf;
    constexpr int steps = 20000;
    glm::dvec3 albedo(0.0);
    double coupling = 0.0;
    for (int i = 0; i < steps; ++i) {
        const auto cosine = static_cast<float>(std::sqrt((i + 0.5) / steps));
        albedo += glm::dvec3(directional_albedo(brdf, cosine)) / double(steps);
        coupling += diffuse_coupling(brdf, cosine) / double(steps);
    }
    if (max_channel(brdf.diffuse) > 0.0f) {
        EXPECT_NEAR(mean_diffuse_coupling(brdf), coupling, 3e-4);
    }
    for (int c = 0; c < channel_count; ++c) EXPECT_NEAR(mean_albedo(brdf)[c], albedo[c], 3e-4) << c;
}

/// Coupled diffuse light: what one angle reflects in all is what the coupling there leaves.
TEST_P(BluntBrdf, DiffusePartReflectsWhatTheLobeLeaves) {
    const Brdf& brdf = GetParam().brdf;
    for (const double cosine : angles) {
        const double diffuse =
            integrated_albedo(brdf, cosine) - integrated_albedo(brdf, cosine, true);
        EXPECT_NEAR(diffuse, brdf.diffuse.x * diffuse_coupling(brdf, static_cast<float>(cosine)),
                    3e-4)
            << cosine;
        if (brdf.lobe != Lobe::ggx) {
            EXPECT_NEAR(diffuse, brdf.diffuse.x, 1e-4);
        }
    }
}

TEST_P(AnyBrdf, IsFiniteAtTheHorizonAndZeroBelowIt) {
    const Brdf& brdf = GetParam().brdf;
    std::vector<glm::vec3> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}};
    for (const float z : {1e-30f, 1e-7f, 1.1e-6f, 1e-4f, -1e-4f})
        for (const float x : {1.0f, -1.0f})
            directions.push_back(glm::normalize(glm::vec3(x, 0, z)));
    for (const glm::vec3& in : directions)
        for (const glm::vec3& out : directions) {
            const Spectrum value = evaluate(brdf, in, out);
            const float density = direction_density(brdf, in, out);
            EXPECT_TRUE(is_finite(value) && value.x >= 0.0f && std::isfinite(density));
            if (in.z <= 0.0f || out.z <= 0.0f) {
                EXPECT_EQ(value, Spectrum(0.0f));
                EXPECT_EQ(evaluate_lobe(brdf, in, out), Spectrum(0.0f));
                EXPECT_EQ(density, 0.0f);
            }
        }
    for (const glm::vec3& out : directions)
        for (const float u : {0.0f, 0.5f, 1.0f - 0x1p-24f})
            for (const float v : {0.0f, 0.3f, 1.0f - 0x1p-24f})
                for (const float choice : {0.0f, 1.0f - 0x1p-24f})
                    EXPECT_TRUE(is_finite(sample_direction(brdf, out, choice, {u, v})));
}

TEST(BrdfOf, TakesWhatTheMaterialSays) {
    Material m;
    m.diffuse = Spectrum(0.3f);
    m.specular = Spectrum(0.2f);
    m.shininess = 12.0f;
    m.roughness = 0.5f;
    EXPECT_EQ(brdf_of(m).specular, Spectrum(0.0f));
    m.lobe = Lobe::max_phong;
    EXPECT_EQ(brdf_of(m).shininess, 12.0f);
    EXPECT_EQ(brdf_of(m).specular, m.specular);
    m.shininess = 0.0f;
    EXPECT_EQ(brdf_of(m).shininess, least_shininess);
    m.lobe = Lobe::ggx;
    EXPECT_EQ(brdf_of(m).alpha, 0.25f);
    m.roughness = 0.0f;
    EXPECT_EQ(brdf_of(m).alpha, least_alpha);
    m.specular = Spectrum(0.0f);
    EXPECT_EQ(brdf_of(m).lobe, Lobe::none);
}

}  // namespace

}  // namespace transillum

#include <transillum/scene/environment.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace transillum {
namespace {

constexpr double pi = std::numbers::pi;

Environment sky(Environment::Kind kind, const glm::dvec3& up = {0, 1, 0}) {
    Environment e;
    e.kind = kind;
    e.up = up;
    return e;
}

Environment lat_long(int width, int height) {
    Environment e = sky(Environment::Kind::image);
    auto image = std::make_shared<Texture>();
    image->width = width;
    image->height = height;
    image->texels.resize(static_cast<std::size_t>(width) * height, Spectrum(0.0f));
    e.image = image;
    return e;
}

/// With a texel of 1 at a column of the middle rows.
Environment lit_column(int column) {
    Environment e = lat_long(8, 4);
    auto image = std::make_shared<Texture>(*e.image);
    for (const int row : {1, 2}) image->texels[row * 8 + column] = Spectrum(1.0f);
    e.image = image;
    return e;
}

/// Irradiance of a surface by the midpoint rule over the sphere, its pole at the zenith.
double irradiance(const Environment& e, const glm::dvec3& normal, int steps = 512) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const double elevation = pi / 2.0 - pi * (i + 0.5) / steps;
            const glm::dvec3 d = sky_direction(e.up, pi * (j + 0.5) / steps, elevation);
            sum +=
                double{e.radiance(d).x} * std::max(0.0, glm::dot(d, normal)) * std::cos(elevation);
        }
    return sum * pi * pi / steps / steps;
}

TEST(Environment, NoneIsBlack) {
    EXPECT_FALSE(Environment{}.shines());
    EXPECT_EQ(Environment{}.radiance({0, 1, 0}), Spectrum(0.0f));
}

TEST(Environment, UniformIsTheSameAllAround) {
    Environment e = sky(Environment::Kind::uniform);
    e.radiance_scale = {1.0f, 2.0f, 3.0f};
    EXPECT_TRUE(e.shines());
    for (const glm::dvec3& d : {glm::dvec3(0, -1, 0), glm::dvec3(0.6, 0.0, 0.8)})
        EXPECT_EQ(e.radiance(d), e.radiance_scale);
}

TEST(Environment, AzimuthsRunClockwiseFromNorth) {
    const auto expect_near = [](const glm::dvec3& a, const glm::dvec3& b) {
        EXPECT_LT(glm::length(a - b), 1e-12);
    };
    expect_near(sky_direction({0, 1, 0}, 0.0, 0.0), {0, 0, -1});
    expect_near(sky_direction({0, 1, 0}, pi / 2.0, 0.0), {1, 0, 0});
    expect_near(sky_direction({0, 0, 1}, 0.0, 0.0), {0, 1, 0});
    expect_near(sky_direction({0, 0, 1}, pi / 2.0, 0.0), {1, 0, 0});
    expect_near(sky_direction({0, 0, 1}, 1.0, pi / 2.0), {0, 0, 1});
    // An orthonormal frame for any zenith, its own opposite among them.
    for (const glm::dvec3& up :
         {glm::dvec3(0, -1, 0), glm::dvec3(0.6, 0.0, 0.8), glm::normalize(glm::dvec3(1, -3, 2))}) {
        const glm::dvec3 north = sky_direction(up, 0.0, 0.0), east = sky_direction(up, pi / 2, 0.0);
        expect_near(sky_direction(up, 0.3, pi / 2.0), up);
        expect_near(glm::cross(north, up), east);
    }
}

TEST(Overcast, IrradianceFollowsTheClosedForm) {
    // The midpoint rule of 512 steps is right to 1e-5 of these smooth integrands.
    for (const glm::dvec3& up : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        const Environment e = sky(Environment::Kind::overcast, up);
        const double horizontal = irradiance(e, up);
        EXPECT_NEAR(horizontal, 7.0 * pi / 9.0, 1e-4);
        EXPECT_NEAR(irradiance(e, {1, 0, 0}) / horizontal, 0.396177, 1e-4);
        EXPECT_EQ(irradiance(e, -up, 16), 0.0);
        EXPECT_EQ(e.radiance(up), Spectrum(1.0f));
    }
}

Environment clear(double azimuth, double elevation) {
    Environment e = sky(Environment::Kind::clear, {0, 0, 1});
    e.sun = sky_direction(e.up, azimuth, elevation);
    return e;
}

TEST(ClearSky, HasTheRelativeRadianceOfTheStandard) {
    // The formula of the standard by hand, over the zenith's.
    const Environment high = clear(0.0, pi / 2.0), low = clear(0.0, pi / 6.0);
    const auto at = [](const Environment& e, double azimuth, double elevation) {
        return e.radiance(sky_direction(e.up, azimuth, elevation)).x;
    };
    EXPECT_NEAR(at(high, 1.0, pi / 2.0), 1.0, 1e-6);
    EXPECT_NEAR(at(high, 1.0, 1e-9), 0.3213918, 1e-6);
    EXPECT_NEAR(at(low, 2.0, pi / 2.0), 1.0, 1e-6);
    EXPECT_NEAR(at(low, 0.0, pi / 6.0), 13.4803553, 1e-5);
    EXPECT_NEAR(at(low, pi, pi / 6.0), 1.2355107, 1e-6);
    EXPECT_NEAR(at(low, 0.0, pi / 3.0), 2.5795366, 1e-6);
    EXPECT_EQ(at(low, 0.0, -1e-3), 0.0f);
}

TEST(ClearSky, IsPositiveAndSymmetricAboutTheSunsMeridian) {
    for (const double elevation : {0.0, 0.4, 1.2})
        for (double from_sun = 0.0; from_sun < pi; from_sun += 0.3)
            for (double up = 0.01; up < pi / 2.0; up += 0.2) {
                const Environment e = clear(2.0, elevation);
                const float left = e.radiance(sky_direction(e.up, 2.0 - from_sun, up)).x;
                const float right = e.radiance(sky_direction(e.up, 2.0 + from_sun, up)).x;
                EXPECT_GT(left, 0.0f);
                EXPECT_NEAR(left, right, 1e-5f * left);
            }
}

TEST(LatLong, TheMiddleLooksAlongPlusZ) {
    // Texel centres lie at azimuths of 22.5 degrees and then 45 apart: the middle is between two.
    const auto seen = [](int column, const glm::dvec3& d) {
        return lit_column(column).radiance(d).x;
    };
    EXPECT_NEAR(seen(3, {0, 0, 1}), 0.5f, 1e-6f);
    EXPECT_NEAR(seen(4, {0, 0, 1}), 0.5f, 1e-6f);
    EXPECT_NEAR(seen(1, {1, 0, 0}), 0.5f, 1e-6f);
    EXPECT_NEAR(seen(2, {1, 0, 0}), 0.5f, 1e-6f);
    EXPECT_NEAR(seen(5, {-1, 0, 0}), 0.5f, 1e-6f);
    // The seam is none.
    EXPECT_NEAR(seen(0, {0, 0, -1}), 0.5f, 1e-6f);
    EXPECT_NEAR(seen(7, {0, 0, -1}), 0.5f, 1e-6f);
}

TEST(LatLong, TheTopRowIsTheZenith) {
    Environment e = lat_long(4, 4);
    auto image = std::make_shared<Texture>(*e.image);
    for (int column = 0; column < 4; ++column) image->texels[column] = Spectrum(1.0f);
    e.image = image;
    EXPECT_EQ(e.radiance({0, 1, 0}), Spectrum(1.0f));
    EXPECT_EQ(e.radiance({0, -1, 0}), Spectrum(0.0f));
    e.up = {0, 0, 1};
    EXPECT_EQ(e.radiance({0, 0, 1}), Spectrum(1.0f));
    EXPECT_EQ(e.radiance({0, 1, 0}), Spectrum(0.0f));
}

TEST(LatLong, TurnsClockwiseSeenFromAbove) {
    Environment e = lit_column(4);
    const double centre = 2.0 * pi * 4.5 / 8.0;
    EXPECT_NEAR(e.radiance(sky_direction(e.up, centre, 0.0)).x, 1.0f, 1e-6f);
    e.rotation = 0.7;
    EXPECT_NEAR(e.radiance(sky_direction(e.up, centre + 0.7, 0.0)).x, 1.0f, 1e-6f);
    e.rotation = -20.0;
    EXPECT_NEAR(e.radiance(sky_direction(e.up, centre - 20.0, 0.0)).x, 1.0f, 1e-6f);
}

TEST(LatLong, AConstantImageIsUniform) {
    Environment e = lat_long(7, 3);
    auto image = std::make_shared<Texture>(*e.image);
    for (Spectrum& t : image->texels) t = {0.1f, 0.7f, 3.3f};
    e.image = image;
    e.rotation = 0.3;
    e.radiance_scale = Spectrum(2.0f);
    for (double azimuth = 0.0; azimuth < 7.0; azimuth += 0.1)
        for (double elevation = -pi / 2.0; elevation < pi / 2.0; elevation += 0.1)
            EXPECT_EQ(e.radiance(sky_direction(e.up, azimuth, elevation)),
                      Spectrum(2.0f) * Spectrum(0.1f, 0.7f, 3.3f));
}

TEST(LatLong, TexelsShareTheWholeSphere) {
    for (const int height : {1, 2, 7, 64}) {
        const Environment e = lat_long(2 * height, height);
        double sum = 0.0;
        for (int row = 0; row < height; ++row) sum += 2 * height * texel_solid_angle(*e.image, row);
        EXPECT_NEAR(sum, 4.0 * pi, 1e-12);
    }
}

}  // namespace
}  // namespace transillum

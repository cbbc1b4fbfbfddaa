// Colours in bands of wavelengths, and back.
#include <transillum/base/error.h>
#include <transillum/scene/bands.h>
#include <transillum/scene/colours.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace transillum {
namespace {

/// Sums of up to 60 terms around 1.
constexpr double rounding = 1e-13;

template <class Check>
void for_every_count(Check check) {
    for (int count = least_bands; count <= most_bands; ++count) {
        SCOPED_TRACE(count);
        check(Bands(count));
    }
}

TEST(Bands, GiveColoursBack) {
    for_every_count([](const Bands& bands) {
        EXPECT_EQ(bands.groups(), (bands.count() + 2) / 3);
        glm::dmat3 back(0.0);
        for (int g = 0; g < bands.groups(); ++g)
            back += bands.rgb_from_group(g) * bands.group_from_rgb(g);
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) EXPECT_NEAR(back[c][r], c == r ? 1.0 : 0.0, rounding);
    });
}

TEST(Bands, ShowConstantSpectraAsWhite) {
    for_every_count([](const Bands& bands) {
        const SpectrumTable constant{"constant", {300, 800}, {0.75, 0.75}};
        EXPECT_LT(glm::distance(bands.rgb_of(constant), SpectrumSum(0.75)), 1e-6);
        EXPECT_EQ(bands.in_group(constant, bands.groups() - 1), Spectrum(0.75f));
    });
}

// So that reflectances stay in [0, 1] and greys are constant.
TEST(Bands, ShareColoursOut) {
    for_every_count([](const Bands& bands) {
        for (int g = 0; g < bands.groups(); ++g)
            for (int c = 0; c < channel_count; ++c) {
                const glm::dvec3 share = glm::transpose(bands.group_from_rgb(g))[c];
                EXPECT_NEAR(share.x + share.y + share.z, 1.0, rounding);
                EXPECT_GE(glm::min(share.x, glm::min(share.y, share.z)), 0.0);
            }
    });
}

TEST(Bands, PartTheVisibleRange) {
    for_every_count([](const Bands& bands) {
        EXPECT_EQ(bands.edge(0), 400.0);
        EXPECT_EQ(bands.edge(bands.count()), 700.0);
        std::set<int> met;
        for (int g = 0; g < bands.groups(); ++g)
            for (int c = 0; c < channel_count; ++c) {
                const bool is_new = met.insert(bands.band_of(g, c)).second;
                EXPECT_EQ(is_new, bands.rgb_from_group(g)[c] != glm::dvec3(0.0)) << g << ' ' << c;
            }
        EXPECT_EQ(static_cast<int>(met.size()), bands.count());
    });
}

TEST(Bands, OtherCountsAreRefused) {
    for (const int count : {-1, 0, 7, 61}) EXPECT_THROW(Bands{count}, UsageError) << count;
}

TEST(Bands, HoldMeans) {
    const Bands bands(12);
    const SpectrumTable ramp{"ramp", {400, 700}, {0.0, 3.0}};
    for (int g = 0; g < bands.groups(); ++g)
        for (int c = 0; c < channel_count; ++c) {
            const int b = bands.band_of(g, c);
            const double middle = 0.5 * (bands.edge(b) + bands.edge(b + 1));
            EXPECT_FLOAT_EQ(bands.in_group(ramp, g)[c], static_cast<float>(middle / 100.0 - 4.0));
        }
}

// Against the matrices that are published for equal energy to D65 (Bradford) and for XYZ to sRGB.
// They are for the whole curves, of which 400 to 700 nm hold all but some thousandths.
TEST(Bands, AgreeWithPublishedMatrices) {
    const std::string file = TRANSILLUM_SOURCE_DIR "/data/spectra/cie1931.csv";
    const glm::dmat3 adapted =
        glm::transpose(glm::dmat3(0.9531874, -0.0265906, 0.0238731, -0.0382467, 1.0288406,
                                  0.0094060, 0.0026068, -0.0030332, 1.0892565));
    const glm::dmat3 rgb_from_xyz =
        glm::transpose(glm::dmat3(3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108,
                                  0.0415560, 0.0556434, -0.2040259, 1.0572252));
    const char* const curves[] = {"xbar", "ybar", "zbar"};
    for (const double peak : {450.0, 500.0, 550.0, 600.0, 650.0}) {
        SpectrumTable bump{"bump", {}, {}};
        for (int nm = 380; nm <= 780; ++nm) {
            bump.wavelengths.push_back(nm);
            bump.values.push_back(0.2 + 0.6 * std::exp(-std::pow((nm - peak) / 30.0, 2)));
        }
        glm::dvec3 xyz(0.0);
        for (int k = 0; k < 3; ++k) {
            const SpectrumTable curve = read_spectrum(file, curves[k]);
            double sum = 0.0, white = 0.0;
            for (int nm = 380; nm < 780; ++nm) {
                sum += curve.mean_over(nm, nm + 1) * bump.mean_over(nm, nm + 1);
                white += curve.mean_over(nm, nm + 1);
            }
            xyz[k] = sum / white;
        }
        const glm::dvec3 expected = rgb_from_xyz * (adapted * xyz);
        EXPECT_LT(glm::distance(Bands(60).rgb_of(bump), expected), 5e-3) << peak;
    }
}

// Texels, lights and environment as materials; what is no colour stays.
TEST(Colours, BecomeBandsEverywhere) {
    const Bands bands(12);
    const Spectrum colour(0.75f, 0.25f, 0.5f), scale(2.0f, 1.0f, 0.5f);
    const auto texture = [](const Spectrum& texel) {
        Texture t{.name = "t", .width = 2, .height = 1, .texels = {texel, Spectrum(0.5f)}};
        t.build_levels();
        return std::make_shared<const Texture>(t);
    };
    Colours rgb;
    rgb.textures = {texture(colour), texture(Spectrum(0.125f))};
    Material m;
    m.diffuse = m.specular = m.emission = colour;
    m.lobe = Lobe::ggx;
    m.textures = {.diffuse = 0, .specular = 0, .roughness = 1, .emission = -1};
    rgb.materials = {m};
    m.specular = {1.0f, 0.0f, 0.0f};
    m.textures = {.diffuse = 1, .specular = -1, .roughness = 1, .emission = -1};
    rgb.materials.push_back(m);
    rgb.lighting.lights.resize(1);
    rgb.lighting.lights[0].intensity = colour;
    rgb.lighting.environment.kind = Environment::Kind::image;
    rgb.lighting.environment.image = rgb.textures[0];
    rgb.lighting.environment.radiance_scale = scale;
    for (int g = 0; g < bands.groups(); ++g) {
        const auto in_group = [&](const Spectrum& c) {
            return Spectrum(bands.group_from_rgb(g) * SpectrumSum(c));
        };
        const Colours c = colours_in_group(rgb, bands, g);
        for (const auto member : {&Material::diffuse, &Material::specular, &Material::emission})
            EXPECT_EQ(c.materials[0].*member, in_group(colour));
        const MaterialTextures& t = c.materials[0].textures;
        EXPECT_EQ(t.diffuse, t.specular);
        EXPECT_EQ(t.emission, -1);
        const Texture& diffuse = *c.textures[static_cast<std::size_t>(t.diffuse)];
        EXPECT_EQ(diffuse.texels[0], in_group(colour));
        EXPECT_EQ(diffuse.texels[1], in_group(Spectrum(0.5f)));
        EXPECT_LT(glm::distance(diffuse.mean(), 0.5f * (diffuse.texels[0] + diffuse.texels[1])),
                  1e-6f);
        EXPECT_EQ(c.textures[static_cast<std::size_t>(t.roughness)], rgb.textures[1]);
        // The same texture as a colour.
        EXPECT_NE(c.materials[1].textures.diffuse, c.materials[1].textures.roughness);
        EXPECT_EQ(c.lighting.lights[0].intensity, in_group(colour));
        EXPECT_EQ(c.lighting.environment.radiance_scale, Spectrum(1.0f));
        EXPECT_EQ(c.lighting.environment.image->texels[0], in_group(scale * colour));
        // A red lobe reflects next to nothing of blue, but stays a lobe.
        for (int k = 0; k < 3; ++k) EXPECT_GE(c.materials[1].specular[k], least_specular);
    }
}

}  // namespace
}  // namespace transillum

// Measured spectra in the place of a scene's colours.
#include "scene_files.h"

#include <transillum/scene/measured_materials.h>

namespace transillum {
namespace {

constexpr const char* data = TRANSILLUM_SOURCE_DIR "/data/";

class MeasuredMaterials : public SceneFiles {
protected:
    MeasuredMaterials() {
        rgb_.materials.resize(3);
        rgb_.materials[0].name = "wall";
        rgb_.materials[1].name = "lamp";
        rgb_.materials[1].emission = {2.0f, 3.0f, 1.0f};
        rgb_.materials[2].name = "shiny";
        rgb_.materials[2].lobe = Lobe::max_phong;
        rgb_.materials[2].specular = Spectrum(0.3f);
        write("s.csv", "wavelength,ramp,dark,bright\n400,0.1,0,1.5\n600,0.5,0,1\n700,0.9,0,1\n");
        write("short.csv", "wavelength,a\n420,1\n700,1\n");
    }
    std::vector<MeasuredMaterial> read(const std::string& json) {
        return read_measured_materials(write("m.json", json), rgb_.materials);
    }
    void expect_refused_text(const std::string& json, const std::string& part) {
        try {
            (void)read(json);
            ADD_FAILURE() << "accepted; should have said " << part;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
    SpectralOptions options(const std::string& json) {
        SpectralOptions options;
        options.measured = read(json);
        return options;
    }

    Colours rgb_;
    const Bands bands_{12};
};

std::string entry(const std::string& material, const std::string& what, const std::string& column,
                  const std::string& more = {}) {
    return "{\"" + material + "\": {\"" + what + "\": {\"file\": \"s.csv\", \"column\": \"" +
           column + "\"" + more + "}}}";
}

TEST_F(MeasuredMaterials, TakeThePlaceOfColours) {
    rgb_.materials[0].textures.diffuse = 0;
    rgb_.textures.resize(1);
    Texture grey{.name = "grey", .width = 1, .height = 1, .texels = {Spectrum(0.5f)}};
    rgb_.textures[0] = std::make_shared<const Texture>(grey);
    const SpectralOptions o = options(entry("wall", "reflectance", "ramp"));
    const SpectrumTable& ramp = *o.measured[0].reflectance;
    SpectrumSum back(0.0);
    for (int g = 0; g < bands_.groups(); ++g) {
        const Colours c = measured_colours_in_group(rgb_, o, bands_, g, monitor_);
        EXPECT_EQ(c.materials[0].diffuse, bands_.in_group(ramp, g));
        EXPECT_EQ(c.materials[0].textures.diffuse, -1);
        EXPECT_EQ(c.materials[1].emission, colours_in_group(rgb_, bands_, g).materials[1].emission);
        back += bands_.rgb_from_group(g) * SpectrumSum(c.materials[0].diffuse);
    }
    const Colours shown = measured_colours(rgb_, o, bands_, monitor_);
    EXPECT_LT(glm::distance(back, SpectrumSum(shown.materials[0].diffuse)), 1e-6);
    EXPECT_EQ(shown.materials[1].diffuse, rgb_.materials[1].diffuse);
    EXPECT_TRUE(monitor_.warnings.empty());
}

TEST_F(MeasuredMaterials, EmitAsBrightlyAsTheSceneSays) {
    const SpectralOptions o = options(entry("lamp", "emission", "ramp"));
    const Colours shown = measured_colours(rgb_, o, bands_, monitor_);
    EXPECT_NEAR(luminance(shown.materials[1].emission), luminance(rgb_.materials[1].emission),
                1e-5);
    const Spectrum first =
        measured_colours_in_group(rgb_, o, bands_, 0, monitor_).materials[1].emission;
    const Spectrum table = bands_.in_group(*o.measured[0].emission, 0);
    EXPECT_NEAR(first.y / first.x, table.y / table.x, 1e-6);
}

TEST_F(MeasuredMaterials, EmitByTheScaleGiven) {
    const SpectralOptions o = options(entry("wall", "emission", "bright", ", \"scale\": 2.5"));
    for (int g = 0; g < bands_.groups(); ++g)
        EXPECT_EQ(measured_colours_in_group(rgb_, o, bands_, g, monitor_).materials[0].emission,
                  2.5f * bands_.in_group(*o.measured[0].emission, g));
}

// A lobe and a Lambert part that reflect too much together, in some bands.
TEST_F(MeasuredMaterials, AreLimited) {
    const SpectralOptions o = options(entry("shiny", "reflectance", "ramp"));
    for (int g = 0; g < bands_.groups(); ++g) {
        const Material m = measured_colours_in_group(rgb_, o, bands_, g, monitor_).materials[2];
        EXPECT_LE(max_channel(m.diffuse + m.specular), o.max_albedo + 1e-6f);
    }
    EXPECT_TRUE(monitor_.any_names(monitor_.warnings, "'shiny'"));
}

TEST_F(MeasuredMaterials, OfTheCornellBoxAreThere) {
    const Scene box = load_scene(std::string(data) + "scenes/cornell.gltf", {}, monitor_);
    const auto measured =
        read_measured_materials(std::string(data) + "spectra/cornell.json", box.materials);
    EXPECT_EQ(measured.size(), box.materials.size());
    SpectralOptions o;
    o.measured = measured;
    const Colours rgb{box.materials, box.textures, box.lighting};
    const Colours shown = measured_colours(rgb, o, bands_, monitor_);
    for (std::size_t i = 0; i < box.materials.size(); ++i)
        // The scene's RGB are of another white, and by other people: alike, no more.
        EXPECT_LT(glm::distance(shown.materials[i].diffuse, box.materials[i].diffuse), 0.15f)
            << box.materials[i].name;
}

TEST_F(MeasuredMaterials, NameWhatIsWrong) {
    expect_refused_text("{", "m.json: no JSON, at byte");
    expect_refused_text("[]", "m.json: the file: array found; accepted: an object");
    expect_refused_text("{\"wall\": 3}", "material 'wall': number found; accepted: an object");
    expect_refused_text(entry("door", "reflectance", "ramp"),
                        "material 'door': the scene has none of that name; accepted: 'wall', "
                        "'lamp', 'shiny'");
    expect_refused_text(
        entry("wall", "colour", "ramp"),
        "material 'wall': 'colour' found; accepted: reflectance, specular, emission");
    expect_refused_text(entry("wall", "reflectance", "ramp", ", \"scale\": 2"),
                        "material 'wall', reflectance: 'scale' found; accepted: file, column");
    expect_refused_text("{\"wall\": {\"reflectance\": {\"file\": \"s.csv\"}}}",
                        "material 'wall', reflectance: 'column' is missing");
    expect_refused_text("{\"wall\": {\"reflectance\": {\"file\": 3, \"column\": \"ramp\"}}}",
                        "'file' is a number; accepted: a string");
    expect_refused_text(entry("wall", "reflectance", "red"),
                        "s.csv:1: no column 'red'; accepted: ramp, dark, bright");
    expect_refused_text(entry("wall", "reflectance", "bright"),
                        "reflects 1.5 at 400 nm; accepted: 0 to 1");
    expect_refused_text(entry("wall", "specular", "ramp"), "the material has no glossy lobe");
    expect_refused_text(entry("wall", "emission", "ramp"), "does not emit");
    expect_refused_text(entry("lamp", "emission", "dark"), "is dark");
    expect_refused_text(entry("lamp", "emission", "ramp", ", \"scale\": 0"),
                        "scale 0; accepted: a number above 0");
    expect_refused_text(
        "{\"wall\": {\"reflectance\": {\"file\": \"short.csv\", \"column\": \"a\"}}}",
        "spans 420 to 700 nm; accepted: 400 to 700 nm or more");
    EXPECT_THROW(
        (void)read("{\"wall\": {\"reflectance\": {\"file\": \"no.csv\", \"column\": \"a\"}}}"),
        IoError);
}

}  // namespace
}  // namespace transillum

// Spectra from CSV files.
#include "scene_files.h"

#include <transillum/scene/spectrum_table.h>

namespace transillum {
namespace {

constexpr const char* data = TRANSILLUM_SOURCE_DIR "/data/spectra/";

class ReadSpectrum : public SceneFiles {
protected:
    SpectrumTable read(const std::string& text, const std::string& column = "a") {
        return read_spectrum(write("s.csv", text), column);
    }
    void expect_refused_text(const std::string& text, const std::string& part,
                             const std::string& column = "a") {
        try {
            (void)read(text, column);
            ADD_FAILURE() << "accepted; should have said " << part;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
};

TEST_F(ReadSpectrum, TakesTheColumnAskedFor) {
    const std::string text =
        "# of nothing\nwavelength, a ,b\r\n400,1,10\n\n500,2,20 # half\n700,6,60\n";
    const SpectrumTable a = read(text), b = read(text, "b");
    EXPECT_EQ(a.wavelengths, (std::vector<double>{400, 500, 700}));
    EXPECT_EQ(a.values, (std::vector<double>{1, 2, 6}));
    EXPECT_EQ(b.values, (std::vector<double>{10, 20, 60}));
    EXPECT_NE(b.name.find("s.csv, column 'b'"), std::string::npos) << b.name;
}

TEST_F(ReadSpectrum, IntegratesWhatIsLinearBetweenWavelengths) {
    const SpectrumTable t = read("wavelength,a\n400,1\n500,2\n700,6\n");
    EXPECT_DOUBLE_EQ(t.integral(400, 700), 150.0 + 800.0);
    EXPECT_DOUBLE_EQ(t.integral(450, 600), 0.5 * (1.5 + 2.0) * 50.0 + 0.5 * (2.0 + 4.0) * 100.0);
    EXPECT_DOUBLE_EQ(t.mean_over(550, 650), 4.0);
    EXPECT_EQ(t.integral(600, 600), 0.0);
}

TEST_F(ReadSpectrum, ReadsTheDataThere) {
    const SpectrumTable y = read_spectrum(std::string(data) + "cie1931.csv", "ybar");
    EXPECT_NEAR(y.integral(y.wavelengths.front(), y.wavelengths.back()), 106.86, 0.01);
    const SpectrumTable white =
        read_spectrum(std::string(data) + "cornell_reflectance.csv", "white");
    EXPECT_EQ(white.wavelengths.size(), 76u);
    EXPECT_EQ(white.values.front(), 0.343);
    const SpectrumTable light = read_spectrum(std::string(data) + "cornell_light.csv", "emission");
    EXPECT_DOUBLE_EQ(light.mean_over(440, 460), 4.0);
}

TEST_F(ReadSpectrum, NamesWhatIsWrong) {
    const std::string head = "wavelength,a\n";
    expect_refused_text("nm,a\n400,1\n700,1\n", "s.csv:1: first column 'nm'; accepted: wavelength");
    expect_refused_text(head + "400,1\n700,1\n", "s.csv:1: no column 'red'; accepted: a", "red");
    expect_refused_text(head + "400,1\n700,1\n", "no column 'wavelength'", "wavelength");
    expect_refused_text("wavelength,a,a\n400,1,1\n", "two columns 'a'");
    expect_refused_text("wavelength,a,\n400,1,1\n", "a column without a name");
    expect_refused_text(head + "400,1\n700\n", "s.csv:3: 1 values; accepted: 2");
    expect_refused_text(head + "400,1\n700,1,1\n", "s.csv:3: 3 values; accepted: 2");
    expect_refused_text(head + "400,1\n700,\n", "s.csv:3: ");
    expect_refused_text(head + "400,nan\n700,1\n", "s.csv:2: ");
    expect_refused_text(head + "400,one\n700,1\n", "s.csv:2: 'one' found");
    expect_refused_text(head + "400,-1\n700,1\n", "s.csv:2: value -1; accepted: 0 or more");
    expect_refused_text(head + "400,1\n400,1\n", "s.csv:3: wavelength 400 follows 400");
    expect_refused_text(head + "400,1\n", "1 wavelengths; accepted: two or more");
    expect_refused_text("# nothing\n", "no columns");
    EXPECT_THROW((void)read_spectrum(folder_ / "gone.csv", "a"), IoError);
}

}  // namespace
}  // namespace transillum

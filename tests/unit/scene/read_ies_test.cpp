#include "unit/scene/scene_files.h"

#include <transillum/scene/punctual_light.h>
#include <transillum/scene/read_ies.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>

namespace transillum {
namespace {

constexpr double pi = std::numbers::pi;

struct File {
    std::string version = "IESNA:LM-63-2002\n", tilt = "TILT=NONE\n";
    std::string head = "1 1000 1";  ///< lamps, lumens, multiplier
    std::string type = "1";
    std::string factors = "1 1 100";
    std::vector<double> vertical, horizontal;
    std::function<double(double c, double gamma)> candela = [](double, double) { return 100.0; };

    [[nodiscard]] std::string text() const {
        std::ostringstream out;
        out << version << "[TEST] written by a test\r\n[MANUFAC] none, 1 2 3\n"
            << tilt << head << ' ' << vertical.size() << ' ' << horizontal.size() << ' ' << type
            << " 2 0 0 0\n"
            << factors << "\n";
        for (const double v : vertical) out << v << ' ';
        out << "\r\n";
        for (const double h : horizontal) out << h << ", ";
        out << '\n';
        out.precision(17);
        for (const double h : horizontal) {
            for (const double v : vertical) out << candela(h, v) << '\n';
            out << "\r\n";
        }
        return out.str();
    }
};

std::vector<double> steps(double first, double last, double step) {
    std::vector<double> angles;
    for (int i = 0; first + i * step <= last; ++i) angles.push_back(first + i * step);
    return angles;
}

class ReadIes : public SceneFiles {
protected:
    Photometry read(const File& file) { return read_ies(write("a.ies", file.text()), monitor_); }
    void expect_refused_text(const std::string& text, const std::vector<std::string>& parts) {
        try {
            (void)read_ies(write("a.ies", text), monitor_);
            ADD_FAILURE() << "was accepted; should have said " << parts.front();
        } catch (const InputError& error) {
            for (const std::string& part : parts)
                EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
};

TEST_F(ReadIes, IsotropicLightHasItsClosedForm) {
    for (const double last : {0.0, 90.0, 180.0, 360.0}) {
        File file;
        file.vertical = steps(0, 180, 10);
        file.horizontal = last == 0.0 ? std::vector<double>{0.0} : steps(0, last, 30);
        const Photometry p = read(file);
        EXPECT_NEAR(p.flux(), 4.0 * pi * 100.0, 1e-9) << last;
        EXPECT_EQ(p.candela_at(123.4, 56.7), 100.0);
    }
}

TEST_F(ReadIes, CosineLightHasItsClosedForm) {
    File file;
    file.vertical = steps(0, 90, 5);
    file.horizontal = {0};
    file.candela = [](double, double gamma) { return 100.0 * std::cos(gamma * pi / 180.0); };
    // The chord of a cosine falls short by at most step^2 / 8 of it: as much of the flux.
    const double step = 5.0 * pi / 180.0;
    const Photometry p = read(file);
    EXPECT_LT(p.flux(), pi * 100.0);
    EXPECT_GT(p.flux(), pi * 100.0 * (1.0 - step * step / 8.0));
    EXPECT_NEAR(p.candela_at(200.0, 60.0), 50.0, 1e-9);
    EXPECT_EQ(p.candela_at(0.0, 90.1), 0.0);
}

TEST_F(ReadIes, InterpolatesBothAngles) {
    File file;
    file.vertical = {0, 30, 90};
    file.horizontal = {0, 45, 90};
    file.candela = [](double c, double gamma) { return 2.0 * c + gamma; };
    const Photometry p = read(file);
    EXPECT_NEAR(p.candela_at(10, 20), 40.0, 1e-12);
    EXPECT_NEAR(p.candela_at(60, 75), 195.0, 1e-12);
}

TEST_F(ReadIes, UnfoldsItsSymmetry) {
    File file;
    file.vertical = {0, 90};
    file.candela = [](double c, double) { return 1000.0 + c; };
    file.horizontal = {0, 45, 90};
    Photometry p = read(file);
    for (const auto& [c, folded] : {std::pair{100.0, 80.0},
                                    {170.0, 10.0},
                                    {190.0, 10.0},
                                    {280.0, 80.0},
                                    {350.0, 10.0},
                                    {-10.0, 10.0},
                                    {370.0, 10.0}})
        EXPECT_NEAR(p.candela_at(c, 45), 1000.0 + folded, 1e-9) << c;
    file.horizontal = {0, 90, 180};
    p = read(file);
    for (const auto& [c, folded] : {std::pair{100.0, 100.0}, {190.0, 170.0}, {350.0, 10.0}})
        EXPECT_NEAR(p.candela_at(c, 45), 1000.0 + folded, 1e-9) << c;
    file.horizontal = {0, 90, 180, 270, 360};
    p = read(file);
    for (const double c : {100.0, 190.0, 350.0})
        EXPECT_NEAR(p.candela_at(c, 45), 1000.0 + c, 1e-9) << c;
    file.horizontal = {90, 180, 270};
    p = read(file);
    for (const auto& [c, folded] :
         {std::pair{100.0, 100.0}, {80.0, 100.0}, {10.0, 170.0}, {350.0, 190.0}, {280.0, 260.0}})
        EXPECT_NEAR(p.candela_at(c, 45), 1000.0 + folded, 1e-9) << c;
}

TEST_F(ReadIes, MultipliesFactorsIn) {
    File file;
    file.vertical = {0, 180};
    file.horizontal = {0};
    file.head = "2 -1 3.0";
    file.factors = "0.5 0.8 100";
    EXPECT_NEAR(read(file).candela_at(0, 0), 150.0, 1e-12);
    file.version = "IESNA:LM-63-1995\r\n";
    EXPECT_NEAR(read(file).candela_at(0, 0), 150.0, 1e-12);
    for (const char* version : {"IESNA91\n", ""}) {
        file.version = version;
        EXPECT_NEAR(read(file).candela_at(0, 0), 120.0, 1e-12) << version;
    }
}

TEST_F(ReadIes, ReadsOverTiltTables) {
    File file;
    file.vertical = {0, 180};
    file.horizontal = {0};
    file.tilt = "TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n";
    EXPECT_EQ(read(file).candela_at(0, 0), 100.0);
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "a.ies: not honoured: TILT=INCLUDE"));
}

TEST_F(ReadIes, RefusesOtherTypesAndShapes) {
    File file;
    file.vertical = {0, 90};
    file.horizontal = {0};
    const auto refused = [&](auto change, const std::vector<std::string>& parts) {
        File changed = file;
        change(changed);
        expect_refused_text(changed.text(), parts);
    };
    refused([](File& f) { f.type = "2"; }, {"a.ies:5: photometric type 2 (B); accepted: 1 (C)"});
    refused([](File& f) { f.type = "3"; }, {"photometric type 3 (A); accepted: 1 (C)"});
    refused([](File& f) { f.tilt = "TILT=lamp.tlt\n"; },
            {"a.ies:4: TILT=lamp.tlt found; accepted: TILT=NONE, TILT=INCLUDE"});
    refused([](File& f) { f.version = "IESNA:LM-63-2040\n"; },
            {"a.ies:1: 'IESNA:LM-63-2040' found; accepted: IESNA91"});
    refused([](File& f) { f.horizontal = {0, 120}; }, {"horizontal angles from 0 to 120"});
    refused([](File& f) { f.horizontal = {0, 90, 45}; }, {"horizontal angle 45 follows 90"});
    refused([](File& f) { f.vertical = {10, 90}; }, {"vertical angles from 10 to 90"});
    refused([](File& f) { f.vertical = {90}; }, {"vertical angles from 90 to 90"});
    refused([](File& f) { f.candela = [](double, double) { return -1.0; }; },
            {"candela value -1; accepted: 0 or more"});
    refused([](File& f) { f.head = "1 1000 0"; }, {"candela multiplier is 0"});
    refused([](File& f) { f.factors = "1 1 x"; },
            {"a.ies:6: 'x' found; accepted: a finite number"});
    expect_refused_text(file.text() + "7\n", {"'7' found behind the last of 2 candela values"});
    expect_refused_text("IESNA91\n1 2 3\n", {"no line begins with TILT="});
    EXPECT_NO_THROW((void)read_ies(write("a.ies", file.text() + " \x1a"), monitor_));
    EXPECT_THROW((void)read_ies(folder_ / "gone.ies", monitor_), IoError);
}

TEST_F(ReadIes, RefusesEveryBeginningOfAFile) {
    File file;
    file.vertical = {0, 90};
    file.horizontal = {0, 90};
    std::string text = file.text();
    while (std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    const std::string last = "100";  // its beginnings are numbers, too
    for (std::size_t size = 1; size <= text.size() - last.size(); ++size)
        EXPECT_THROW((void)read_ies(write("a.ies", text.substr(0, size)), monitor_), InputError)
            << size;
}

TEST(PunctualLight, ShinesAsPhotometrySays) {
    auto table = std::make_shared<Photometry>();
    table->vertical = {0, 90, 180};
    table->horizontal = {0, 90, 180, 270, 360};
    // By azimuth at 90 degrees; 10 at the nadir, 20 at the zenith.
    for (const double at_side : {1.0, 2.0, 3.0, 4.0, 1.0})
        table->candela.insert(table->candela.end(), {10.0, at_side, 20.0});
    PunctualLight light;
    light.photometry = table;
    light.intensity = {1.0f, 0.5f, 2.0f};
    // As glTF hangs it: towards -z, +y up. C = 0 along +x.
    EXPECT_EQ(light.intensity_towards({0, 0, -1}), Spectrum(10.0f, 5.0f, 20.0f));
    EXPECT_EQ(light.distribution({0, 0, 1}), 20.0);
    EXPECT_NEAR(light.distribution({1, 0, 0}), 1.0, 1e-9);
    EXPECT_NEAR(light.distribution({0, 1, 0}), 2.0, 1e-9);
    EXPECT_NEAR(light.distribution({-1, 0, 0}), 3.0, 1e-9);
    EXPECT_NEAR(light.distribution({0, -1, 0}), 4.0, 1e-9);
    // Down where +y is up: C = 90 along -z.
    light.direction = {0, -1, 0};
    EXPECT_NEAR(light.distribution({0, -1, 0}), 10.0, 1e-9);
    EXPECT_NEAR(light.distribution({1, 0, 0}), 1.0, 1e-9);
    EXPECT_NEAR(light.distribution({0, 0, -1}), 2.0, 1e-9);
}

TEST(PunctualLight, SpotsFadeBetweenTheirAngles) {
    PunctualLight spot;
    spot.kind = PunctualLight::Kind::spot;
    spot.direction = {0, 0, -1};
    spot.inner_angle = 0.3;
    spot.outer_angle = 0.6;
    spot.intensity = Spectrum(8.0f);
    const auto at = [&](double angle) {
        return spot.distribution({std::sin(angle), 0.0, -std::cos(angle)});
    };
    EXPECT_EQ(at(0.0), 1.0);
    EXPECT_EQ(at(0.29), 1.0);
    EXPECT_EQ(at(0.61), 0.0);
    EXPECT_EQ(at(3.0), 0.0);
    const double middle = std::acos(0.5 * (std::cos(0.3) + std::cos(0.6)));
    EXPECT_NEAR(at(middle), 0.25, 1e-12);
    EXPECT_EQ(spot.intensity_towards({0, 0, -1}), Spectrum(8.0f));
    double sum = 0.0;
    constexpr int steps = 10000;
    for (int i = 0; i < steps; ++i) {
        const double angle = 0.7 * (i + 0.5) / steps;
        sum += 2.0 * pi * at(angle) * std::sin(angle) * 0.7 / steps;
    }
    EXPECT_NEAR(spot.flux().x, 8.0 * sum, 1e-6);
    spot.kind = PunctualLight::Kind::point;
    EXPECT_EQ(at(3.0), 1.0);
    EXPECT_DOUBLE_EQ(spot.flux().y, 32.0 * pi);
}

}  // namespace
}  // namespace transillum

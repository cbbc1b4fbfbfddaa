/// Wavelengths in bands: what a colour is in them, and what they are as a colour.
///
/// The bands part 400 to 700 nm evenly. The value of a band is the mean over it of a spectrum, in
/// such a unit that a constant spectrum of 1 is white, RGB (1, 1, 1): a surface that reflects, or a
/// light that emits, alike at every wavelength is grey, as it is in RGB. The colour of a spectrum:
///
///   XYZ = sum over bands of value * (integrals over the band of the CIE 1931 curves)
///
/// adapted (Bradford) from the white of a constant spectrum to D65, the white of sRGB, and then to
/// linear sRGB. Colours become spectra by colour_basis.h, and come back as they were.
///
/// Transport runs three channels at a time: a group of bands takes the place of RGB. Channels of
/// the last group beyond the last band repeat it, and count for nothing.
#pragma once

#include <transillum/base/spectrum.h>
#include <transillum/scene/spectrum_table.h>

#include <glm/mat3x3.hpp>

#include <vector>

namespace transillum {

inline constexpr double shortest_wavelength = 400.0, longest_wavelength = 700.0;  ///< [nm]
/// Fewer cannot give back all colours of sRGB; the curves are known every 5 nm.
inline constexpr int least_bands = 8, most_bands = 60;

class Bands {
public:
    /// \throws UsageError for a count outside [least_bands, most_bands].
    explicit Bands(int count);

    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] int groups() const { return static_cast<int>(rgb_from_group_.size()); }
    /// Where a band begins, and the one before ends [nm].
    [[nodiscard]] double edge(int band) const;
    /// The band that a channel of a group stands for.
    [[nodiscard]] int band_of(int group, int channel) const;

    /// Linear sRGB is the sum over all groups of these times the group's values. May be negative:
    /// pure colours lie outside sRGB.
    [[nodiscard]] const glm::dmat3& rgb_from_group(int group) const {
        return rgb_from_group_[static_cast<std::size_t>(group)];
    }
    /// Entries are not negative, rows make 1.
    [[nodiscard]] const glm::dmat3& group_from_rgb(int group) const {
        return group_from_rgb_[static_cast<std::size_t>(group)];
    }

    [[nodiscard]] Spectrum in_group(const SpectrumTable& table, int group) const;
    [[nodiscard]] SpectrumSum rgb_of(const SpectrumTable& table) const;

private:
    int count_;
    std::vector<glm::dmat3> rgb_from_group_, group_from_rgb_;
};

}  // namespace transillum

/// Measured spectra: values over the wavelength.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace transillum {

/// Linear between its wavelengths.
struct SpectrumTable {
    std::string name;                 ///< file and column, for messages
    std::vector<double> wavelengths;  ///< [nm], ascending, two or more
    std::vector<double> values;       ///< one a wavelength, not negative

    /// Integral over [from, to] [nm]. \pre from <= to, both within the wavelengths
    [[nodiscard]] double integral(double from, double to) const;
    [[nodiscard]] double mean_over(double from, double to) const {
        return integral(from, to) / (to - from);
    }
};

/// Reads a column of a CSV file: lines of numbers parted by commas, the first of which names the
/// columns, `wavelength` [nm] before all others; `#` begins a comment. \throws IoError; InputError
/// naming file and line where names or numbers are missing or too many, a number is not finite or
/// is negative, or wavelengths do not ascend, and where there is no such column.
[[nodiscard]] SpectrumTable read_spectrum(const std::filesystem::path& path,
                                          std::string_view column);

/// The same of a text; `name` stands for the file in messages.
[[nodiscard]] SpectrumTable parse_spectrum(const std::string& name, std::string_view text,
                                           std::string_view column);

}  // namespace transillum

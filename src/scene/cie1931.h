/// The text of data/spectra/cie1931.csv, so that the program needs no file.
#pragma once

namespace transillum {

extern const char* const cie_1931_csv;

}  // namespace transillum

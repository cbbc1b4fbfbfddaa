/// Errors of runs that differ in their seed: how far each is off, and which part of that they have
/// in common.
#pragma once

#include <transillum/render/image.h>
#include <transillum/solution/solution.h>

#include <span>
#include <vector>

namespace transillum::benchmarks {

/// A mean over seeds with the ends of its 95 % confidence interval (Student's); NaN of one seed.
struct Band {
    double mean = 0.0, low = 0.0, high = 0.0;
};
[[nodiscard]] Band band_of(std::span<const double> values);

/// Relative: over the truth's mean.
struct SeedErrors {
    Band error;           ///< root mean square of a run's difference from the truth
    double bias = 0.0;    ///< the same of the mean of all runs, less what their spread leaves in it
    double spread = 0.0;  ///< root mean square of the standard deviation over seeds
};

/// An unbiased picture: the mean of two that are independent. How far these are apart tells its own
/// noise, which adds to the square of every difference from it and is taken out of there again.
struct ImageTruth {
    Image image;
    double noise = 0.0;  ///< relative RMSE
};
[[nodiscard]] ImageTruth truth_of(Image one, const Image& other);

/// As compare_images() does it: pixels that see an emitter are left out.
[[nodiscard]] SeedErrors image_errors(const std::vector<Image>& runs, const ImageTruth& truth);

/// Luminance of something that every patch has, and how much each patch weighs.
struct LeafField {
    std::vector<double> values, weights;
};
/// Irradiance, first shot and iteration together. \param indirect the iteration's alone
[[nodiscard]] LeafField irradiance_of(const Solution& solution, bool indirect = false);
[[nodiscard]] double relative_rms(std::span<const double> values, const LeafField& truth);
/// \pre all of the same patches
[[nodiscard]] SeedErrors leaf_errors(const std::vector<std::vector<double>>& runs,
                                     const LeafField& truth);

}  // namespace transillum::benchmarks

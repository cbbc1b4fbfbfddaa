/// The error of a whole solution in one number, while it converges.
///
/// Blocks of a low-discrepancy sequence make up for each other: their spread alone overstates the
/// error of their mean, the more so the faster it falls. How far the average moves between two
/// powers of two of directions tells both. The model: the mean over n directions that form a net
/// has a variance of c n^(-2a); then two halves of a net of s directions have the covariance
///     c s^(-2a) (2 - 2^(2a)),
/// and so have any of their parts, which gives the variance of every weighted mean of parts, and of
/// the difference of two such means. c and a are those that agree best with the moves there were.
#pragma once

#include "transport/finite_elements.h"

#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

/// Directions that follow each other, within a quarter of an octave of their numbers.
struct DirectionPart {
    std::uint64_t begin = 0, end = 0;
    double share = 0.0;  ///< in a mean; in a difference of means it may be negative
};

/// Variance of a weighted mean of parts by the model above, c = 1.
[[nodiscard]] double variance_of_parts(std::span<const DirectionPart> parts, double a);

/// A move of the average, of which the model is to tell the mean square.
struct AverageMove {
    std::vector<DirectionPart> difference;
    double mean_square = 0.0;
};

struct ErrorModel {
    double c = 0.0, a = 0.0;
};
/// Most likely from the moves, about equally uncertain, and from what is usual of a.
/// \pre there is one, and none is 0
[[nodiscard]] ErrorModel fit_error_model(std::span<const AverageMove> moves);

/// What an estimate has learnt, for another to go on from.
struct ErrorHistory {
    std::vector<DirectionPart> parts;  ///< shares: sums of weights
    std::vector<float> last;           ///< luminance when last compared; -1: unseen
    std::vector<DirectionPart> last_parts;
    std::vector<AverageMove> moves;
    ErrorModel model;
    std::vector<DirectionPart> earlier;  ///< set aside by the last restart
    bool jumps = false;  ///< the next or only move is larger than the error alone makes it

    /// Parts with those set aside, which a run that ends now recalls.
    [[nodiscard]] std::vector<DirectionPart> concluded() const;
};

class ErrorEstimate {
public:
    /// Keeps references. \param leaf_area one a leaf
    ErrorEstimate(std::span<const double> leaf_area, const Workers& workers)
        : leaf_area_(leaf_area), workers_(workers) {}

    /// What FiniteElementComponent averages in; its restart(), recall() and forget().
    void add(std::uint64_t begin, std::uint64_t end, double weight);
    void restart();
    void recall();
    void forget() { now_.earlier.clear(); }

    /// Notes how far the average has moved since the last call. \pre at a power of two of
    /// directions
    void compare(const FiniteElementComponent& component);
    /// Goes on from another's, on the same elements.
    void set_history(ErrorHistory history) { now_ = std::move(history); }
    [[nodiscard]] const ErrorHistory& history() const { return now_; }
    /// The average is of something else from now on, as of other elements: moves so far say nothing
    /// of it, and the next one only while there is no other.
    void begin_anew(const FiniteElementComponent& component);

    /// Root mean square standard error over the mean, both weighted with area, of the luminance
    /// that arrives where it is reflected, if the run ended now; NaN where nothing is known.
    [[nodiscard]] double relative_error(const FiniteElementComponent& component) const;
    /// Relative standard error of that, by how many moves it is told from.
    [[nodiscard]] double uncertainty() const;
    /// What the squared standard errors of patches, from the spread of blocks, must be multiplied
    /// with to agree with that.
    [[nodiscard]] double correction(const FiniteElementComponent& component) const;

private:
    struct Sums {
        double variance = 0.0, mean = 0.0;         // of what is told, of what is seen
        double seen = 0.0, told = 0.0, all = 0.0;  // areas
    };
    [[nodiscard]] Sums measure(const FiniteElementComponent& component) const;
    /// Of the average as it is, mean over the area; NaN where unknown.
    [[nodiscard]] double variance() const;

    std::span<const double> leaf_area_;
    const Workers& workers_;
    ErrorHistory now_;
};

}  // namespace transillum

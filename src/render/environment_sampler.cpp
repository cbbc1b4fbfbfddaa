#include "render/environment_sampler.h"

#include <transillum/base/sampling.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int sky_columns = 128, most_columns = 1024;
/// Of the mean radiance, added everywhere: bounds the weight of what the table's points miss.
constexpr double spread_evenly = 0.02;

std::size_t found_in(const double* sums, std::size_t count, double target) {
    return std::min<std::size_t>(std::upper_bound(sums, sums + count, target) - sums, count - 1);
}

}  // namespace

EnvironmentSampler::EnvironmentSampler(const Environment& environment) {
    if (!environment.shines() || environment.kind == Environment::Kind::uniform) return;
    frame_ = frame_about(environment.up);
    const int width = environment.image ? environment.image->width : sky_columns;
    columns_ = std::clamp(width, 16, most_columns);
    rows_ = columns_ / 2;
    points_ = 1 + (width + columns_ - 1) / columns_;

    cells_.resize(static_cast<std::size_t>(columns_) * rows_);
    double whole = 0.0;
    for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column) {
            const double weight = weight_of(environment, column, row);
            cells_[static_cast<std::size_t>(row) * columns_ + column] = weight;
            whole += weight * cell_size(row);
        }
    if (!(whole > 0.0)) return;
    const double evenly = spread_evenly * whole / (4.0 * pi);
    for (int row = 0; row < rows_; ++row) {
        double sum = 0.0;
        double* cell = &cells_[static_cast<std::size_t>(row) * columns_];
        for (int column = 0; column < columns_; ++column)
            cell[column] = sum += (cell[column] + evenly) * cell_size(row);
        ends_.push_back(total_ += sum);
    }
}

/// Rows from the zenith down, in equal angles.
glm::dvec3 EnvironmentSampler::direction_at(double column, double row) const {
    const double theta = pi * row / rows_, phi = 2.0 * pi * column / columns_;
    return glm::normalize(frame_ * glm::dvec3(std::sin(theta) * std::cos(phi),
                                              std::sin(theta) * std::sin(phi), std::cos(theta)));
}

/// Mean radiance of points spread over a cell.
double EnvironmentSampler::weight_of(const Environment& environment, int column, int row) const {
    double sum = 0.0;
    for (int i = 0; i < points_; ++i)
        for (int j = 0; j < points_; ++j)
            sum += mean_channel(environment.radiance(
                direction_at(column + (i + 0.5) / points_, row + (j + 0.5) / points_)));
    return std::max(0.0, sum / (points_ * points_));
}

/// Solid angle.
double EnvironmentSampler::cell_size(std::size_t row) const {
    const double step = pi / rows_, from = step * static_cast<double>(row);
    return 2.0 * pi / columns_ * (std::cos(from) - std::cos(from + step));
}

glm::dvec3 EnvironmentSampler::sample(glm::vec2 u) const {
    // What chose row and column is spread over the cell again, so that the pair stays stratified.
    const double down = u.x * total_;
    const std::size_t row = found_in(ends_.data(), ends_.size(), down);
    const double above = row == 0 ? 0.0 : ends_[row - 1];
    const double in_row = (down - above) / (ends_[row] - above);

    const double* cells = &cells_[row * columns_];
    const double across = u.y * cells[columns_ - 1];
    const std::size_t column = found_in(cells, columns_, across);
    const double left = column == 0 ? 0.0 : cells[column - 1];
    const double in_cell = (across - left) / (cells[column] - left);

    const double step = pi / rows_, top = std::cos(step * static_cast<double>(row)),
                 bottom = std::cos(step * static_cast<double>(row + 1));
    const double z = top + std::clamp(in_row, 0.0, 1.0) * (bottom - top);
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    const double phi =
        2.0 * pi * (static_cast<double>(column) + std::clamp(in_cell, 0.0, 1.0)) / columns_;
    return glm::normalize(frame_ * glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
}

double EnvironmentSampler::density(const glm::dvec3& direction) const {
    if (empty()) return 0.0;
    const glm::dvec3 d = glm::transpose(frame_) * direction;
    const double theta = std::acos(std::clamp(d.z, -1.0, 1.0));
    double turns = std::atan2(d.y, d.x) / (2.0 * pi);
    if (turns < 0.0) turns += 1.0;
    const std::size_t row = std::min(rows_ - 1, static_cast<int>(theta / pi * rows_));
    const std::size_t column = std::min(columns_ - 1, static_cast<int>(turns * columns_));
    const double* cells = &cells_[row * columns_];
    const double weight = cells[column] - (column == 0 ? 0.0 : cells[column - 1]);
    return weight / (total_ * cell_size(row));
}

}  // namespace transillum

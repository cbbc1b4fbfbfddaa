/// A function over the unit square from its values on a grid, bilinear between them, so that it
/// stays between the least and the greatest.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace transillum {

template <class Value, int columns, int rows>
class AlbedoTable {
public:
    /// \param value_at of a node's (x, y)
    template <class ValueAt>
    explicit AlbedoTable(ValueAt value_at) {
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                values_[row * columns + column] =
                    value_at(static_cast<double>(column) / (columns - 1),
                             static_cast<double>(row) / (rows - 1));
    }

    [[nodiscard]] Value at(float x, float y) const {
        const Position px(x, columns), py(y, rows);
        const Value* v = &values_[py.node * columns + px.node];
        const Value low = v[0] * (1.0f - px.rest) + v[1] * px.rest;
        const Value high = v[columns] * (1.0f - px.rest) + v[columns + 1] * px.rest;
        return low * (1.0f - py.rest) + high * py.rest;
    }

private:
    struct Position {
        Position(float x, int nodes) {
            const float scaled = std::clamp(x, 0.0f, 1.0f) * static_cast<float>(nodes - 1);
            node = std::min(static_cast<int>(scaled), nodes - 2);
            rest = scaled - static_cast<float>(node);
        }
        int node;
        float rest;
    };
    std::array<Value, static_cast<std::size_t>(columns* rows)> values_{};
};

}  // namespace transillum

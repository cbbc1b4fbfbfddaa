/// What hangs together by edges of two faces.
#pragma once

#include "repair/defects/edge_table.h"

#include <cstdint>
#include <vector>

namespace transillum {

/// Sheets are numbered by their first triangle. \pre none repeats a vertex, or it is a sheet alone.
struct Sheets {
    std::vector<std::uint32_t> sheet;     ///< one a triangle
    std::vector<bool> turned;             ///< runs against its sheet's first triangle
    std::vector<bool> orientable, mixed;  ///< one a sheet; mixed: some run against others

    [[nodiscard]] std::size_t size() const { return orientable.size(); }
};

[[nodiscard]] Sheets find_sheets(const TriangleSoup& soup, const EdgeTable& edges);

}  // namespace transillum

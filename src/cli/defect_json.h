/// Defects in machine-readable reports.
#pragma once

#include <transillum/repair/defects.h>

#include <nlohmann/json.hpp>

#include <string>

namespace transillum::cli {

[[nodiscard]] inline nlohmann::ordered_json counts_of(const DefectCounts& counts) {
    auto json = nlohmann::ordered_json::object();
    for (std::size_t d = 0; d < defect_count; ++d)
        json[std::string(name_of(static_cast<Defect>(d)))] = counts[d];
    return json;
}

}  // namespace transillum::cli

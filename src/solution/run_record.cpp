#include "run_record.h"

#include "replace_files.h"

#include <transillum/base/error.h>
#include <transillum/solution/load_solution.h>

#include <nlohmann/json.hpp>

namespace transillum {

std::string format_run_record(const RunRecord& run) {
    nlohmann::ordered_json json;
    json["command_line"] = run.command_line;
    json["threads"] = run.threads;
    json["seconds"] = nlohmann::ordered_json::array();
    for (const auto& [phase, seconds] : run.seconds) {
        json["seconds"].push_back({{"phase", phase}, {"seconds", seconds}});
    }
    if (!run.input_hash.empty()) json["input_hash"] = run.input_hash;
    // File names on a command line need not be UTF-8.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

RunRecord load_run_record(const std::filesystem::path& path) {
    const auto file = std::filesystem::path(path).replace_extension() / "run.json";
    if (!std::filesystem::exists(file)) return {};
    try {
        const auto json = nlohmann::json::parse(read_bytes(file));
        RunRecord run{json.at("command_line"), json.at("threads"), {}, {}};
        if (json.contains("input_hash")) run.input_hash = json.at("input_hash");
        for (const auto& entry : json.at("seconds")) {
            run.seconds.emplace_back(entry.at("phase"), entry.at("seconds"));
        }
        return run;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(file.string(), std::string("not a run record: ") + error.what());
    }
}

}  // namespace transillum

/// NAME/run.json
#pragma once

#include <transillum/solution/save_solution.h>

#include <string>

namespace transillum {

[[nodiscard]] std::string format_run_record(const RunRecord& run);

}  // namespace transillum

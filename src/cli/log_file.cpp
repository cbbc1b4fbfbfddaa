#include "cli/log_file.h"

#include <transillum/base/error.h>

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

namespace transillum::cli {

namespace {

constexpr const char* name = "transillum";

}  // namespace

void open_log(const std::string& path) {
    try {
        const auto logger = spdlog::basic_logger_mt(name, path);
        logger->set_pattern("%Y-%m-%d %H:%M:%S  %v");
        logger->flush_on(spdlog::level::info);
    } catch (const spdlog::spdlog_ex& e) {
        throw IoError(path, std::string("no log can be written: ") + e.what());
    }
}

void log(const std::string& event, const std::string& message) {
    if (const auto logger = spdlog::get(name)) logger->info("{:<9} {}", event, message);
}

}  // namespace transillum::cli

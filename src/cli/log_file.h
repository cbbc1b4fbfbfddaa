/// What --log-file keeps: all that is told, with the time, whatever the screen shows of it.
#pragma once

#include <string>

namespace transillum::cli {

/// Appends to the file from now on. \throws IoError where it cannot be opened.
void open_log(const std::string& path);
/// Nothing where no log is open. \param event command, progress, note, warning, error, detail or
/// end
void log(const std::string& event, const std::string& message);

}  // namespace transillum::cli

/// Serves the page of viewers/web and one solution on 127.0.0.1, read-only: the page's files, the
/// solution's index and the pieces in its folder, by a list made beforehand, and nothing else.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace transillum::cli {

class WebServer {
public:
    /// Listens once it is made, on threads of its own. \param port 0: any that is free
    /// \throws IoError where the file or the page is missing or the port is taken; UsageError for a
    /// file of another kind; InputError for an index that is no solution's
    WebServer(const std::filesystem::path& file, int port);
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;
    ~WebServer();

    [[nodiscard]] std::string url() const;
    [[nodiscard]] bool is_running() const;

private:
    struct Listening;
    std::unique_ptr<Listening> listening_;
};

}  // namespace transillum::cli
